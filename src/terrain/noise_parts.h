// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_NOISE_PARTS_H
#define TERRAIN_NOISE_PARTS_H
// Private to noise.c, noise_map.c and noise_rise.c.
#include "terrain/noise.h"

// Size of gullies relative to that of noise.
static const double NOISE_GULLIES = 0.35;

// From 3.6 degrees of the poles, where a texel is 16 times as high as wide. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result noise_map_level_poles(const trl_context *ctx, const struct noise_map *map);

// The noise's map as its texture. As gpu_texture_init.
TRL_MUST_USE trl_result noise_map_upload(struct gpu *gpu, struct terrain_noise *noise);

// The largest slope, per metre, of what the map has.
double noise_map_find_steepest(const struct terrain_noise *noise,
                               float (*value)(const struct noise_texel *));

#endif // TERRAIN_NOISE_PARTS_H
