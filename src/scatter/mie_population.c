// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/mie_population.h"

#include <math.h>
#include <string.h>

#define PI 3.14159265358979323846

// Where the radii are looked for, and what is left out there, relative to the largest.
enum { SCANNED = 2048 };
static const double SCANNED_LN_RANGE = 20;
static const double NEGLIGIBLE = 1e-6;
// Radii enter the scan as size parameters at this wavelength.
static const double SCAN_NM = 550;

// The log-normal distribution's own parameters follow from v_eff = exp(sigma^2) - 1 and r_eff = r_g
// exp(2.5 sigma^2).
double mie_sizes_density(const struct mie_sizes *sizes, double radius_m)
{
    const double v = sizes->effective_variance;
    const double relative = radius_m / sizes->effective_radius_m;
    if (sizes->kind == MIE_SIZE_GAMMA) {
        // r n(r), scaled to 1 at its mode so that nothing over- or underflows near it.
        const double exponent = (1 - 2 * v) / v;
        const double mode = 1 - 2 * v;
        return exp(exponent * log(relative / mode) - (relative - mode) / v);
    }
    const double sigma2 = log1p(v);
    const double from_mean = log(relative) + 2.5 * sigma2;
    return exp(-from_mean * from_mean / (2 * sigma2));
}

// How much spheres of a radius count, at least: by area when large, by volume (absorption) or its
// square (scattering) when small against the wavelength.
static double weigh_least(const struct mie_sizes *sizes, double radius_m, int power)
{
    const double size = 2 * PI * radius_m / (SCAN_NM * 1e-9);
    const double factor = pow(size, power);
    return mie_sizes_density(sizes, radius_m) * radius_m * radius_m * factor / (1 + factor);
}

static double scanned_radius(const struct mie_sizes *sizes, int i)
{
    return sizes->effective_radius_m * exp(SCANNED_LN_RANGE * (2.0 * i / (SCANNED - 1) - 1));
}

// First and last radius of the scan that is not negligible by that power.
static void find_range(const struct mie_sizes *sizes, int power, int *first, int *last)
{
    double largest = 0;
    for (int i = 0; i < SCANNED; i++) {
        largest = fmax(largest, weigh_least(sizes, scanned_radius(sizes, i), power));
    }
    *first = SCANNED - 1;
    *last = 0;
    for (int i = 0; i < SCANNED; i++) {
        if (weigh_least(sizes, scanned_radius(sizes, i), power) > NEGLIGIBLE * largest) {
            *first = i < *first ? i : *first;
            *last = i;
        }
    }
}

// Uniform in ln r: the trapezoidal rule is exact to rounding for what falls smoothly to nothing at
// both ends.
static void fill_radii(const struct mie_sizes *sizes, struct mie_population *out)
{
    int first, last, unused;
    find_range(sizes, 1, &first, &unused);
    find_range(sizes, 4, &unused, &last);
    const double low = log(scanned_radius(sizes, first > 0 ? first - 1 : 0));
    const double high = log(scanned_radius(sizes, last < SCANNED - 1 ? last + 1 : last));
    double total = 0;
    for (int i = 0; i < MIE_RADII; i++) {
        out->radius_m[i] = exp(low + (high - low) * i / (MIE_RADII - 1));
        out->share[i] = mie_sizes_density(sizes, out->radius_m[i]);
        total += out->share[i];
    }
    for (int i = 0; i < MIE_RADII; i++) {
        out->share[i] /= total;
    }
}

// Angles are the squares of a uniform grid from each end to the middle: the forward peak and the
// glory are narrow.
static double half_angle(int i)
{
    const double x = (double)i / (MIE_HALF_ANGLES - 1);
    return PI / 2 * x * x;
}

trl_result mie_population_init(const trl_context *ctx, const struct mie_sizes *sizes,
                               double shortest_nm, double *largest_size, struct mie_population *out)
{
    *out = (struct mie_population){0};
    fill_radii(sizes, out);
    for (int i = 0; i < MIE_HALF_ANGLES; i++) {
        out->angle_rad[i] = half_angle(i);
        out->angle_rad[MIE_ANGLES - 1 - i] = PI - half_angle(i);
    }
    *largest_size = 2 * PI * out->radius_m[MIE_RADII - 1] / (shortest_nm * 1e-9);
    if (!(*largest_size <= MIE_MAX_SIZE)) {
        return TRL_ERROR_UNSUPPORTED;
    }
    return mie_series_init(ctx, *largest_size, MIE_HALF_ANGLES, &out->series);
}

void mie_population_finish(const trl_context *ctx, struct mie_population *population)
{
    mie_series_finish(ctx, &population->series);
}

// The intensity at distance d is |S|^2 / (k d)^2, so the sum over particles needs no further factor
// but what is common to all.
void mie_population_compute(struct mie_population *population, double wavelength_nm,
                            double complex index, bool has_intensity, struct mie_optics *out)
{
    double cosine[MIE_HALF_ANGLES], backward[MIE_HALF_ANGLES] = {0};
    *out = (struct mie_optics){0};
    for (int i = 0; i < MIE_HALF_ANGLES; i++) {
        cosine[i] = cos(half_angle(i));
    }
    const struct mie_angles angles = {cosine, MIE_HALF_ANGLES, out->intensity, backward};
    for (int i = 0; i < MIE_RADII; i++) {
        const double radius_m = population->radius_m[i];
        mie_series_compute(&population->series, 2 * PI * radius_m / (wavelength_nm * 1e-9), index);
        const struct mie_efficiencies q = mie_series_efficiencies(&population->series);
        const double area_m2 = PI * radius_m * radius_m * population->share[i];
        out->scattering_m2 += area_m2 * q.scattering;
        out->absorption_m2 += area_m2 * fmax(0, q.extinction - q.scattering);
        out->asymmetry += area_m2 * q.scattering * q.asymmetry;
        if (has_intensity) {
            mie_series_add_intensity(&population->series, population->share[i], &angles);
        }
    }
    out->asymmetry = out->scattering_m2 > 0 ? out->asymmetry / out->scattering_m2 : 0;
    for (int i = 0; i < MIE_HALF_ANGLES - 1 && has_intensity; i++) {
        out->intensity[MIE_ANGLES - 1 - i] = backward[i];
    }
}
