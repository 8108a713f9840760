// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_MIE_POPULATION_H
#define SCATTER_MIE_POPULATION_H
// Spheres of many sizes: their mean cross sections and phase function. The sizes are described as
// Hansen and Travis 1974 (Space Sci. Rev. 16, Section 2.4) do, by the mean radius weighed by area,
// r_eff = <r^3> / <r^2>, and its relative variance, v_eff = <(r - r_eff)^2 r^2> / (r_eff^2 <r^2>).

#include "scatter/medium.h"
#include "scatter/mie.h"

enum mie_size_kind {
    MIE_SIZE_LOG_NORMAL, // n(r) ~ exp(-(ln r - ln r_g)^2 / (2 sigma^2)) / r
    MIE_SIZE_GAMMA       // n(r) ~ r^((1 - 3 v_eff) / v_eff) exp(-r / (r_eff v_eff)); v_eff < 0.5
};

struct mie_sizes {
    enum mie_size_kind kind;
    double effective_radius_m;
    double effective_variance; // > 0
};

// Particles per ln r, relative.
double mie_sizes_density(const struct mie_sizes *sizes, double radius_m);

enum { MIE_RADII = 256, MIE_HALF_ANGLES = 181, MIE_ANGLES = 2 * MIE_HALF_ANGLES - 1 };

struct mie_population {
    double radius_m[MIE_RADII];
    double share[MIE_RADII]; // of the particles; sums to 1
    double angle_rad[MIE_ANGLES];
    struct mie_series series;
};

// Means over the particles at one wavelength.
struct mie_optics {
    double scattering_m2, absorption_m2; // cross sections
    double asymmetry;
    double intensity[MIE_ANGLES]; // relative, at the population's angles
};

// Spheres between radii beyond which there is next to nothing, seen at wavelengths not below
// shortest_nm. When the largest ones are too large for it, TRL_ERROR_UNSUPPORTED, not logged, and
// `largest_size` says how large they are.
TRL_MUST_USE trl_result mie_population_init(const trl_context *ctx, const struct mie_sizes *sizes,
                                            double shortest_nm, double *largest_size,
                                            struct mie_population *out);
void mie_population_finish(const trl_context *ctx, struct mie_population *population);

// At a wavelength, for the index n + i k. `has_intensity`: also the intensity, which is most of the
// work.
void mie_population_compute(struct mie_population *population, double wavelength_nm,
                            double complex index, bool has_intensity, struct mie_optics *out);

#endif // SCATTER_MIE_POPULATION_H
