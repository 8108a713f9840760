// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUDS_SKY_H
#define CLOUDS_SKY_H
// Skylight and the ground's at 1.75 km in hazy air, for light of clouds that is fitted to.

#include <terrella/context.h>

enum { CLOUD_SKY_SUNS = 6, CLOUD_SKY_RINGS = 128, CLOUD_SKY_AZIMUTHS = 24 };

// Radiance less that of two even halves with the same irradiances, and less the first moment toward
// the star; in units of the mean of both halves.
struct cloud_sky {
    double rest[CLOUD_SKY_SUNS][CLOUD_SKY_RINGS][CLOUD_SKY_AZIMUTHS];
    double mean[CLOUD_SKY_SUNS]; // of all directions
};

extern const double cloud_sky_suns_deg[CLOUD_SKY_SUNS];

TRL_MUST_USE trl_result cloud_sky_make(const trl_context *ctx, struct cloud_sky *out);

// `x` is the part of the direction that points horizontally toward the star.
double cloud_sky_rest(const struct cloud_sky *sky, int sun, double mu, double x);

#endif // CLOUDS_SKY_H
