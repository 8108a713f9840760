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

// The value of a spectrum of the volume at a wavelength.
double sea_volume_value(const struct sky_sea_volume *volume, const double *spectrum, double nm);

// Linear sRGB relative to white in the star's light. Colours that no screen has are below 0.
void sea_volume_rgb(const struct sky_sea_volume *volume, const double *spectrum, double rgb[3]);

// A spectrum in the bands: of all those that have its colour the one nearest to its own values
// there, relative to them.
void sea_volume_bands(const struct sky_sea_volume *volume, const struct bands *bands,
                      const double *spectrum, double out[BAND_COUNT]);

// Cosines in the air, above 0.
struct sea_volume_rays {
    double sun_mu, view_mu;
    double azimuth_cosine; // of the line of sight from the star's
};

// As struct sky_sea_volume.
struct sea_volume_light {
    double star[SKY_SEA_WAVELENGTHS], sky[SKY_SEA_WAVELENGTHS];
};
void sea_volume_at(const struct sky_sea_volume *volume, double depth_code,
                   const struct sea_volume_rays *rays, struct sea_volume_light *out);

#endif // SKY_SEA_VOLUME_H
