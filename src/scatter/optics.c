// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/optics.h"

#include <math.h>
#include <string.h>

// How much of the shell coordinate goes to plain altitude; the rest follows the matter. Found by
// halving the error of twilight (which wants the thin upper air) and of haze (which wants the
// ground) together.
static const double UNIFORM_SHARE = 0.3;
static const double EDGE_SHARE = 0.4; // of the edges of what is endlessly dense

// The range that matters for colours: the observer's functions are below 1 % of their peaks
// outside.
static const double FIRST_NM = 385;
static const double LAST_NM = 715;

// Moments of the phase functions beyond lmax are dropped, after forward peaks were taken out. What
// they would scatter a second time is about a constituent's optical depth, along the longest ways
// that count, times the first moment dropped: below `allowed`.
static const struct {
    double ways; // in units of straight up
    double allowed;
    int highest;
} degrees[] = {[OPTICS_PICTURES] = {1, 0.01, 8},
               [OPTICS_NUMBERS] = {5, 0.01, 12},
               [OPTICS_WHOLE] = {6, 0.008, OPTICS_MAX_DEGREE - 1}};
// Peaks lower than this are left to the moments.
static const double LEAST_FORWARD_SHARE = 0.002;

// A kink counts when a tenth of the atmosphere's height away it has bent the vertical optical depth
// by this.
static const double KINK_REACH = 0.1;
static const double KINK_DEPTH = 0.05;

// In dense matter light varies within a free path of the top and of the ground, and hardly between:
// a part of the coordinate goes by d tau / (1 + tau) from both ends.
static double edge_slope(const struct optics *optics, const double *density, double altitude_m)
{
    const double top_m = optics->top_radius_m - optics->ground_radius_m;
    const double position = fmin(fmax(altitude_m / top_m, 0), 1) * SHELL_SAMPLES;
    const int below = position < SHELL_SAMPLES - 1 ? (int)position : SHELL_SAMPLES - 1;
    double slope = 0;
    for (int e = 0; e < OPTICS_EDGES; e++) {
        double extinction = 0;
        for (int i = 0; i < optics->constituent_count; i++) {
            extinction += (double)optics->extinction_per_m[i][optics->edge_lane[e]] * density[i];
        }
        const double *depth = optics->depth_above[e];
        const double above = depth[below] + (position - below) * (depth[below + 1] - depth[below]);
        slope += extinction * (1 / (1 + above) + 1 / (1 + fmax(depth[0] - above, 0)));
    }
    return slope;
}

double optics_shell_slope(const struct optics *optics, double altitude_m)
{
    double slope = optics->share_uniform;
    double density[MEDIUM_MAX_CONSTITUENTS];
    for (int i = 0; i < optics->constituent_count; i++) {
        density[i] = profile_density(&optics->medium->constituents[i].profile, altitude_m);
        slope += optics->share_weight[i] * sqrt(density[i]);
    }
    return optics->share_edges > 0
               ? slope + optics->share_edges * edge_slope(optics, density, altitude_m)
               : slope;
}

static double interpolate(const double *values, double at)
{
    const double position = fmin(fmax(at, 0), 1) * SHELL_SAMPLES;
    const int below = position < SHELL_SAMPLES - 1 ? (int)position : SHELL_SAMPLES - 1;
    const double part = position - below;
    return values[below] + part * (values[below + 1] - values[below]);
}

double optics_shell(const struct optics *optics, double altitude_m)
{
    return interpolate(optics->shell_of_altitude,
                       altitude_m / (optics->top_radius_m - optics->ground_radius_m));
}

double optics_largest_depth(const struct optics *optics)
{
    double depth = 0;
    for (int k = 0; k < optics->wavelength_count; k++) {
        depth = fmax(depth, optics->vertical_depth[k]);
    }
    return depth;
}

double optics_altitude(const struct optics *optics, double shell)
{
    return interpolate(optics->altitude_of_shell, shell);
}

// The first moment that is dropped is the height of the peak, as long as what is left still is a
// phase function: no moment of one is beyond -1 or 1. Backward peaks stay as they are.
static double forward_peak(const double *moment, int lmax)
{
    double share = moment[lmax + 1];
    for (int l = 0; l <= lmax; l++) {
        share = fmin(share, fmin(moment[l], 0.5 * (1 + moment[l])));
    }
    return share > LEAST_FORWARD_SHARE ? fmin(share, 1 - 1e-6) : 0;
}

// Backward peaks have moments of changing sign: the odd ones are below 0. Where matter is so thin
// that light hardly scatters twice, even along the horizon, they are not missed: at a depth of 0.2
// straight up, g of -0.999 came out 44 % too dark half way up the sky, and negative at the horizon.
static double backward_peak(const struct optics *optics, int i)
{
    const double horizon = 40; // columns straight up, of Earth's air
    const int odd = optics->lmax + 1 + optics->lmax % 2;
    const double depth = horizon * optics->vertical_scattering_depth[i];
    return fmin(1, depth) * fmax(0, -optics->moment[i][odd]);
}

// The moments lose the peak and are scaled back to p_0 = 1; those beyond lmax are dropped.
static void reduce_moments(struct optics *optics, int i, bool takes_peak)
{
    double *moment = optics->moment[i];
    const double share = takes_peak ? forward_peak(moment, optics->lmax) : 0;
    optics->forward_share[i] = share;
    for (int l = 0; l <= OPTICS_MAX_DEGREE; l++) {
        moment[l] = l <= optics->lmax ? (moment[l] - share) / (1 - share) : 0;
    }
    optics->extinction_per_m[i] -= optics->scattering_per_m[i] * (float)share;
}

static int choose_degree(const struct optics *optics, enum optics_use use)
{
    for (int lmax = 2; lmax < degrees[use].highest; lmax++) {
        double dropped = 0;
        for (int i = 0; i < optics->constituent_count; i++) {
            const double depth = degrees[use].ways * optics->vertical_scattering_depth[i];
            dropped += fmin(1, depth) * fabs(optics->moment[i][lmax + 1]);
        }
        if (dropped <= degrees[use].allowed) {
            return lmax;
        }
    }
    return degrees[use].highest;
}

static void fill_coefficients(struct optics *optics, const double *wavelength_nm, int count)
{
    for (int k = 0; k < LANES; k++) {
        const double nm = wavelength_nm[k < count ? k : count - 1];
        optics->wavelength_nm[k] = nm;
        optics->ground_albedo[k] = (float)spectrum_at(&optics->medium->ground_albedo, nm);
        for (int i = 0; i < optics->constituent_count; i++) {
            const struct constituent *c = &optics->medium->constituents[i];
            const double scattering = spectrum_at(&c->scattering_per_m, nm);
            optics->scattering_per_m[i][k] = (float)scattering;
            optics->extinction_per_m[i][k] =
                (float)(scattering + spectrum_at(&c->absorption_per_m, nm));
        }
    }
    for (int i = 0; i < optics->constituent_count; i++) {
        phase_moments(&optics->medium->constituents[i].phase, OPTICS_MAX_DEGREE, optics->moment[i]);
    }
}

// Columns (m at reference density) and the integrals of sqrt(density), straight up.
static void sum_columns(const struct optics *optics, double *column, double *root_column)
{
    const double height = optics->top_radius_m - optics->ground_radius_m;
    for (int i = 0; i < optics->constituent_count; i++) {
        const struct profile *profile = &optics->medium->constituents[i].profile;
        column[i] = root_column[i] = 0;
        for (int s = 0; s < SHELL_SAMPLES; s++) {
            const double density = profile_density(profile, (s + 0.5) * height / SHELL_SAMPLES);
            column[i] += density * height / SHELL_SAMPLES;
            root_column[i] += sqrt(density) * height / SHELL_SAMPLES;
        }
    }
}

static void fill_depths(struct optics *optics, const double *column)
{
    for (int k = 0; k < LANES; k++) {
        optics->vertical_depth[k] = 0;
        for (int i = 0; i < optics->constituent_count; i++) {
            optics->vertical_depth[k] += (double)optics->extinction_per_m[i][k] * column[i];
        }
    }
    for (int i = 0; i < optics->constituent_count; i++) {
        optics->vertical_scattering_depth[i] = 0;
        for (int k = 0; k < LANES; k++) {
            optics->vertical_scattering_depth[i] =
                fmax(optics->vertical_scattering_depth[i],
                     (double)optics->scattering_per_m[i][k] * column[i]);
        }
    }
}

// The optical depth above each altitude at the thickest and the thinnest wavelength; returns what
// d tau / (1 + tau) from both ends sums up to.
static double fill_edges(struct optics *optics)
{
    for (int k = 1; k < optics->wavelength_count; k++) {
        const double depth = optics->vertical_depth[k];
        if (depth > optics->vertical_depth[optics->edge_lane[0]]) {
            optics->edge_lane[0] = k;
        }
        if (depth < optics->vertical_depth[optics->edge_lane[1]]) {
            optics->edge_lane[1] = k;
        }
    }
    const double step = (optics->top_radius_m - optics->ground_radius_m) / SHELL_SAMPLES;
    double sum = 0;
    for (int e = 0; e < OPTICS_EDGES; e++) {
        double *depth = optics->depth_above[e];
        depth[SHELL_SAMPLES] = 0;
        for (int s = SHELL_SAMPLES - 1; s >= 0; s--) {
            depth[s] = depth[s + 1];
            for (int i = 0; i < optics->constituent_count; i++) {
                depth[s] +=
                    (double)optics->extinction_per_m[i][optics->edge_lane[e]] * step *
                    profile_density(&optics->medium->constituents[i].profile, (s + 0.5) * step);
            }
        }
        sum += 2 * log1p(depth[0]);
    }
    return sum;
}

// Each constituent gets a part of the coordinate by the root of its optical depth, so that a thin
// haze is not lost beside thick air; the edges get one that grows with the largest optical depth.
static void choose_shares(struct optics *optics, const double *column, const double *root_column)
{
    double part[MEDIUM_MAX_CONSTITUENTS];
    double sum = 0;
    for (int i = 0; i < optics->constituent_count; i++) {
        double depth = 0;
        for (int k = 0; k < LANES; k++) {
            depth = fmax(depth, (double)optics->extinction_per_m[i][k] * column[i]);
        }
        part[i] = root_column[i] > 0 ? sqrt(depth) : 0;
        sum += part[i];
    }
    const double height = optics->top_radius_m - optics->ground_radius_m;
    const double edges = fill_edges(optics);
    const double depth = optics_largest_depth(optics);
    const double edge_share = EDGE_SHARE * (1 - 1 / fmax(depth, 1));
    const double matter_share = 1 - UNIFORM_SHARE - edge_share;
    optics->share_uniform = (sum > 0 ? UNIFORM_SHARE : 1) / height;
    optics->share_edges = edges > 0 ? edge_share / edges : 0;
    for (int i = 0; i < optics->constituent_count; i++) {
        optics->share_weight[i] = part[i] > 0 ? matter_share * part[i] / sum / root_column[i] : 0;
    }
}

static void fill_shells(struct optics *optics)
{
    const double step = (optics->top_radius_m - optics->ground_radius_m) / SHELL_SAMPLES;
    double *u = optics->shell_of_altitude;
    u[0] = 0;
    for (int s = 0; s < SHELL_SAMPLES; s++) {
        u[s + 1] = u[s] + step / 6 *
                              (optics_shell_slope(optics, s * step) +
                               4 * optics_shell_slope(optics, (s + 0.5) * step) +
                               optics_shell_slope(optics, (s + 1) * step));
    }
    // The shares sum to 1 up to the quadrature's error; make it exact.
    const double whole = u[SHELL_SAMPLES];
    for (int s = 0; s <= SHELL_SAMPLES; s++) {
        u[s] /= whole;
    }
    optics->share_uniform /= whole;
    optics->share_edges /= whole;
    for (int i = 0; i < optics->constituent_count; i++) {
        optics->share_weight[i] /= whole;
    }
    int below = 0;
    for (int s = 0; s <= SHELL_SAMPLES; s++) {
        const double wanted = (double)s / SHELL_SAMPLES;
        while (below < SHELL_SAMPLES - 1 && u[below + 1] < wanted) {
            below++;
        }
        const double part = (wanted - u[below]) / (u[below + 1] - u[below]);
        optics->altitude_of_shell[s] = (below + fmin(part, 1)) * step;
    }
}

struct kink {
    double altitude_m;
    double bend; // change of the extinction's slope, m^-2
};

// Keeps the strongest, in ascending altitude.
static void insert_kink(struct kink *kinks, int *count, struct kink kink)
{
    if (*count == OPTICS_KINKS) {
        int weakest = 0;
        for (int k = 1; k < *count; k++) {
            weakest = kinks[k].bend < kinks[weakest].bend ? k : weakest;
        }
        if (kinks[weakest].bend >= kink.bend) {
            return;
        }
        --*count;
        memmove(kinks + weakest, kinks + weakest + 1, (size_t)(*count - weakest) * sizeof *kinks);
    }
    int at = *count;
    for (; at > 0 && kinks[at - 1].altitude_m > kink.altitude_m; at--) {
        kinks[at] = kinks[at - 1];
    }
    kinks[at] = kink;
    ++*count;
}

static void fill_kinks(struct optics *optics)
{
    const double height_m = optics->top_radius_m - optics->ground_radius_m;
    const double reach_m = height_m * KINK_REACH;
    struct kink kinks[OPTICS_KINKS];
    for (int i = 0; i < optics->constituent_count; i++) {
        const struct profile *profile = &optics->medium->constituents[i].profile;
        double extinction = 0;
        for (int k = 0; k < LANES; k++) {
            extinction = fmax(extinction, (double)optics->extinction_per_m[i][k]);
        }
        for (size_t n = 0; n < profile_kink_count(profile); n++) {
            double change;
            const double altitude_m = profile_kink_m(profile, n, &change);
            const double bend = fabs(change) * extinction;
            if (altitude_m > 0 && altitude_m < height_m && bend * reach_m * reach_m > KINK_DEPTH) {
                insert_kink(kinks, &optics->kink_count, (struct kink){altitude_m, bend});
            }
        }
    }
    for (int k = 0; k < optics->kink_count; k++) {
        optics->kink_shell[k] = optics_shell(optics, kinks[k].altitude_m);
    }
}

void optics_init_for(enum optics_use use, const struct medium *medium, const double *wavelength_nm,
                     int count, struct optics *optics)
{
    memset(optics, 0, sizeof *optics);
    optics->medium = medium;
    optics->ground_radius_m = medium->ground_radius_m;
    optics->top_radius_m = medium->top_radius_m;
    optics->wavelength_count = count;
    optics->constituent_count = (int)medium->constituent_count;
    fill_coefficients(optics, wavelength_nm, count);
    double column[MEDIUM_MAX_CONSTITUENTS];
    double root_column[MEDIUM_MAX_CONSTITUENTS];
    sum_columns(optics, column, root_column);
    fill_depths(optics, column);
    optics->lmax = choose_degree(optics, use);
    for (int i = 0; i < optics->constituent_count; i++) {
        optics->backward_peak = fmax(optics->backward_peak, backward_peak(optics, i));
        reduce_moments(optics, i, use != OPTICS_WHOLE);
    }
    fill_depths(optics, column);
    choose_shares(optics, column, root_column);
    fill_shells(optics);
    fill_kinks(optics);
}

void optics_init(struct optics *optics, const struct medium *medium, const double *wavelength_nm,
                 int count)
{
    optics_init_for(OPTICS_NUMBERS, medium, wavelength_nm, count, optics);
}

void optics_init_visible(enum optics_use use, const struct medium *medium, int count,
                         struct optics *optics)
{
    double nm[LANES];
    for (int k = 0; k < count; k++) {
        nm[k] = count > 1 ? FIRST_NM + (LAST_NM - FIRST_NM) * k / (count - 1) : 550;
    }
    optics_init_for(use, medium, nm, count, optics);
}
