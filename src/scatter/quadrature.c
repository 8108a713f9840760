// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/quadrature.h"

#include <math.h>

// Legendre polynomials P_0 .. P_n at x in [-1, 1] by the three-term recurrence.
static void fill_legendre(int n, double x, double *p)
{
    p[0] = 1;
    if (n > 0) {
        p[1] = x;
    }
    for (int l = 1; l < n; l++) {
        p[l + 1] = ((2 * l + 1) * x * p[l] - l * p[l - 1]) / (l + 1);
    }
}

void gauss_init(struct gauss *rule, int count)
{
    rule->count = count;
    double p[GAUSS_MAX + 1];
    for (int k = 0; k < count; k++) {
        double x = -cos(M_PI * (k + 0.75) / (count + 0.5)); // Tricomi's estimate
        double slope = 1;
        for (int round = 0; round < 8; round++) {
            fill_legendre(count, x, p);
            slope = count * (x * p[count] - p[count - 1]) / (x * x - 1);
            x -= p[count] / slope;
        }
        fill_legendre(count, x, p);
        slope = count * (x * p[count] - p[count - 1]) / (x * x - 1);
        rule->node[k] = 0.5 * (1 + x);
        rule->weight[k] = 1 / ((1 - x * x) * slope * slope);
    }
}

// The interpolating polynomial through the nodes expands in Legendre polynomials with coefficients
// (2l+1) sum_j w_j P_l(x_j) f_j; P_l integrates to (P_{l+1} - P_{l-1}) / (2 (2l+1)) on the unit
// interval.
void gauss_cumulative(const struct gauss *rule, double *cumulative)
{
    const int n = rule->count;
    double at_k[GAUSS_MAX + 1];
    double at_j[GAUSS_MAX + 1];
    for (int k = 0; k < n; k++) {
        fill_legendre(n, 2 * rule->node[k] - 1, at_k);
        for (int j = 0; j < n; j++) {
            fill_legendre(n, 2 * rule->node[j] - 1, at_j);
            double sum = rule->node[k];
            for (int l = 1; l < n; l++) {
                sum += at_j[l] * 0.5 * (at_k[l + 1] - at_k[l - 1]);
            }
            cumulative[k * n + j] = rule->weight[j] * sum;
        }
    }
}

void harmonic_values(int lmax, double mu, double *values)
{
    const double sine = sqrt(fmax(0, 1 - mu * mu));
    double diagonal = sqrt(1 / (4 * M_PI)); // normalised P_mm, without the sqrt(2) of m > 0
    for (int m = 0; m <= lmax; m++) {
        if (m > 0) {
            diagonal *= sine * sqrt((2.0 * m + 1) / (2.0 * m));
        }
        const double azimuth_norm = m > 0 ? M_SQRT2 : 1;
        double before = 0;
        double now = diagonal;
        values[harmonic_index(m, m)] = azimuth_norm * now;
        for (int l = m + 1; l <= lmax; l++) {
            const double a = sqrt((4.0 * l * l - 1) / ((double)l * l - (double)m * m));
            const double b =
                sqrt(((l - 1.0) * (l - 1.0) - (double)m * m) / (4.0 * (l - 1.0) * (l - 1.0) - 1));
            const double next = a * (mu * now - b * before);
            before = now;
            now = next;
            values[harmonic_index(l, m)] = azimuth_norm * now;
        }
    }
}
