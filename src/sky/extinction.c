// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/extinction.h"

#include <math.h>

enum { NODES_PER_SHELL = 40 };

// Outside this range the observer sees less than 1 % of what it sees best.
static const double FIRST_NM = 385;
static const double LAST_NM = 715;

static double wavelength_at(int k)
{
    return FIRST_NM + (LAST_NM - FIRST_NM) * k / (LANES - 1);
}

// The observer's integral over spectra that are linear between the wavelengths and constant
// outside, in steps of 1 nm.
static void fill_observer(struct extinction *e)
{
    for (double nm = CIE_FIRST_NM; nm < CIE_LAST_NM; nm += 1) {
        const struct cie_xyz seen = cie_observer_integral(nm, nm + 1);
        const double place = (nm + 0.5 - FIRST_NM) / (LAST_NM - FIRST_NM) * (LANES - 1);
        const double x = fmin(fmax(place, 0), LANES - 1);
        const int below = x < LANES - 2 ? (int)x : LANES - 2;
        const double shares[2] = {1 - (x - below), x - below};
        for (int i = 0; i < 2; i++) {
            e->xyz_from_lanes[0][below + i] += CIE_LUMENS_PER_WATT * shares[i] * seen.x;
            e->xyz_from_lanes[1][below + i] += CIE_LUMENS_PER_WATT * shares[i] * seen.y;
            e->xyz_from_lanes[2][below + i] += CIE_LUMENS_PER_WATT * shares[i] * seen.z;
        }
    }
}

static void fill_optics(struct extinction *e, const struct medium *medium)
{
    double nm[LANES];
    for (int k = 0; k < LANES; k++) {
        nm[k] = wavelength_at(k);
    }
    optics_init_for(OPTICS_WHOLE, medium, nm, LANES, e->optics);
}

trl_result extinction_init(const trl_context *ctx, const struct medium *medium,
                           struct extinction *out)
{
    *out = (struct extinction){.ctx = ctx,
                               .optics = mem_alloc(ctx, 1, sizeof *out->optics),
                               .rules = mem_alloc(ctx, 1, sizeof *out->rules),
                               .ray = mem_alloc(ctx, 1, sizeof *out->ray),
                               .depth = mem_alloc(ctx, EXTINCTION_ROWS, sizeof *out->depth)};
    if (!out->optics || !out->rules || !out->ray || !out->depth) {
        extinction_finish(out);
        return TRL_ERROR_MEMORY;
    }
    fill_optics(out, medium);
    ray_rules_init(out->rules);
    fill_observer(out);
    return TRL_OK;
}

void extinction_change(struct extinction *extinction)
{
    fill_optics(extinction, extinction->optics->medium);
    extinction->radius_m = 0;
}

void extinction_finish(struct extinction *extinction)
{
    if (extinction->ctx) {
        mem_free(extinction->ctx, extinction->optics);
        mem_free(extinction->ctx, extinction->rules);
        mem_free(extinction->ctx, extinction->ray);
        mem_free(extinction->ctx, extinction->depth);
    }
    *extinction = (struct extinction){0};
}

// Cosine of the zenith angle at which rays from `radius_m` pass a sphere, which is not above.
static double tangent_mu(double radius_m, double sphere_m)
{
    return -sqrt(fmax((radius_m - sphere_m) * (radius_m + sphere_m), 0)) / radius_m;
}

static lanes find_depth(const struct extinction *e, double mu)
{
    const struct ray_desc desc = {
        .radius_m = e->radius_m, .mu = mu, .nodes_per_shell = NODES_PER_SHELL, .end_m = INFINITY};
    ray_init(e->ray, e->optics, e->rules, &desc);
    lanes depth = {0};
    for (int i = 0; i < e->optics->constituent_count; i++) {
        depth += e->optics->extinction_per_m[i] * (float)e->ray->column_m[i];
    }
    return depth;
}

void extinction_update(struct extinction *e, double radius_m)
{
    if (e->radius_m == radius_m) {
        return;
    }
    const double ground_m = e->optics->ground_radius_m;
    const double top_m = e->optics->top_radius_m;
    e->radius_m = radius_m;
    e->version++;
    e->horizon_mu = tangent_mu(radius_m, fmin(ground_m, radius_m));
    e->highest_mu = radius_m > top_m ? tangent_mu(radius_m, top_m) : 1;
    for (int row = 0; row < EXTINCTION_ROWS; row++) {
        const double x = (double)row / (EXTINCTION_ROWS - 1);
        const double mu = e->horizon_mu + (e->highest_mu - e->horizon_mu) * x * x;
        // A hair above the horizon, lest rounding makes the lowest ray hit the ground.
        e->depth[row] = find_depth(e, fmin(1, mu + 1e-12));
    }
}

bool extinction_is_hidden(const struct extinction *extinction, double mu)
{
    return mu < extinction->horizon_mu;
}

lanes extinction_at(const struct extinction *e, double mu)
{
    const double span = fmax(e->highest_mu - e->horizon_mu, 1e-12);
    const double x = sqrt(fmin(fmax((mu - e->horizon_mu) / span, 0), 1)) * (EXTINCTION_ROWS - 1);
    const int below = x < EXTINCTION_ROWS - 2 ? (int)x : EXTINCTION_ROWS - 2;
    const float part = (float)(x - below);
    const lanes depth = e->depth[below] + (e->depth[below + 1] - e->depth[below]) * part;
    return lanes_exp_negative(-depth);
}

lanes extinction_sample(const struct extinction *extinction, const struct spectrum *spectrum)
{
    lanes values;
    for (int k = 0; k < LANES; k++) {
        values[k] = (float)spectrum_at(spectrum, extinction->optics->wavelength_nm[k]);
    }
    return values;
}

struct cie_rgb extinction_colour(const struct extinction *e, const lanes *irradiance)
{
    struct cie_xyz xyz = {0, 0, 0};
    for (int k = 0; k < LANES; k++) {
        const double light = (double)(*irradiance)[k];
        xyz.x += e->xyz_from_lanes[0][k] * light;
        xyz.y += e->xyz_from_lanes[1][k] * light;
        xyz.z += e->xyz_from_lanes[2][k] * light;
    }
    return cie_rgb_of_xyz(xyz);
}
