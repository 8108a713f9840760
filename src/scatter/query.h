// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_QUERY_H
#define SCATTER_QUERY_H
// Spectral radiance as numbers: the solver at exactly the wavelengths asked for, then one fine
// integration a view.

#include "scatter/solver.h"

// One view; angles as in trl_sky_query.
struct query_view {
    double radius_m; // of the observer, >= the ground's
    double sun_mu;   // cosine of the star's zenith angle
    double view_mu;  // cosine of the view's zenith angle
    double nu;       // cosine of the angle between them
};

struct query_view query_view_make(double radius_m, double sun_zenith_rad, double view_zenith_rad,
                                  double azimuth_rad);

struct query; // scratch of one thread
TRL_MUST_USE trl_result query_create(const trl_context *ctx, const struct solution *solution,
                                     struct query **out);
void query_destroy(const trl_context *ctx, struct query **query);

// Radiance per unit irradiance of the star (sr^-1) at the solution's wavelengths: all orders, light
// of the ground where the ray meets it, no disc of the star.
void query_radiance(struct query *query, const struct query_view *view, lanes *radiance);

// The same by the model of Schafhitzel 2007: light scattered once, as if the star stood in the
// plane of view and zenith, on the side of the view, where its light is attenuated; the phase
// functions have the true angle. The ground is lit by the star alone, where it stands. The solution
// may be one of a single order, which takes no solving.
void query_plane_radiance(struct query *query, const struct query_view *view, lanes *radiance);

#endif // SCATTER_QUERY_H
