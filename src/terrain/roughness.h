// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_ROUGHNESS_H
#define TERRAIN_ROUGHNESS_H
// How rough data are around each place, so that noise can go on where they end.

#include "terrain/layer.h"
#include "terrain/noise.h"

// What the roughness is measured over, in texels: waves of that length.
enum { ROUGHNESS_TEXELS = 4 };

struct roughness_desc {
    const struct terrain_layer *layer; // heights; where they are not, there is no roughness
    double radius_m;
    double factor; // 1: as rough as the data
    double ridged; // of the noise
};

// The amplitude in m of noise of ROUGHNESS_TEXELS texels' wavelength. TRL_ERROR_MEMORY. *out: the
// caller's, until noise_init takes it.
TRL_MUST_USE trl_result roughness_make(const trl_context *ctx, const struct roughness_desc *desc,
                                       struct noise_map *out);

// What is measured for that, at a place, m^2.
double roughness_square_bend(const struct terrain_layer *layer, double latitude, double longitude);

// How rough the finest texels of a layer are relative to those that are held of it: 1 where it is
// held whole; else some tiles are read for it, and where none can be, ground is taken to be like
// itself with this Hurst exponent.
double roughness_of_tiles(const trl_context *ctx, const struct terrain_layer *layer, double hurst);

#endif // TERRAIN_ROUGHNESS_H
