// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_AIR_H
#define REFERENCE_AIR_H
// The medium at one wavelength, cut into spherical shells that are thin enough for a three-point
// Gauss quadrature, and optical depths along straight rays through them.
//
// A ray is described by its distance from the planet's centre and the coordinate s along it, which
// is 0 where the line comes closest to the centre: radius = sqrt(perigee^2 + s^2).

#include "scatter/medium.h"

struct reference_air {
    const struct medium *medium;                      // outlives the air
    double scattering_per_m[MEDIUM_MAX_CONSTITUENTS]; // at reference density
    double extinction_per_m[MEDIUM_MAX_CONSTITUENTS];
    double star_irradiance; // W m^-2 nm^-1
    double ground_albedo;
    double split_length_m; // no piece of a ray is longer
    size_t shell_count;
    double *bound_m;          // altitudes, shell_count + 1
    double *extinction_knots; // per metre, evenly spaced within each shell
    double *scattering_share; // of the extinction, in the middle of each shell
};

// A piece of a ray within one shell.
struct reference_piece {
    size_t shell;
    double begin_m, end_m; // s
    double optical_depth;
};

struct reference_ray {
    double perigee2_m2; // may lie below the ground
    double begin_m;     // s of the start
    bool hits_ground;
};

TRL_MUST_USE trl_result reference_air_init(const trl_context *ctx, const struct medium *medium,
                                           double wavelength_nm, struct reference_air *air);
void reference_air_finish(const trl_context *ctx, struct reference_air *air);

// The ray that starts at `radius_m` (in the air) under the cosine `mu` of its zenith angle.
struct reference_ray reference_air_ray(const struct reference_air *air, double radius_m, double mu);

// The most pieces that a ray can have.
size_t reference_air_max_pieces(const struct reference_air *air);
// Cuts the ray into pieces up to the ground or the top, in their order; returns their number.
size_t reference_air_pieces(const struct reference_air *air, const struct reference_ray *ray,
                            struct reference_piece *pieces);

// From the start of the ray to the ground or the top.
double reference_air_optical_depth(const struct reference_air *air,
                                   const struct reference_ray *ray);
// From the start of the piece to `s_m` in it.
double reference_air_partial_depth(const struct reference_air *air, const struct reference_ray *ray,
                                   const struct reference_piece *piece, double s_m);

#endif // REFERENCE_AIR_H
