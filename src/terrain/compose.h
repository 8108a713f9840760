// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_COMPOSE_H
#define TERRAIN_COMPOSE_H
// Deferred texturing: per pixel of a position target, the ground's colour, normal, shadow and
// lights, from all layers.

#include "gpu/target.h"
#include "terrain/shadow.h"

struct terrain_compose {
    struct gpu *gpu;
    const struct surface *surface;
    // One for each number of elevation layers that are looked at, without noise and with: what is
    // out of sight costs nothing.
    struct gpu_program programs[2][SURFACE_SEEN_LAYERS + 1];
    bool has_told[SURFACE_KIND_COUNT]; // that layers were left out
};

// TRL_ERROR_GPU; TRL_ERROR_MEMORY. Must not outlive the surface.
TRL_MUST_USE trl_result terrain_compose_init(const struct surface *surface,
                                             struct terrain_compose *out);
void terrain_compose_finish(struct terrain_compose *compose);

struct terrain_compose_inputs {
    const struct camera *camera;
    const struct gpu_texture *position;  // drawn by a mesher for that camera
    const struct terrain_shadow *shadow; // updated for it
    double region_m;                     // over which color 3 is averaged
    bool has_open;                       // the target's depth tells open sea from other ground
    float sea_albedo[3];                 // of open water in it, where the surface tells its depth
};

// What of the surface a picture asks for.
struct terrain_compose_scope {
    struct surface_selection selection;
    bool has_noise; // made-up relief is seen
};
struct terrain_compose_scope
terrain_compose_find_scope(const struct surface *surface,
                           const struct terrain_compose_inputs *inputs);

// Hands a program that, and where its pixels are.
void terrain_compose_bind_scope(const struct surface *surface,
                                const struct terrain_compose_inputs *inputs,
                                const struct terrain_compose_scope *scope,
                                struct gpu_program *program);

// Draws all of `target`, of the position's size:
// color 0, RGBA8: square root of the linear albedo, and the part of it that is water;
// color 1, RGBA16F or RGBA32F: normal in the planet frame, as long as the part of an even sky that
// stones leave, and the part of the sun that they and the terrain do (not the planet's curve, not
// the air);
// color 2, RGBA8: square root of the night lights, linear, 1 where the picture is white; alpha 0 on
// land, on open water 1, or its depth by shared/sea.glsl, where the surface tells it.
// color 3, RGBA8, where there is one: square root of the albedo of the region around; alpha 0.
// All 0 where there is no ground.
TRL_MUST_USE trl_result terrain_compose_draw(struct terrain_compose *compose,
                                             const struct terrain_compose_inputs *inputs,
                                             const struct gpu_target *target);

#endif // TERRAIN_COMPOSE_H
