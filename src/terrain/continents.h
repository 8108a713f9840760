// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_CONTINENTS_H
#define TERRAIN_CONTINENTS_H
// The map of an invented planet: where its continents and mountain ranges are, from a seed. It
// takes the place of the octaves longer than four of its texels.

#include "terrain/noise.h"

struct continents_desc {
    uint32_t seed;
    double radius_m;
    double wavelength_m; // of continents
    double height_m;     // of ranges above plains; oceans are as deep
    double amplitude_m;  // of the noise in ranges
    double ocean_share;  // of the sphere; 0: no ocean
    enum noise_form form;
};

enum { CONTINENTS_WIDTH = 1024, CONTINENTS_HEIGHT = 512 };

// TRL_ERROR_MEMORY. *out: the caller's, until noise_init takes it.
TRL_MUST_USE trl_result continents_make(const trl_context *ctx, const struct continents_desc *desc,
                                        struct noise_map *out);

#endif // TERRAIN_CONTINENTS_H
