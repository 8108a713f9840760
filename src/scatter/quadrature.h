// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_QUADRATURE_H
#define SCATTER_QUADRATURE_H
// Gauss-Legendre rules on [0, 1], and the spherical harmonics of the moment method.

#include <stddef.h>

enum { GAUSS_MAX = 48 };

// Nodes ascending and weights (sum 1) of the `count`-point rule, 1 <= count <= GAUSS_MAX.
struct gauss {
    int count;
    double node[GAUSS_MAX];
    double weight[GAUSS_MAX];
};

void gauss_init(struct gauss *rule, int count);

// cumulative[k * count + j]: weight of the value at node j in the integral from 0 to node k, exact
// for polynomials of degree count - 1.
void gauss_cumulative(const struct gauss *rule, double *cumulative);

// Real spherical harmonics without their azimuth factor: Y_lm(mu, phi) = harmonic(l, m, mu) cos(m
// phi), normalised over the sphere. Index of (l, m), 0 <= m <= l: harmonic_index.
static inline int harmonic_index(int l, int m)
{
    return l * (l + 1) / 2 + m;
}

static inline int harmonic_count(int lmax)
{
    return (lmax + 1) * (lmax + 2) / 2;
}

// All (lmax + 1)(lmax + 2)/2 values at `mu`.
void harmonic_values(int lmax, double mu, double *values);

#endif // SCATTER_QUADRATURE_H
