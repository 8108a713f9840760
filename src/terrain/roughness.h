// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_ROUGHNESS_H
#define TERRAIN_ROUGHNESS_H
// How rough data are around each place, so that noise can go on where they end.

#include "terrain/layer.h"
#include "terrain/noise.h"

// Waves of so many texels are what the roughness is measured at.
#define ROUGHNESS_TEXELS 4.0

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

#endif // TERRAIN_ROUGHNESS_H
