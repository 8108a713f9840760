// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_TERRELLA_H
#define TRL_TERRELLA_H

/// @file
/// Everything of the library.

#include <terrella/atmosphere.h>
#include <terrella/base.h>
#include <terrella/context.h>
#include <terrella/ground.h>
#include <terrella/image.h>
#include <terrella/reference.h>
#include <terrella/renderer.h>
#include <terrella/scene.h>
#include <terrella/water.h>

#endif // TRL_TERRELLA_H
