// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_RAYLEIGH_DEPTH_H
#define SCATTER_RAYLEIGH_DEPTH_H
// g(phi, h) of Santana 2017: columns of a gas whose density falls exponentially, exact, as a map
// and as a fit. The formulas and what is kept are in shaders/shared/rayleigh.glsl.

#include "shared/rayleigh.glsl"
#include <terrella/scene.h>

enum { RAYLEIGH_MAP_WIDTH = 128, RAYLEIGH_MAP_HEIGHT = 64 };

struct rayleigh_depth {
    RayleighAir air;
    trl_rayleigh_depth kind;
    // Inverse air mass over [y][x] of the shared formulas, from end to end.
    float map[RAYLEIGH_MAP_HEIGHT][RAYLEIGH_MAP_WIDTH];
    int fit_heights; // even in y, from the sphere to the top
    RayleighFit fit[TRL_RAYLEIGH_MAX_HEIGHTS];
};

// Fills in the softness.
RayleighAir rayleigh_air_make(double ground_radius_m, double height_m, double scale_height_m);

// The inverse air mass by integration: cosine of the line's zenith angle in [0, 1], altitude in
// [0, height).
double rayleigh_inverse_exact(const RayleighAir *air, double cosine, double altitude_m);

// Map and fit, whichever of the two is asked for.
void rayleigh_depth_init(struct rayleigh_depth *depth, const RayleighAir *air,
                         const trl_rayleigh_desc *desc);

// From the map or from the fit.
double rayleigh_depth_inverse(const struct rayleigh_depth *depth, double cosine, double altitude_m);

// g of a point, by all four symmetries: even in phi; 0 above the air; infinite where the line has
// been in the planet; beyond phi = pi / 2 by its mirror image.
double rayleigh_depth_g(const struct rayleigh_depth *depth, double phi_rad, double altitude_m);

// The same without the third: where a line has been deeper than the sphere it counts as having
// touched it. What integrations take, which know the shadow themselves. cos(phi) and the altitude
// of the line's closest point.
double rayleigh_depth_along(const struct rayleigh_depth *depth, double cos_phi, double altitude_m,
                            double closest_m);

// Relative errors of g over its domain, phi in [pi/2, pi] and h from the sphere to the top, both
// even, in RAYLEIGH_CHECKS x RAYLEIGH_CHECKS points.
enum { RAYLEIGH_CHECKS = 200 };
struct rayleigh_errors {
    double mean, largest;
};
struct rayleigh_errors rayleigh_depth_errors(const struct rayleigh_depth *depth);

#endif // SCATTER_RAYLEIGH_DEPTH_H
