// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_KINDS_H
#define TERRAIN_KINDS_H
// Which pixels of a picture show ground, and which of those water: a depth that passes test
// against. A software rasteriser saves nothing by branches, but does not enter a shader where no
// pixel passes.

#include "gpu/condition.h"
#include "gpu/pass.h"

struct terrain_kinds {
    struct gpu *gpu;
    struct gpu_program ground, water;
    struct gpu_condition has_water; // of the last picture
};

// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result terrain_kinds_init(struct gpu *gpu, struct terrain_kinds *out);
void terrain_kinds_finish(struct terrain_kinds *kinds);

// Overwrites the depth of a target that has nothing else: passes of lib/fullscreen.vert, or of
// lib/layer.vert at TERRAIN_GROUND_DEPTH, with GPU_DEPTH_FARTHER then draw where there is ground.
// `position` is that of frame/ground.h. Who knows of open sea (open_sea.h) may set it to
// TERRAIN_OPEN_DEPTH: until the water is added it is not ground then.
#define TERRAIN_GROUND_DEPTH 0.5f
#define TERRAIN_OPEN_DEPTH 0.25f
TRL_MUST_USE trl_result terrain_kinds_draw(struct terrain_kinds *kinds,
                                           const struct gpu_texture *position,
                                           const struct gpu_target *target);

// Adds the water: passes of lib/layer.vert at TERRAIN_WATER_DEPTH with GPU_DEPTH_FARTHER then draw
// where there is some.
#define TERRAIN_WATER_DEPTH 0.875f
TRL_MUST_USE trl_result terrain_kinds_add_water(struct terrain_kinds *kinds,
                                                const struct gpu_texture *albedo,
                                                const struct gpu_target *target);

#endif // TERRAIN_KINDS_H
