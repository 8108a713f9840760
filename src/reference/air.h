// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_AIR_H
#define REFERENCE_AIR_H
// The medium cut into spherical shells that are thin enough for a three-point Gauss quadrature, and
// columns of its constituents along straight rays through them. No wavelength is in it: optical
// depths are columns times coefficients (optics.h).
//
// A ray is described by its distance from the planet's centre and the coordinate s along it, which
// is 0 where the line comes closest to the centre: radius = sqrt(perigee^2 + s^2).

#include "scatter/medium.h"

// Altitudes between which rays run; the air is at least as high.
struct reference_extent {
    double lowest_m, highest_m; // <= 0, >= 0
};

struct reference_air {
    const struct medium *medium;          // outlives the air
    double bottom_radius_m, top_radius_m; // between which rays run
    double lowest_m;                      // altitude of the bottom
    double split_length_m;                // no piece of a ray is longer
    size_t constituent_count;
    size_t shell_count;
    double *bound_m; // altitudes, shell_count + 1
    double *density; // of each constituent at knots evenly spaced within each shell
};

// Matter in metres at reference density, or density, of each constituent.
struct reference_columns {
    double of[MEDIUM_MAX_CONSTITUENTS];
};

// For rays of these wavelengths: the shells are thin for each.
struct reference_wavelengths {
    const double *nm;
    size_t count;
};

TRL_MUST_USE trl_result reference_air_init(const trl_context *ctx, const struct medium *medium,
                                           const struct reference_wavelengths *wavelengths,
                                           const struct reference_extent *extent,
                                           struct reference_air *air);
void reference_air_finish(const trl_context *ctx, struct reference_air *air);

struct reference_ray {
    double perigee2_m2;    // may lie below the bottom
    double begin_m, end_m; // s of the start and of the end
    bool hits_bottom;
};

// The ray that starts at `radius_m` (between bottom and top) under the cosine `mu` of its zenith
// angle and runs to the bottom or the top.
struct reference_ray reference_air_ray(const struct reference_air *air, double radius_m, double mu);

// A piece of a ray within one shell.
struct reference_piece {
    size_t shell;
    double begin_m, end_m; // s
};

// A ray being cut into pieces, in their order.
struct reference_walk {
    const struct reference_air *air;
    const struct reference_ray *ray;
    size_t shell;
    double at_m;
};
struct reference_walk reference_walk_begin(const struct reference_air *air,
                                           const struct reference_ray *ray);
// False when the ray has ended.
bool reference_walk_next(struct reference_walk *walk, struct reference_piece *piece);

// From the start of the piece to `s_m` in it.
void reference_air_columns(const struct reference_air *air, const struct reference_ray *ray,
                           const struct reference_piece *piece, double s_m,
                           struct reference_columns *columns);

// Densities at a place of the piece, and at an altitude.
void reference_air_densities(const struct reference_air *air, const struct reference_ray *ray,
                             size_t shell, double s_m, struct reference_columns *densities);
void reference_air_densities_at(const struct reference_air *air, double altitude_m,
                                struct reference_columns *densities);

#endif // REFERENCE_AIR_H
