// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_SWEEP_H
#define SCATTER_SWEEP_H
// One order of scattering: light of the order before, gathered along rays to every level from every
// direction and for every sun, and projected on the moments.

#include "scatter/solver.h"

// Directions at one level: zenith cosines on both sides of the geometric horizon, denser toward it,
// and azimuths at midpoints of half a turn, which the mirror symmetry doubles.
struct directions {
    int zeniths; // above and below together
    int azimuths;
    double mu[4 * GAUSS_MAX];
    double weight[4 * GAUSS_MAX]; // of d mu
    double cos_azimuth[4 * GAUSS_MAX];
    double azimuth_weight;
};

// `half` directions on each side of the horizon of that radius.
void directions_init(struct directions *directions, const struct optics *optics, double radius_m,
                     int half, int azimuths);

// A ray of the orders after the first.
struct ray_desc sweep_ray(const struct solver_settings *settings, double radius_m, double mu);

struct sweep; // scratch of all threads
TRL_MUST_USE trl_result sweep_create(const trl_context *ctx, const struct solution *solution,
                                     const struct solver_settings *settings, struct sweep **out);
void sweep_destroy(const trl_context *ctx, struct sweep **sweep);

// out = the first order (before NULL), or the order that follows `before`. `done` is how far the
// whole work is, for the user. TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result sweep_order(struct sweep *sweep, const struct moments *before, double done,
                                    struct moments *out);

#endif // SCATTER_SWEEP_H
