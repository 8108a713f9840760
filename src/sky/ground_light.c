// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/ground_light.h"

#include "shared/sky_map.glsl"

#include <math.h>

static double altitude_of(int row, double highest_m)
{
    return highest_m * row / (GROUND_LIGHT_ALTITUDES - 1);
}

static void store(const struct bands *bands, const lanes *light, float *texel)
{
    for (int b = 0; b < BAND_COUNT; b++) {
        texel[b] = (*light)[bands->lane[b]];
    }
}

void ground_light_of_star(const struct atmosphere *a, double highest_m, float *texels)
{
    const double ground = a->optics->ground_radius_m;
    const double disc_rad = a->solution.sun.disc_rad;
    for (int row = 0; row < GROUND_LIGHT_ALTITUDES; row++) {
        const double altitude_m = altitude_of(row, highest_m);
        const double lowest = sky_map_lowest_sun(ground, altitude_m, cos(disc_rad), sin(disc_rad));
        const double scale = log(1 + (1 - lowest) / SUNLIGHT_SOFT);
        for (int c = 0; c < GROUND_LIGHT_SUNS; c++) {
            const double x = (double)c / (GROUND_LIGHT_SUNS - 1);
            lanes light;
            sunlight_at(&a->solution.sun, ground + altitude_m,
                        lowest + SUNLIGHT_SOFT * expm1(x * scale), &light);
            store(&a->bands, &light, texels + ((size_t)row * GROUND_LIGHT_SUNS + c) * BAND_COUNT);
        }
    }
}

static const lanes *moments_of(const struct moments *m, int level, int sun)
{
    const size_t row = (size_t)level * (size_t)m->suns + (size_t)sun;
    return m->radiance + row * (size_t)harmonic_count(m->lmax);
}

// Half-space integral of the radiance's expansion: the clamped cosine has the Legendre moments pi,
// 2 pi / 3, pi / 4, 0, -pi / 24 (l = 0, 1, 2, 3, 4), and only m = 0 counts for level ground. Cut
// off at l = 4 it is rough where sky and ground differ much, so its change with altitude scales the
// exact irradiance at the ground.
// `side` is 1 for light from above, -1 from below.
static lanes expand_irradiance(const struct moments *m, int level, int sun, int side)
{
    static const double cosine_moment[] = {M_PI, 2 * M_PI / 3, M_PI / 4, 0, -M_PI / 24};
    const lanes *a = moments_of(m, level, sun);
    double harmonic[(OPTICS_MAX_DEGREE + 1) * (OPTICS_MAX_DEGREE + 2) / 2];
    harmonic_values(m->lmax, 1, harmonic);
    lanes sum = {0};
    for (int l = 0; l <= m->lmax && l <= 4; l++) {
        const int h = harmonic_index(l, 0);
        sum += a[h] * (float)((l % 2 ? side : 1) * cosine_moment[l] * harmonic[h]);
    }
    return lanes_max(sum, lanes_set(0));
}

struct light_place {
    int level; // the moments' below
    float part;
    int sun;
};

static struct light_place place_of(const struct moments *m, double altitude_m, int sun)
{
    const double position = optics_shell(m->optics, altitude_m) * (m->levels - 1);
    const int level = position < m->levels - 2 ? (int)position : m->levels - 2;
    return (struct light_place){level, (float)(position - level), sun};
}

// The change with altitude of one side's expansion, times what it is at the ground.
static lanes side_light(const struct atmosphere *a, int side, struct light_place at)
{
    const struct moments *m = &a->solution.moments;
    const lanes below = expand_irradiance(m, at.level, at.sun, side);
    const lanes above = expand_irradiance(m, at.level + 1, at.sun, side);
    const lanes here = below + (above - below) * at.part;
    const lanes base = lanes_max(expand_irradiance(m, 0, at.sun, side), lanes_set(1e-30f));
    lanes ground = m->irradiance[at.sun];
    if (side < 0) {
        lanes star;
        sunlight_ground_at(&a->solution.sun, moments_sun_mu(m, at.sun), &star);
        ground = (ground + star) * a->optics->ground_albedo;
    }
    return ground * here / base;
}

static lanes moment_at(const struct moments *m, struct light_place at, int harmonic)
{
    const lanes below = moments_of(m, at.level, at.sun)[harmonic];
    const lanes above = moments_of(m, at.level + 1, at.sun)[harmonic];
    return below + (above - below) * at.part;
}

// The mean radiance of all directions is the first moment.
static lanes mean_radiance(const struct moments *m, struct light_place at)
{
    double harmonic; // alike in all directions
    harmonic_values(0, 1, &harmonic);
    return moment_at(m, at, 0) * (float)harmonic;
}

static lanes evenness(const struct atmosphere *a, struct light_place at)
{
    const lanes fluxes = side_light(a, 1, at) + side_light(a, -1, at);
    return mean_radiance(&a->solution.moments, at) * (float)(2 * M_PI) /
           lanes_max(fluxes, lanes_set(1e-30f));
}

// Toward the star's side. Of the harmonics all of a flux along x is sqrt(4 pi / 3) of (1, 1).
static lanes flux_toward_star(const struct moments *m, struct light_place at)
{
    return moment_at(m, at, harmonic_index(1, 1)) * (float)sqrt(4 * M_PI / 3);
}

// Of light that all comes from 5 degrees above the horizon. More is rounding, of a dark sky.
static const float MOST_SLOPE = 8.6f;

// Light L s x of all directions has the flux 4 pi / 3 L s along x; half a sky of L sends pi L to
// level ground.
static lanes slope(const struct atmosphere *a, struct light_place at)
{
    const lanes ratio = flux_toward_star(&a->solution.moments, at) * 0.75f /
                        lanes_max(side_light(a, 1, at), lanes_set(1e-30f));
    const lanes low = lanes_max(ratio, lanes_set(-MOST_SLOPE));
    return -lanes_max(-low, lanes_set(-MOST_SLOPE));
}

static lanes from_sky(const struct atmosphere *a, struct light_place at)
{
    return side_light(a, 1, at);
}

static lanes from_below(const struct atmosphere *a, struct light_place at)
{
    return side_light(a, -1, at);
}

typedef lanes light_at(const struct atmosphere *a, struct light_place at);

static void store_map(const struct atmosphere *a, light_at *find, double highest_m, float *texels)
{
    const struct moments *m = &a->solution.moments;
    for (int row = 0; row < GROUND_LIGHT_ALTITUDES; row++) {
        for (int i = 0; i < m->suns; i++) {
            const lanes light = find(a, place_of(m, altitude_of(row, highest_m), i));
            store(&a->bands, &light, texels + ((size_t)row * (size_t)m->suns + i) * BAND_COUNT);
        }
    }
}

static void store_logarithms(const struct atmosphere *a, light_at *find, double highest_m,
                             float *texels)
{
    store_map(a, find, highest_m, texels);
    const size_t count = (size_t)GROUND_LIGHT_ALTITUDES * a->solution.moments.suns * BAND_COUNT;
    for (size_t i = 0; i < count; i++) {
        texels[i] = logf(fmaxf(texels[i], 1e-30f));
    }
}

void ground_light_of_sky(const struct atmosphere *a, double highest_m, float *texels)
{
    store_logarithms(a, from_sky, highest_m, texels);
}

void ground_light_from_below(const struct atmosphere *a, double highest_m, float *texels)
{
    store_logarithms(a, from_below, highest_m, texels);
}

void ground_light_evenness(const struct atmosphere *a, double highest_m, float *texels)
{
    store_logarithms(a, evenness, highest_m, texels);
}

void ground_light_slope(const struct atmosphere *a, double highest_m, float *texels)
{
    store_map(a, slope, highest_m, texels);
}
