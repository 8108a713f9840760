// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SEA_VOLUME_H
#define SKY_SEA_VOLUME_H
// What comes out of the water, looked up: on the GPU as shaders/sky/sea.glsl does, and in C.

#include "sky/pixels.h"
#include "sky/sea.h"

// The texture: depth x row x view, in these bands or in colours (NULL). Rows without azimuth are
// logarithms, the others shares of these.
// TRL_ERROR_MEMORY, TRL_ERROR_GPU.
TRL_MUST_USE trl_result sea_volume_make(struct gpu *gpu, const struct sky_sea_volume *volume,
                                        const struct bands *bands, struct gpu_texture *out);

// Cosines in the air, above 0.
struct sea_volume_rays {
    double sun_mu, view_mu;
    double azimuth_cosine; // of the line of sight from the star's
};

// As struct sky_sea_volume. Colours that no screen has are below 0.
struct sea_volume_colour {
    double star[3], sky[3];
};
void sea_volume_at(const struct sky_sea_volume *volume, double depth_code,
                   const struct sea_volume_rays *rays, struct sea_volume_colour *out);

#endif // SKY_SEA_VOLUME_H
