// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_PATH_TRACER_H
#define REFERENCE_PATH_TRACER_H
// The sky by brute force: backward Monte Carlo paths through spherical shells, one wavelength at a
// time. It judges the deterministic solver and shares nothing with it but the description of the
// medium. It has no bias but that of its optical depths, whose quadrature is good to about 1e-5.

#include "reference/clouds.h"
#include "reference/star.h"
#include "scatter/medium.h"
#include <terrella/atmosphere.h>

#include <stdint.h>

struct reference_desc {
    uint64_t paths; // a query, >= 2: a standard error needs two
    uint64_t seed;
    int max_order;         // scatterings and reflections a path may have; 0 = all
    size_t occluder_count; // bodies before the star, in the frame of the query: the observer on the
                           // z axis, the star above the x axis
    const struct reference_occluder *occluders;
    const struct reference_clouds *clouds; // NULL: none
};

// Radiance in W m^-2 sr^-1 nm^-1 that arrives at the observer (all scattered and reflected light,
// no solar disc), and its standard error, `count` of each. The numbers depend on the seed, not on
// the number of threads. An observer on the ground (altitude 0) sees the ground at once below the
// horizon. TRL_OK, TRL_ERROR_INVALID (the query's index in the log), TRL_ERROR_MEMORY,
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result reference_sky_radiance(const trl_context *ctx, const struct medium *medium,
                                               const trl_sky_query *queries, size_t count,
                                               const struct reference_desc *desc, double *radiance,
                                               double *standard_error);

#endif // REFERENCE_PATH_TRACER_H
