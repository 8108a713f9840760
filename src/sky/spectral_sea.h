// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SPECTRAL_SEA_H
#define SKY_SPECTRAL_SEA_H
// Open water in the spectral model: what sea.frag looks up, and its programs. The textures hold for
// the whole planet, every eye and star.

#include "sky/pixels.h"
#include "sky/spectral_maps.h"

struct spectral_sea {
    struct gpu *gpu;
    const struct sky_sea *sea; // NULL: none
    double disc_slope;         // by which the star's disc makes its glint broader
    struct gpu_texture mirror; // 3D RGBA32F  azimuth x sun x view: sea_mirror_make
    struct gpu_texture water;  // 2D RGBA32F  depth x 2: bands of what comes out of the water; x of
        //             the second row: reflectance over the root of the cosine
    struct gpu_program programs[2]; // with an eclipse: the second
    bool has_textures, has_program[2];
};

void spectral_sea_init(const struct sky_desc *desc, struct spectral_sea *out);
void spectral_sea_finish(struct spectral_sea *sea);
// When the atmosphere is about to be another one.
void spectral_sea_drop(struct spectral_sea *sea);

// Whether the view may show open water.
bool spectral_sea_is_seen(const struct spectral_sea *sea, const struct sky_view *view);

// Makes what the view needs and is not there yet.
TRL_MUST_USE trl_result spectral_sea_prepare(struct spectral_sea *sea,
                                             const struct spectral_maps *maps,
                                             const struct sky_view *view, bool has_eclipse);

// The uniforms of sea.frag that are its own.
void spectral_sea_set(const struct spectral_sea *sea, struct gpu_program *program,
                      bool is_shadowed);

#endif // SKY_SPECTRAL_SEA_H
