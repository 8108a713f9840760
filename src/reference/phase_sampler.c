// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/phase_sampler.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// Bins between two knots of a table, and the widest bin.
enum { BINS_PER_KNOT = 4 };
static const double max_bin_rad = 0.01;

static size_t bins_between(double from_rad, double to_rad)
{
    if (to_rad <= from_rad) {
        return 0;
    }
    const double wanted = ceil((to_rad - from_rad) / max_bin_rad);
    return wanted > BINS_PER_KNOT ? (size_t)wanted : BINS_PER_KNOT;
}

// The i-th of the count + 2 angles that bound the table's intervals: 0, the knots, pi.
static double interval_bound(const struct phase *phase, size_t i)
{
    if (i == 0) {
        return 0;
    }
    return i > phase->count ? pi : phase->angle_rad[i - 1];
}

static void fill_bins(struct phase_sampler *sampler)
{
    const struct phase *phase = sampler->phase;
    size_t bin = 0;
    double sum = 0;
    sampler->cosine[0] = 1;
    sampler->cumulative[0] = 0;
    for (size_t i = 0; i <= phase->count; ++i) {
        const double from = interval_bound(phase, i), to = interval_bound(phase, i + 1);
        const size_t bins = bins_between(from, to);
        for (size_t k = 0; k < bins; ++k) {
            const double end = from + (to - from) * (double)(k + 1) / (double)bins;
            const double cosine = cos(end);
            const double middle = 0.5 * (sampler->cosine[bin] + cosine);
            sum += phase_value(phase, middle) * (sampler->cosine[bin] - cosine);
            ++bin;
            sampler->cosine[bin] = cosine;
            sampler->cumulative[bin] = sum;
        }
    }
    sampler->bin_count = bin;
    for (size_t i = 1; i <= bin; ++i) {
        sampler->cumulative[i] /= sum;
    }
}

trl_result phase_sampler_init(const trl_context *ctx, const struct phase *phase,
                              struct phase_sampler *sampler)
{
    *sampler = (struct phase_sampler){.phase = phase};
    if (phase->kind != PHASE_TABLE) {
        return TRL_OK;
    }
    size_t bins = 0;
    for (size_t i = 0; i <= phase->count; ++i) {
        bins += bins_between(interval_bound(phase, i), interval_bound(phase, i + 1));
    }
    sampler->cosine = mem_alloc(ctx, bins + 1, sizeof(double));
    sampler->cumulative = mem_alloc(ctx, bins + 1, sizeof(double));
    if (!sampler->cosine || !sampler->cumulative) {
        phase_sampler_finish(ctx, sampler);
        return TRL_ERROR_MEMORY;
    }
    fill_bins(sampler);
    return TRL_OK;
}

void phase_sampler_finish(const trl_context *ctx, struct phase_sampler *sampler)
{
    mem_free(ctx, sampler->cosine);
    mem_free(ctx, sampler->cumulative);
    *sampler = (struct phase_sampler){0};
}

// Solves c + c^3 / 3 = 4/3 (2u - 1), the cumulative distribution of 3/8 (1 + c^2).
static double draw_rayleigh(struct random_stream *random)
{
    const double q = 2 * (2 * random_next(random) - 1);
    const double root = sqrt(1 + q * q);
    return cbrt(root + q) - cbrt(root - q);
}

double phase_draw_henyey_greenstein(double g, struct random_stream *random)
{
    const double x = 2 * random_next(random) - 1;
    if (fabs(g) < 1e-4) {
        return x + 1.5 * g * (1 - x * x); // first order in g
    }
    const double ratio = (1 - g * g) / (1 + g * x);
    return fmin(fmax((1 + g * g - ratio * ratio) / (2 * g), -1), 1);
}

// It is Henyey-Greenstein times 1 + cos^2, so most draws of that pass the second factor.
static double draw_cornette_shanks(double g, struct random_stream *random)
{
    for (;;) {
        const double cosine = phase_draw_henyey_greenstein(g, random);
        if (2 * random_next(random) <= 1 + cosine * cosine) {
            return cosine;
        }
    }
}

// The last bin whose bound passes: `rises` to `at` for cumulative, falls to it for cosine.
static size_t find_bin(const struct phase_sampler *sampler, const double *bounds, double at)
{
    const double sign = bounds == sampler->cosine ? -1 : 1;
    size_t low = 0, high = sampler->bin_count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (sign * bounds[middle] <= sign * at) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

static double draw_table(const struct phase_sampler *sampler, struct random_stream *random)
{
    const size_t bin = find_bin(sampler, sampler->cumulative, random_next(random));
    const double width = sampler->cosine[bin] - sampler->cosine[bin + 1];
    return sampler->cosine[bin] - width * random_next(random);
}

double phase_sampler_draw(const struct phase_sampler *sampler, struct random_stream *random)
{
    switch (sampler->phase->kind) {
    case PHASE_ISOTROPIC:
        break;
    case PHASE_RAYLEIGH:
        return draw_rayleigh(random);
    case PHASE_HENYEY_GREENSTEIN:
        return phase_draw_henyey_greenstein(sampler->phase->g, random);
    case PHASE_CORNETTE_SHANKS:
        return draw_cornette_shanks(sampler->phase->g, random);
    case PHASE_TABLE:
        return draw_table(sampler, random);
    }
    return 2 * random_next(random) - 1;
}

double phase_sampler_density(const struct phase_sampler *sampler, double cosine)
{
    if (sampler->phase->kind != PHASE_TABLE) {
        return phase_value(sampler->phase, cosine);
    }
    const size_t bin = find_bin(sampler, sampler->cosine, cosine);
    const double width = sampler->cosine[bin] - sampler->cosine[bin + 1];
    return (sampler->cumulative[bin + 1] - sampler->cumulative[bin]) / (2 * pi * width);
}
