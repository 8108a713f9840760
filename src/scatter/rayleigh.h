// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_RAYLEIGH_H
#define SCATTER_RAYLEIGH_H
// Single scattering in the one gas of Santana 2017, evaluated for one line of sight on the CPU
// with the formulas that the pictures' shader has (shaders/shared/rayleigh.glsl).

#include "scatter/medium.h"
#include "scatter/query.h"
#include "scatter/rayleigh_depth.h"

// Stands for a star without extent.
#define RAYLEIGH_SMALLEST_DISC_RAD 1e-4

// What a medium is taken for: its constituents that scatter with the Rayleigh phase function, as
// one gas of a single scale height. Exact when their profiles are exponential with the same one;
// else the exponential of the same column and the same mean height at 550 nm.
struct rayleigh_gas {
    const struct medium *medium;
    double scale_height_m;
    double share[MEDIUM_MAX_CONSTITUENTS]; // reference density of the gas per that of the
                                           // constituent; 0: left out
};

void rayleigh_gas_init(struct rayleigh_gas *gas, const struct medium *medium);

// Per metre at the reference sphere.
struct rayleigh_coefficients {
    double scattering_per_m, extinction_per_m;
};
struct rayleigh_coefficients rayleigh_gas_at(const struct rayleigh_gas *gas, double nm);

// The model of one medium with its options.
struct rayleigh {
    trl_rayleigh_desc desc;
    struct rayleigh_gas gas;
    struct rayleigh_depth depth;
};

// The medium must outlive it.
void rayleigh_init(struct rayleigh *model, const struct medium *medium,
                   const trl_rayleigh_desc *desc);

// Coefficients of the model at a wavelength: those of the gas over the height scale, and without
// extinction in the simplified variant.
struct rayleigh_coefficients rayleigh_at(const struct rayleigh *model, double nm);

// Radiance per unit irradiance of the star (sr^-1): light scattered once, and direct light on the
// ground where the view meets it. No disc of the star.
double rayleigh_radiance(const struct rayleigh *model, const struct query_view *view, double nm);

// The star's light in pictures: a black body through the single-lobe fit of the observer's
// functions (Section 4), at the middles of even parts of 380 to 780 nm.
struct rayleigh_star {
    double temperature_K;
    double luminance; // cd m^-2 of a radiance of 1 per unit irradiance of the star (sr^-1) at all
                      // wavelengths, by the observer's own functions and the star's own spectrum
    double nm[TRL_RAYLEIGH_MAX_WAVELENGTHS];
    double rgb[TRL_RAYLEIGH_MAX_WAVELENGTHS][3]; // linear sRGB; the luminances sum to 1
};

void rayleigh_star_init(const struct rayleigh *model, struct rayleigh_star *out);

// Is the desc in the ranges that the public header gives? The name of a wrong field, or NULL.
const char *rayleigh_desc_wrong(const trl_rayleigh_desc *desc);

#endif // SCATTER_RAYLEIGH_H
