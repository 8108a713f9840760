// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_SUN_GUIDE_H
#define REFERENCE_SUN_GUIDE_H
// About how much sunlight reaches each place: tells paths where collisions are worth most. Only the
// noise depends on it, never the expectation, so a coarse table is enough.

#include "reference/optics.h"

struct sun_guide {
    double lowest_mu; // cosine of the sun's zenith angle below which no place has sun
    double thickness_m;
    double *transmittance; // mean over the wavelengths
};

TRL_MUST_USE trl_result sun_guide_init(const trl_context *ctx, const struct reference_air *air,
                                       const struct reference_optics *optics,
                                       struct sun_guide *guide);
void sun_guide_finish(const trl_context *ctx, struct sun_guide *guide);

// At an altitude above the bottom and a cosine of the sun's zenith angle.
double sun_guide_at(const struct sun_guide *guide, double altitude_m, double mu_sun);

#endif // REFERENCE_SUN_GUIDE_H
