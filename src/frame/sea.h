// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_SEA_H
#define FRAME_SEA_H
// A scene's ocean as models of the sky light it.

#include "scene/scene.h"
#include "sky/sea.h"

void frame_describe_sea(const struct trl_scene *scene, struct sky_sea *out);

#endif // FRAME_SEA_H
