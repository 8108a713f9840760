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

// Returns the cosine of a scattering angle.
double phase_sampler_draw(const struct phase_sampler *sampler, struct random_stream *random);
// The density in sr^-1 with which directions at this cosine are drawn: the phase function itself,
// but for tables, where it is about that.
double phase_sampler_density(const struct phase_sampler *sampler, double cosine);

// An angle drawn from Henyey and Greenstein's function.
double phase_draw_henyey_greenstein(double g, struct random_stream *random);

#endif // REFERENCE_PHASE_SAMPLER_H
