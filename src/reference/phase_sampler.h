// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_PHASE_SAMPLER_H
#define REFERENCE_PHASE_SAMPLER_H
// Random scattering angles in proportion to a phase function.

#include "reference/random.h"
#include "scatter/medium.h"

struct phase_sampler {
    const struct phase *phase; // outlives the sampler
    size_t bin_count;          // tables only, else 0
    double *cosine;            // bounds of the bins, descending from 1 to -1
    double *cumulative;        // probability up to each bound, from 0 to 1
};

TRL_MUST_USE trl_result phase_sampler_init(const trl_context *ctx, const struct phase *phase,
                                           struct phase_sampler *sampler);
void phase_sampler_finish(const trl_context *ctx, struct phase_sampler *sampler);

// Returns the cosine of a scattering angle; `weight` is the phase function over the density with
// which this direction was drawn, near 1.
double phase_sampler_draw(const struct phase_sampler *sampler, struct random_stream *random,
                          double *weight);

#endif // REFERENCE_PHASE_SAMPLER_H
