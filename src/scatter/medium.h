// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_MEDIUM_H
#define SCATTER_MEDIUM_H
// The participating medium as physics: constituents in spherical shells over a Lambertian ground,
// lit by a star.

#include "spectrum/spectrum.h"

enum { MEDIUM_MAX_CONSTITUENTS = 16 };

// Above what any planet has, and low enough that what is computed from it stays finite.
#define MEDIUM_MAX_PER_M 1e3
#define MEDIUM_MAX_IRRADIANCE 1e9

enum profile_kind {
    PROFILE_UNIFORM = 0,
    PROFILE_EXPONENTIAL, // exp(-altitude / scale_height_m)
    PROFILE_TENT,        // max(0, 1 - |altitude - centre_m| / half_width_m)
    PROFILE_TABLE        // linear between the knots, constant outside
};

// Density relative to the reference density at which a constituent's coefficients are given.
struct profile {
    enum profile_kind kind;
    double scale_height_m;         // exponential, > 0
    double centre_m, half_width_m; // tent, half width > 0
    double *altitude_m;            // table: ascending, owned (one block with density)
    double *density;               // table: >= 0
    size_t count;                  // table: >= 1
};

double profile_density(const struct profile *profile, double altitude_m);

// Where its slope jumps, in ascending altitude: knots of tables, ends and middles of tents.
size_t profile_kink_count(const struct profile *profile);
// `change`: of the slope, per m.
double profile_kink_m(const struct profile *profile, size_t index, double *change);

// Its integral from the ground to a height, in m: optical depth per coefficient.
double profile_column_m(const struct profile *profile, double height_m);

TRL_MUST_USE trl_result profile_copy(const trl_context *ctx, const struct profile *profile,
                                     struct profile *out);

enum phase_kind {
    PHASE_ISOTROPIC = 0,
    PHASE_RAYLEIGH,
    PHASE_HENYEY_GREENSTEIN,
    PHASE_CORNETTE_SHANKS,
    PHASE_TABLE // linear in the angle between the knots, constant outside; normalised when it is
                // made
};

struct phase {
    enum phase_kind kind;
    double g;          // Henyey-Greenstein, Cornette-Shanks: in (-1, 1)
    double *angle_rad; // table: ascending in [0, pi], owned (one block with value)
    double *value;     // table: sr^-1, integrates to 1 over the sphere
    size_t count;      // table: >= 1
};

// Phase function in sr^-1 (integrates to 1 over the sphere) at the cosine of the scattering angle;
// 1 is straight on.
double phase_value(const struct phase *phase, double cos_angle);

// Legendre moments p_0 .. p_lmax: p_l = 2 pi * integral of value * P_l(cos) d cos; p_0 = 1.
void phase_moments(const struct phase *phase, int lmax, double *moments);

struct constituent {
    char *name;                       // owned
    struct spectrum scattering_per_m; // at reference density, >= 0
    struct spectrum absorption_per_m; // at reference density, >= 0
    struct profile profile;
    struct phase phase;
};

struct medium {
    double ground_radius_m;          // > 0
    double top_radius_m;             // > ground_radius_m: no matter above
    struct spectrum ground_albedo;   // Lambertian, in [0, 1]
    struct spectrum star_irradiance; // W m^-2 nm^-1 at the planet, on a plane facing the star
    double star_angular_radius_rad;  // >= 0
    double star_corona;              // radiance of its corona relative to the Sun's, >= 0
    size_t constituent_count;
    struct constituent constituents[MEDIUM_MAX_CONSTITUENTS];
};

// Table makers check nothing but memory; the scene reader checks the values. They copy.
TRL_MUST_USE trl_result profile_table_init(const trl_context *ctx, const double *altitude_m,
                                           const double *density, size_t count,
                                           struct profile *out);
// Scales the values so that the phase function integrates to 1 over the sphere.
TRL_MUST_USE trl_result phase_table_init(const trl_context *ctx, const double *angle_rad,
                                         const double *value, size_t count, struct phase *out);

// Can this wavelength be computed? Tables and formulas are checked where eyes see when a scene is
// read; a wavelength far from there may still give an albedo above 1 or a coefficient that is
// absurd. TRL_ERROR_INVALID, logged, when a value is not finite or out of range.
TRL_MUST_USE trl_result medium_check(const trl_context *ctx, const struct medium *medium,
                                     double nm);

// Mean altitude of what scatters, m, at 550 nm; 0 where nothing does.
double medium_scattering_height(const struct medium *medium);

// Free everything they own; a zeroed one is a no-op.
void constituent_finish(const trl_context *ctx, struct constituent *constituent);
void medium_finish(const trl_context *ctx, struct medium *medium);

#endif // SCATTER_MEDIUM_H
