// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_SUNLIGHT_H
#define SCATTER_SUNLIGHT_H
// Direct light of the star at any point of the medium: transmittance averaged over the star's
// uniform disc, with the part that the planet hides counted as dark. The shadow's edge is thus as
// soft as it is.

#include "scatter/ray.h"

// Light at shell coordinate level / (levels - 1) and sun coordinate column / (columns - 1).
struct sunlight {
    const struct optics *optics;
    int levels, columns;
    double disc_rad; // angular radius of the star, > 0 (a tiny one stands for a point)
    // [levels][columns]: logarithm of the transmittance, at least SUNLIGHT_DARK. Between levels it
    // is optical depths that are about linear: rays that graze dense matter go from clear to dark
    // within a part of a level.
    lanes *log_transmittance;
    lanes *ground_irradiance; // [columns]: on level ground at the reference radius, per unit
                              // irradiance
};

// Allocates without computing.
TRL_MUST_USE trl_result sunlight_reserve(const trl_context *ctx, const struct optics *optics,
                                         struct sunlight *out);
// Computes what was reserved.
TRL_MUST_USE trl_result sunlight_fill(const trl_context *ctx, const struct ray_rules *rules,
                                      struct sunlight *sun);
void sunlight_finish(const trl_context *ctx, struct sunlight *sun);

// The sun coordinate is logarithmic in the cosine of the zenith angle above the one at which the
// disc's upper edge touches the horizon: x = log(1 + (mu - lowest) / SUNLIGHT_SOFT) * scale, in [0,
// 1].
#define SUNLIGHT_SOFT 0.01
#define SUNLIGHT_DARK (-80.0f)

struct sunlight_row {
    double lowest_mu; // nothing of the disc is seen below
    double scale;
};

struct sunlight_row sunlight_row_at(double ground_radius_m, double radius_m, double disc_rad);

// Fills transmittance[LANES] for one point; mu is the cosine of the star's zenith angle.
void sunlight_at(const struct sunlight *sun, double radius_m, double mu, lanes *transmittance);
// The same for the irradiance of level ground at the reference radius.
void sunlight_ground_at(const struct sunlight *sun, double mu, lanes *irradiance);

#endif // SCATTER_SUNLIGHT_H
