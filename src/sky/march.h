// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_MARCH_H
#define SKY_MARCH_H
// Shadows in the air of the spectral model. Along the rays of a coarse grid over the picture the
// source of aerial perspective (scatter/aerial.h) is summed twice, as the star alone makes it and
// with what hides the star at each place; what the tables give is multiplied by the share of the
// one in the other. So the picture is that of the tables to the bit where nothing is hidden.
// docs/decisions/020-shadows-in-the-air.md
//
//     in   source     as `scattered` of spectral.c, of each cell alone
//     out  share      3D RGBA32F  grid x distance: of XYZ, up to the distance at which a layer
//     ends;
//                                 the last layer is the whole way into space
//          sums, marched          scratch
//
// Layers end at far (k / MARCH_LAYERS)^2 from where a ray's air begins.

#include "sky/pixels.h"

struct sky_eclipse;

enum { MARCH_LAYERS = 32 };

struct sky_march {
    struct gpu *gpu;
    double top_radius_m, ground_radius_m;
    bool is_made; // with the programs for:
    bool is_bare, has_eclipse, has_clouds;
    struct gpu_program begin, step, space, fill;
    struct gpu_texture lit[2], all[2], marched, share; // of the last picture's size
    struct gpu_target sums[2], last, filled;
    double far_m;
};

// Nothing is made before the first picture.
void sky_march_init(const struct sky_pixels *pixels, struct sky_march *out);
void sky_march_finish(struct sky_march *march);

// What a picture needs from the model.
struct sky_march_source {
    const struct sky_pixels *pixels;
    int peaked_count;
    // Sets the uniforms of spectral/air.glsl and the sources.
    void (*set_maps)(const void *self, struct gpu_program *program);
    const void *self;
    const struct sky_eclipse *eclipse; // NULL: none
};

// Makes the shares of a picture. TRL_ERROR_GPU, TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result sky_march_draw(struct sky_march *march,
                                       const struct sky_march_source *source,
                                       const struct sky_view *view);

// Hands them to a program that includes spectral/air.glsl with MARCH.
void sky_march_bind(const struct sky_march *march, struct gpu_program *program);

#endif // SKY_MARCH_H
