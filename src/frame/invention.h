// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_INVENTION_H
#define FRAME_INVENTION_H
// The invented ground of a scene, as struct surface takes it: noise, biomes, detail below data.

#include "scene/scene.h"
#include "terrain/surface.h"

void invention_describe(const struct trl_scene *scene, struct surface_desc *out);

#endif // FRAME_INVENTION_H
