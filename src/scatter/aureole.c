// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/aureole.h"

#include <math.h>

enum { MAX_MOMENTS = 2000 };
static const double WINDOW = 2.5;        // in units of pi / (lmax + 1)
static const double LEAST_MOMENT = 1e-3; // where the series of the peak ends

static const double *shares_of(const struct aureole *a, int i)
{
    return a->share + (size_t)i * (size_t)a->count;
}

// Moments of the peak: what the phase function has more than the reduced one.
static void fill_shares(struct aureole *a, int i, double *share)
{
    const struct optics *optics = a->optics;
    const double peak = optics->forward_share[i];
    phase_moments(&optics->medium->constituents[i].phase, a->count - 1, share);
    for (int l = 0; l < a->count; l++) {
        const double kept = l <= optics->lmax ? (1 - peak) * optics->moment[i][l] : 0;
        share[l] = peak > 0 ? (share[l] - kept) / peak : 0;
    }
}

// The mean of P_l over a cap of that radius is (P_(l-1) - P_(l+1)) / ((2l+1) (1 - cos radius)).
static void fill_disc(struct aureole *a)
{
    const double x = cos(a->disc_rad);
    double before = 1;
    double now = x;
    a->disc[0] = 1;
    for (int l = 1; l < a->count; l++) {
        const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
        a->disc[l] = 1 - x > 1e-12 ? (before - next) / ((2 * l + 1) * (1 - x)) : 1;
        before = now;
        now = next;
    }
}

static void cut_series(struct aureole *a)
{
    int last = a->optics->lmax;
    for (int i = 0; i < a->optics->constituent_count; i++) {
        const double *share = shares_of(a, i);
        for (int l = last + 1; l < a->count; l++) {
            last = fabs(share[l]) > LEAST_MOMENT ? l : last;
        }
    }
    // Rows keep their length: only what is summed gets shorter.
    a->used = last + 1;
}

trl_result aureole_init(const trl_context *ctx, const struct optics *optics, double disc_rad,
                        struct aureole *out)
{
    *out = (struct aureole){.optics = optics, .disc_rad = disc_rad};
    bool has_peak = false;
    for (int i = 0; i < optics->constituent_count; i++) {
        has_peak = has_peak || optics->forward_share[i] > 0;
    }
    if (!has_peak) {
        return TRL_OK;
    }
    out->count = MAX_MOMENTS;
    out->share =
        mem_alloc(ctx, (size_t)optics->constituent_count, MAX_MOMENTS * sizeof *out->share);
    out->disc = mem_alloc(ctx, MAX_MOMENTS, sizeof *out->disc);
    if (!out->share || !out->disc) {
        aureole_finish(ctx, out);
        return TRL_ERROR_MEMORY;
    }
    for (int i = 0; i < optics->constituent_count; i++) {
        fill_shares(out, i, out->share + (size_t)i * MAX_MOMENTS);
    }
    fill_disc(out);
    cut_series(out);
    return TRL_OK;
}

void aureole_finish(const trl_context *ctx, struct aureole *aureole)
{
    mem_free(ctx, aureole->share);
    mem_free(ctx, aureole->disc);
    *aureole = (struct aureole){0};
}

// (e^x - 1) / x
static double mean_exponential(double x)
{
    return fabs(x) > 1e-6 ? expm1(x) / x : 1 + 0.5 * x;
}

// Adds for one wavelength k.
static double sum_peaks(const struct aureole *a, double nu, int k, const lanes *single,
                        const float *phase, const double *column_m)
{
    const struct optics *optics = a->optics;
    double depth[MEDIUM_MAX_CONSTITUENTS]; // of scattering in the peak, along the way
    double whole = 0;
    for (int i = 0; i < optics->constituent_count; i++) {
        depth[i] = optics->forward_share[i] * (double)optics->scattering_per_m[i][k] * column_m[i];
        whole += depth[i];
    }
    double weight[MEDIUM_MAX_CONSTITUENTS]; // of the peak's shape
    double reduced[MEDIUM_MAX_CONSTITUENTS] = {0};
    double sum = 0;
    for (int i = 0; i < optics->constituent_count; i++) {
        weight[i] = optics->forward_share[i] * (double)single[i][k];
    }
    double before = 0;
    double now = 1;
    const double rest = exp(-whole);
    for (int l = 0; l < a->used; l++) {
        const double term = (2 * l + 1) / (4 * M_PI) * a->disc[l] * now;
        double again = 0;
        double shape = 0;
        for (int i = 0; i < optics->constituent_count; i++) {
            again += depth[i] * shares_of(a, i)[l];
            shape += weight[i] * shares_of(a, i)[l];
            if (l <= optics->lmax) {
                reduced[i] += (1 - optics->forward_share[i]) * optics->moment[i][l] * term;
            }
        }
        sum += term * shape * rest * (mean_exponential(again) - 1);
        const double next = ((2 * l + 1) * nu * now - l * before) / (l + 1);
        before = now;
        now = next;
    }
    for (int i = 0; i < optics->constituent_count; i++) {
        if (weight[i] > 0) {
            sum += (rest - 1) * (double)single[i][k] * ((double)phase[i] - reduced[i]);
        }
    }
    return sum;
}

// Fades where the peak has: there its series only rings.
static double window(const struct aureole *a, double nu)
{
    const double width_rad = WINDOW * M_PI / (a->optics->lmax + 1);
    return exp(-pow(acos(fmin(fmax(nu, -1), 1)) / width_rad, 4));
}

bool aureole_reaches(const struct aureole *a, double nu)
{
    return a->count > 0 && window(a, nu) > 1e-3;
}

void aureole_add(const struct aureole *a, double nu, const lanes *single, const float *phase,
                 const double *column_m, lanes *radiance)
{
    const double part = window(a, nu);
    for (int k = 0; k < LANES; k++) {
        (*radiance)[k] += (float)(part * sum_peaks(a, nu, k, single, phase, column_m));
    }
}
