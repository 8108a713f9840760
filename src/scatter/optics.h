// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_OPTICS_H
#define SCATTER_OPTICS_H
// The medium at up to sixteen wavelengths, with its altitude coordinate: what every integration
// along a ray needs.

#include "base/lanes.h"
#include "scatter/medium.h"

enum { OPTICS_MAX_DEGREE = 16, SHELL_SAMPLES = 4096, OPTICS_EDGES = 2, OPTICS_KINKS = 12 };

struct optics {
    const struct medium *medium;
    double ground_radius_m;
    double top_radius_m;
    int wavelength_count; // 1 .. LANES; lanes beyond repeat the last wavelength
    double wavelength_nm[LANES];
    int constituent_count;
    lanes scattering_per_m[MEDIUM_MAX_CONSTITUENTS]; // at reference density
    lanes extinction_per_m[MEDIUM_MAX_CONSTITUENTS];
    lanes ground_albedo;
    int lmax; // degree of the moments that further orders of scattering keep
    double moment[MEDIUM_MAX_CONSTITUENTS]
                 [OPTICS_MAX_DEGREE + 1]; // Legendre, of the phase functions; 0 beyond lmax
    // Share of a constituent's scattering so far forward that no moments resolve it: it counts as
    // not scattered (delta-M, Wiscombe 1977). `extinction_per_m` and `moment` are without it,
    // `scattering_per_m` is whole. 0 where the moments resolve the phase function.
    double forward_share[MEDIUM_MAX_CONSTITUENTS];
    double backward_peak;         // the strongest moment of a backward peak that is dropped
    double vertical_depth[LANES]; // optical depth of extinction, straight up
    double vertical_scattering_depth[MEDIUM_MAX_CONSTITUENTS]; // largest over the wavelengths

    // The shell coordinate u in [0, 1] rises from the ground to the top and stretches the altitudes
    // where the medium is: grids uniform in u, and quadratures over it, resolve thin layers of any
    // medium.
    double shell_of_altitude[SHELL_SAMPLES + 1];  // u at altitudes uniform from 0 to the top
    double altitude_of_shell[SHELL_SAMPLES + 1];  // m at u uniform in [0, 1]
    double share_weight[MEDIUM_MAX_CONSTITUENTS]; // of sqrt(density) of each constituent in du/dh,
                                                  // per m
    double share_uniform;                         // of plain altitude in du/dh, per m
    double share_edges; // of the optical depth near the top and the ground, see optics.c
    // Where the slope of a density jumps so much that it shows in optical depths, ascending:
    // quadratures stop there.
    int kink_count;
    double kink_shell[OPTICS_KINKS];
    int edge_lane[OPTICS_EDGES];                         // the thickest and the thinnest wavelength
    double depth_above[OPTICS_EDGES][SHELL_SAMPLES + 1]; // there, at altitudes from 0 to the top
};

// What the optics are for.
enum optics_use {
    OPTICS_PICTURES, // few moments; forward peaks count as not scattered
    OPTICS_NUMBERS,  // the same with as many moments as show
    OPTICS_WHOLE     // peaks stay: single orders of scattering, and what is seen directly
};

// `count` wavelengths in nm, 1 .. LANES; for numbers. The medium must outlive the optics.
void optics_init(struct optics *optics, const struct medium *medium, const double *wavelength_nm,
                 int count);
void optics_init_for(enum optics_use use, const struct medium *medium, const double *wavelength_nm,
                     int count, struct optics *optics);

// At `count` wavelengths that are spread evenly over what eyes see, for colours.
void optics_init_visible(enum optics_use use, const struct medium *medium, int count,
                         struct optics *optics);

// The largest vertical optical depth over the wavelengths: grids and rules grow with it.
double optics_largest_depth(const struct optics *optics);

double optics_shell(const struct optics *optics, double altitude_m);       // u, clamped to [0, 1]
double optics_altitude(const struct optics *optics, double shell);         // m
double optics_shell_slope(const struct optics *optics, double altitude_m); // du/dh, per m, > 0

// Optical depth and transmittance of columns, in m at reference density.
LANES_INLINE lanes optics_depth(const struct optics *optics, const double *column_m)
{
    lanes depth = {0};
    for (int i = 0; i < optics->constituent_count; i++) {
        depth += optics->extinction_per_m[i] * (float)column_m[i];
    }
    return depth;
}

LANES_INLINE lanes optics_attenuation(const struct optics *optics, const double *column_m)
{
    return lanes_exp_negative(-optics_depth(optics, column_m));
}

// What the l-th moments of the light are multiplied with at each further scattering, per m: the sum
// of scattering times the phase function's moment, without the forward shares.
LANES_INLINE lanes optics_source(const struct optics *optics, const double *density, int l)
{
    lanes source = {0};
    for (int i = 0; i < optics->constituent_count; i++) {
        source += optics->scattering_per_m[i] *
                  (float)(density[i] * optics->moment[i][l] * (1 - optics->forward_share[i]));
    }
    return source;
}

#endif // SCATTER_OPTICS_H
