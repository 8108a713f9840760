// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUDS_SAMPLES_H
#define CLOUDS_SAMPLES_H
// Light inside clouds by paths, at places where eyes see them, with what the march knows of these.

#include "sky.h"

#include "cloud/field.h"

struct cloud_sample {
    double sun_mu, view_mu, nu, height;
    double toward;     // the star's part of the horizontal, along the view
    double depth, far; // toward the star, as the march looks; beyond
    double side, whole, around_above, around_below, cover; // as in CloudAround
    // Light toward the eye: of the star, scattered once, and more often with its error; the part of
    // an even sky's, the ground being black; that of light as bright as the part of a direction
    // toward the star, from above and below; what a sky has besides (see cloud_sky), and the mean
    // of that over all directions.
    double once, several, several_error, above, above_error, turned, horizon, horizon_mean;
};

struct cloud_plan {
    struct cloud_layer layer;
    uint32_t seed;
    size_t places, paths; // of each place
    const struct cloud_sky *sky;
};

// `out` has room for all places.
TRL_MUST_USE trl_result cloud_samples_make(const trl_context *ctx, const struct cloud_plan *plan,
                                           struct cloud_sample *out);

#endif // CLOUDS_SAMPLES_H
