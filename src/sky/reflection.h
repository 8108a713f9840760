// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_REFLECTION_H
#define SKY_REFLECTION_H
// Terrain that open water mirrors, found in the picture: docs/physics.md, *The sea*.
//
//     in   position, albedo, facets        surface buffers of the view
//     in   radiance                        the view's target with everything but open water
//          nearest, near  R32F             scratch: nearest land in squares of pixels
//          land           RGBA32F          scratch
//          single, weight RGBA32F, R32F    scratch
//     out  reflection     RGBA32F          see sky/reflection.frag; half as wide and high

#include "gpu/condition.h"
#include "gpu/program.h"
#include "sky/pixels.h"

struct reflection {
    uint32_t width, height; // of the picture; 0: nothing is made
    struct gpu_program from_surface, from_nearest, seen, land_of, follow, filter;
    struct gpu_condition has_land; // in the picture
    // Nearest land in squares of 4 pixels; in those of 1, 4, 16 and 64; radiance of land in
    // rectangles; what is mirrored by single facets, and how much those count; by all.
    struct gpu_texture nearest, near, land, single, weight, texture;
    struct gpu_target nearest_target, near_target, land_target, single_target, target;
};

void reflection_finish(struct reflection *reflection);

// Draws it, without work for pictures that have no water or no land, and makes before what is not
// there yet. `sea` is the uniform u_sea of sky/sea.glsl.
TRL_MUST_USE trl_result reflection_draw(struct reflection *reflection,
                                        const struct sky_pixels *pixels,
                                        const struct sky_view *view, const float sea[3]);

#endif // SKY_REFLECTION_H
