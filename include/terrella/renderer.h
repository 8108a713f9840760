// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_RENDERER_H
#define TRL_RENDERER_H

#include <terrella/scene.h>

TRL_BEGIN
TRL_END
#endif // TRL_RENDERER_H
