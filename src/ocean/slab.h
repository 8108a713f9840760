// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_SLAB_H
#define OCEAN_SLAB_H
// Layers of water as operators on light (adding and doubling: van de Hulst 1963; Hansen 1971, J.
// Atmos. Sci. 28), one azimuth order m and one wavelength at a time. docs/physics.md, *Light in the
// water*.
//
// Directions are cosines above 0 from the vertical, of light that goes up as well as down: first
// the nodes of a quadrature, then others of interest, which have no weight. An element [out][in] of
// an operator is the radiance that leaves in cos(m azimuth) per irradiance of a beam on a plane
// that faces it.

#include "base/context.h"

enum {
    SLAB_BELOW = 14,  // nodes of rays that the surface reflects totally
    SLAB_NODES = 32,  // of all: enough for products of two of the highest moments
    SLAB_OTHERS = 16, // at most
    SLAB_MAX = SLAB_NODES + SLAB_OTHERS,
    SLAB_MOMENTS = 32, // of the phase function, after which it is cut
};

struct slab_grid {
    int count;   // of all directions
    int outputs; // of those in which light leaves, from the first on: at least the nodes
    double mu[SLAB_MAX];
    double weight[SLAB_MAX]; // of the integral over the cosine; 0 beyond SLAB_NODES
    // Spherical harmonics of quadrature.h: (l, m) of each direction.
    double harmonic[SLAB_MAX][SLAB_MOMENTS * (SLAB_MOMENTS + 1) / 2];
};

// `critical` is the cosine above which light can leave the water.
void slab_grid_init(double critical, const double *others, int other_count, struct slab_grid *out);

// What scatters, with a forward peak taken for light that goes on (Potter 1970, J. Atmos. Sci. 27).
struct slab_medium {
    double peak;             // share of scattering in it
    double extinction_per_m; // without the peak
    double albedo;           // of single scattering, without the peak
    double moment[SLAB_MOMENTS];
};

struct slab {
    double
        reflected[SLAB_MAX * SLAB_MAX]; // [out][in], with the stride SLAB_MAX; diffuse light only
    double passed[SLAB_MAX * SLAB_MAX];
    double direct[SLAB_MAX]; // what goes through unscattered
};

struct slab_order {
    const struct slab_grid *grid;
    const struct slab_medium *medium;
    int m;
};

// A homogeneous layer.
void slab_make(const struct slab_order *order, double depth_m, struct slab *out);
// Two equal layers in one. `out` is another one.
void slab_double(const struct slab_order *order, const struct slab *half, struct slab *out);
// A layer upon a bed that reflects as the Lambertian `albedo`: only what comes back.
void slab_add_bed(const struct slab_order *order, const struct slab *layer, double albedo,
                  double *reflected);
// A layer upon what reflects so: only what comes back. `reflected` is another one than `below`.
void slab_add_below(const struct slab_order *order, const struct slab *layer, const double *below,
                    double *reflected);
// Homogeneous layers of different depths, one upon the other.
void slab_add(const struct slab_order *order, const struct slab *upper, const struct slab *lower,
              struct slab *out);

// The integral over all directions of this order: weight of node k.
double slab_weight(const struct slab_order *order, int k);

// Solves (1 - A) x = b for the nodes: A is [SLAB_NODES][SLAB_NODES], destroyed; b is
// [SLAB_NODES][count] with the stride SLAB_MAX, and becomes x.
void slab_solve(double *restrict a, double *restrict b, int count);

#endif // OCEAN_SLAB_H
