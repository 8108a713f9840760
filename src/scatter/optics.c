// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/optics.h"

#include <math.h>

// How much of the shell coordinate goes to plain altitude; the rest follows the matter. Found by
// halving the error of twilight (which wants the thin upper air) and of haze (which wants the
// ground) together.
static const double UNIFORM_SHARE = 0.3;

// The range that matters for colours: the observer's functions are below 1 % of their peaks
// outside.
static const double FIRST_NM = 385;
static const double LAST_NM = 715;

// Peaks lower than this are left to the moments.
static const double LEAST_FORWARD_SHARE = 0.05;

double optics_shell_slope(const struct optics *optics, double altitude_m)
{
    double slope = optics->share_uniform;
    for (int i = 0; i < optics->constituent_count; i++) {
        const double density =
            profile_density(&optics->medium->constituents[i].profile, altitude_m);
        slope += optics->share_weight[i] * sqrt(density);
    }
    return slope;
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

// The first moment that is not resolved is the height of the peak; the others lose it and are
// scaled back to p_0 = 1.
static void take_forward_peak(struct optics *optics, int i)
{
    double *moment = optics->moment[i];
    const double share = moment[OPTICS_MAX_DEGREE];
    optics->forward_share[i] = share > LEAST_FORWARD_SHARE ? share : 0;
    if (optics->forward_share[i] > 0) {
        for (int l = 0; l <= OPTICS_MAX_DEGREE; l++) {
            moment[l] = (moment[l] - share) / (1 - share);
        }
        optics->extinction_per_m[i] -= optics->scattering_per_m[i] * (float)share;
    }
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
        take_forward_peak(optics, i);
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

// Each constituent gets a part of the coordinate by the root of its optical depth, so that a thin
// haze is not lost beside thick air.
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
    optics->share_uniform = (sum > 0 ? UNIFORM_SHARE : 1) / height;
    for (int i = 0; i < optics->constituent_count; i++) {
        optics->share_weight[i] =
            part[i] > 0 ? (1 - UNIFORM_SHARE) * part[i] / sum / root_column[i] : 0;
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

void optics_init(struct optics *optics, const struct medium *medium, const double *wavelength_nm,
                 int count)
{
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
    choose_shares(optics, column, root_column);
    fill_shells(optics);
}

void optics_init_visible(struct optics *optics, const struct medium *medium, int count)
{
    double nm[LANES];
    for (int k = 0; k < count; k++) {
        nm[k] = count > 1 ? FIRST_NM + (LAST_NM - FIRST_NM) * k / (count - 1) : 550;
    }
    optics_init(optics, medium, nm, count);
}
