// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_SKY_VIEW_H
#define TERRAIN_SKY_VIEW_H
// How much of the sky the terrain leaves to each pixel of the ground: sky view factors by
// shared/sky_view.glsl, from the terrain's horizon in eight azimuths; and how the star lights what
// is seen instead. Both are held in maps around the camera, made of the shadow map: smooth where
// slopes are not, so that they may be coarse, while the slope is the pixel's own.

#include "terrain/shadow.h"

struct terrain_sky_view {
    struct gpu *gpu;
    const struct terrain_shadow *shadow;
    uint64_t made, drawn; // of the shadow
    struct gpu_program reduce, find, light, apply;
    struct gpu_texture ground;      // altitude, m; the star's light
    struct gpu_texture horizons[2]; // RGBA8, sines: azimuths 0 to 135 degrees, 180 to 315
    struct gpu_texture lights[2];   // the same of the star's light, roots
    struct gpu_target ground_target, horizons_target, lights_target;
};

// TRL_ERROR_GPU; TRL_ERROR_MEMORY. Must not outlive the shadow.
TRL_MUST_USE trl_result terrain_sky_view_init(const struct terrain_shadow *shadow,
                                              struct terrain_sky_view *out);
void terrain_sky_view_finish(struct terrain_sky_view *view);

// Makes it fit the shadow, which has been updated.
TRL_MUST_USE trl_result terrain_sky_view_update(struct terrain_sky_view *view);

struct terrain_sky_view_inputs {
    const struct camera *camera;
    const struct gpu_texture *position, *normal, *albedo; // see compose.h
};
// Adds to the alpha of color 0 the root of how the star lights the ground that is seen around, to
// that of color 1 the sky view factor, both 0 to 1, and nothing to the colours. On water only the
// latter.
TRL_MUST_USE trl_result terrain_sky_view_draw(struct terrain_sky_view *view,
                                              const struct terrain_sky_view_inputs *inputs,
                                              const struct gpu_target *target);

#endif // TERRAIN_SKY_VIEW_H
