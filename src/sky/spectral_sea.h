// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SPECTRAL_SEA_H
#define SKY_SPECTRAL_SEA_H
// Open water in the spectral model: what sea.frag looks up, and its programs. The textures hold for
// the whole planet and every eye; what is mirrored under a sun is made when water is seen under it.

#include "sky/sea_water.h"
#include "sky/spectral_maps.h"

// Programs are told apart by what shades the star's light.
enum { SEA_ECLIPSED = 1, SEA_CLOUDED = 2, SEA_PROGRAMS = 4 };

struct spectral_sea {
    struct gpu *gpu;
    struct sea_water water;
    struct gpu_texture mirror;     // 3D RGBA32F  azimuth x sun x view: sea_mirror_make
    bool has_sun[TABLE_MOST_SUNS]; // in the mirror, of the table's
    struct gpu_program programs[SEA_PROGRAMS];
    bool has_program[SEA_PROGRAMS];
};

void spectral_sea_init(const struct sky_desc *desc, struct spectral_sea *out);
void spectral_sea_finish(struct spectral_sea *sea);
// When the atmosphere is about to be another one.
void spectral_sea_drop(struct spectral_sea *sea);

// Makes what the view needs under the light from a direction and is not there yet.
TRL_MUST_USE trl_result spectral_sea_prepare(struct spectral_sea *sea,
                                             const struct spectral_maps *maps,
                                             const struct sky_view *view, struct vec3 light,
                                             unsigned shades);

// The uniforms of sea.frag that are its own.
void spectral_sea_set(const struct spectral_sea *sea, const struct sky_view *view,
                      struct gpu_program *program);

#endif // SKY_SPECTRAL_SEA_H
