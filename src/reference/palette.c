// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/palette.h"

#include "spectrum/cie.h"

#include <math.h>

static const double step_nm = 0.1;

struct cell {
    struct cie_xyz xyz; // of 1 W m^-2 sr^-1 nm^-1 of the star's light, times its irradiance
    double weight;
};

static struct cell cell_at(const struct medium *medium, double nm)
{
    const double irradiance = spectrum_at(&medium->star_irradiance, nm + 0.5 * step_nm);
    const double watts = CIE_LUMENS_PER_WATT * irradiance;
    const struct cie_xyz o = cie_observer_integral(nm, nm + step_nm);
    return (struct cell){{watts * o.x, watts * o.y, watts * o.z}, watts * (o.x + o.y + o.z)};
}

static int count_cells(void)
{
    return (int)floor((CIE_LAST_NM - CIE_FIRST_NM) / step_nm + 0.5);
}

static double sum_weights(const struct medium *medium)
{
    double sum = 0;
    for (int i = 0; i < count_cells(); ++i) {
        sum += cell_at(medium, CIE_FIRST_NM + i * step_nm).weight;
    }
    return sum;
}

// Centroids, and the colour of each bin. A star without light gets bins of equal width.
static void fill_bins(const struct medium *medium, struct palette *palette)
{
    const double all = sum_weights(medium);
    double weight[PALETTE_BINS] = {0}, moment[PALETTE_BINS] = {0}, before = 0;
    for (int i = 0; i < count_cells(); ++i) {
        const double nm = CIE_FIRST_NM + i * step_nm;
        const struct cell cell = cell_at(medium, nm);
        const double place =
            all > 0 ? (before + 0.5 * cell.weight) / all : (i + 0.5) / count_cells();
        const int bin = (int)fmin(place * PALETTE_BINS, PALETTE_BINS - 1);
        const double counts = all > 0 ? cell.weight : 1;
        const struct cie_rgb rgb = cie_rgb_of_xyz(cell.xyz);
        palette->rgb[bin][0] += rgb.r;
        palette->rgb[bin][1] += rgb.g;
        palette->rgb[bin][2] += rgb.b;
        palette->luminance += cell.xyz.y;
        weight[bin] += counts;
        moment[bin] += counts * (nm + 0.5 * step_nm);
        before += cell.weight;
    }
    for (int bin = 0; bin < PALETTE_BINS; ++bin) {
        const double even =
            CIE_FIRST_NM + (CIE_LAST_NM - CIE_FIRST_NM) * (bin + 0.5) / PALETTE_BINS;
        palette->nm[bin] = weight[bin] > 0 ? moment[bin] / weight[bin] : even;
    }
}

enum { UNKNOWNS = PALETTE_BINS + 3 };

// Elimination with pivoting; false when the matrix is singular.
static bool solve(double a[UNKNOWNS][UNKNOWNS + 3])
{
    for (int c = 0; c < UNKNOWNS; ++c) {
        int pivot = c;
        for (int r = c + 1; r < UNKNOWNS; ++r) {
            pivot = fabs(a[r][c]) > fabs(a[pivot][c]) ? r : pivot;
        }
        if (!(fabs(a[pivot][c]) > 1e-12)) {
            return false;
        }
        for (int k = 0; k < UNKNOWNS + 3; ++k) {
            const double kept = a[c][k];
            a[c][k] = a[pivot][k];
            a[pivot][k] = kept;
        }
        for (int r = 0; r < UNKNOWNS; ++r) {
            const double factor = r == c ? 0 : a[r][c] / a[c][c];
            for (int k = c; factor != 0 && k < UNKNOWNS + 3; ++k) {
                a[r][k] -= factor * a[c][k];
            }
        }
    }
    return true;
}

// Least sum of squared steps a_(i+1) - a_i under the three conditions that the colour is right, by
// Lagrange's multipliers.
static void fill_colours(struct palette *palette)
{
    double a[UNKNOWNS][UNKNOWNS + 3] = {{0}};
    for (int i = 0; i + 1 < PALETTE_BINS; ++i) {
        a[i][i] += 1;
        a[i + 1][i + 1] += 1;
        a[i][i + 1] -= 1;
        a[i + 1][i] -= 1;
    }
    for (int c = 0; c < 3; ++c) {
        double white = 0;
        for (int i = 0; i < PALETTE_BINS; ++i) {
            white += palette->rgb[i][c];
        }
        for (int i = 0; i < PALETTE_BINS && white > 0; ++i) {
            a[PALETTE_BINS + c][i] = a[i][PALETTE_BINS + c] = palette->rgb[i][c] / white;
        }
        a[PALETTE_BINS + c][UNKNOWNS + c] = 1;
    }
    const bool is_solved = solve(a);
    for (int c = 0; c < 3; ++c) {
        for (int i = 0; i < PALETTE_BINS; ++i) {
            palette->albedo_of_colour[c][i] = is_solved ? a[i][UNKNOWNS + c] / a[i][i] : 1.0 / 3;
        }
    }
}

void palette_make(const struct medium *medium, struct palette *palette)
{
    *palette = (struct palette){.luminance = 0};
    fill_bins(medium, palette);
    fill_colours(palette);
}
