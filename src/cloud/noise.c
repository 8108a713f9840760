// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Level 0 of the noise volume. Noises repeat after a cube, since what their lattices hash is
// reduced to it.
#include "base/lanes.h"
#include "cloud/volume.h"

#include <math.h>
#include <string.h>

enum { RANK_BINS = 1 << 14 };
static const double SQUISH = 1.0 / 6, STRETCH = 1.0 / 3;

static uint32_t mix(uint32_t x)
{
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ (x >> 16);
}

static int wrap(int i, int period)
{
    const int rest = i % period;
    return rest < 0 ? rest + period : rest;
}

static uint32_t hash_cell(int x, int y, int z, uint32_t seed)
{
    return mix((uint32_t)x + mix((uint32_t)y + mix((uint32_t)z + mix(seed))));
}

// Toward one of the twelve edges of a cube.
static double dot_gradient(uint32_t hash, const double d[3])
{
    const int axis = (int)(hash % 3); // the one that is left out
    const double u = d[(axis + 1) % 3];
    const double v = d[(axis + 2) % 3];
    return (hash & 4 ? u : -u) + (hash & 8 ? v : -v);
}

// One corner of a simplex. Six times its place in space is whole, and repeats with the cube.
static double add_corner(const int cell[3], const double at[3], int period, uint32_t seed)
{
    const int sum = cell[0] + cell[1] + cell[2];
    double d[3];
    double fall = 0.6;
    int key[3];
    for (int k = 0; k < 3; k++) {
        key[k] = wrap(6 * cell[k] - sum, 6 * period);
        d[k] = at[k] - (cell[k] - sum * SQUISH);
        fall -= d[k] * d[k];
    }
    if (fall <= 0) {
        return 0;
    }
    fall *= fall;
    return fall * fall * dot_gradient(hash_cell(key[0], key[1], key[2], seed), d);
}

// Simplex noise (Perlin 2002), about in [-1, 1], with a period that three divides.
static double simplex(const double at[3], int period, uint32_t seed)
{
    const double skew = (at[0] + at[1] + at[2]) * STRETCH;
    int cell[3];
    double rest[3];
    for (int k = 0; k < 3; k++) {
        const double skewed = at[k] + skew;
        cell[k] = (int)floor(skewed);
        rest[k] = skewed - cell[k];
    }
    double sum = add_corner(cell, at, period, seed);
    // Corners are passed in the order in which the parts fall.
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; i++) {
        for (int j = 0; j < 2 - i; j++) {
            if (rest[order[j]] < rest[order[j + 1]]) {
                const int swap = order[j];
                order[j] = order[j + 1];
                order[j + 1] = swap;
            }
        }
    }
    for (int i = 0; i < 3; i++) {
        cell[order[i]]++;
        sum += add_corner(cell, at, period, seed);
    }
    return 32 * sum;
}

// 1 - the distance to the nearest of one point in each cell (Worley 1996), at least 0.
static double worley(const double at[3], int period, uint32_t seed)
{
    int cell[3];
    for (int k = 0; k < 3; k++) {
        cell[k] = (int)floor(at[k]);
    }
    double nearest = 1;
    for (int n = 0; n < 27; n++) {
        const int c[3] = {cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1};
        const uint32_t hash =
            hash_cell(wrap(c[0], period), wrap(c[1], period), wrap(c[2], period), seed);
        const double dx = c[0] + (hash & 1023) / 1024.0 - at[0];
        const double dy = c[1] + (hash >> 10 & 1023) / 1024.0 - at[1];
        const double dz = c[2] + (hash >> 20 & 1023) / 1024.0 - at[2];
        nearest = fmin(nearest, dx * dx + dy * dy + dz * dz);
    }
    return 1 - sqrt(nearest);
}

// Places by simplex noise of three octaves; billows, which are round outward, by Worley's.
static double cloud_value(const double place[3], uint32_t seed)
{
    static const struct {
        int period;
        double weight;
        bool is_billow;
    } OCTAVES[] = {{3, 1, false},  {6, 0.55, false}, {12, 0.25, false},
                   {6, 0.9, true}, {14, 0.55, true}, {30, 0.3, true}};
    double sum = 0;
    for (uint32_t k = 0; k < sizeof OCTAVES / sizeof *OCTAVES; k++) {
        const int period = OCTAVES[k].period;
        const double at[3] = {place[0] * period, place[1] * period, place[2] * period};
        sum += OCTAVES[k].weight * (OCTAVES[k].is_billow ? worley(at, period, seed + k)
                                                         : simplex(at, period, seed + k));
    }
    return sum;
}

static void fill_values(uint32_t seed, float *values)
{
#pragma omp parallel for schedule(dynamic, 1) num_threads(lanes_max_threads())
    for (int z = 0; z < CLOUD_SIDE; z++) {
        for (int i = 0; i < CLOUD_SIDE * CLOUD_SIDE; i++) {
            const double place[3] = {(i % CLOUD_SIDE + 0.5) / CLOUD_SIDE,
                                     (i / CLOUD_SIDE + 0.5) / CLOUD_SIDE, (z + 0.5) / CLOUD_SIDE};
            values[z * CLOUD_SIDE * CLOUD_SIDE + i] = (float)cloud_value(place, seed);
        }
    }
}

// Values become their rank, below 1 so that no cover is no cloud, by a histogram that is fine
// enough for 2048 steps.
static void store_ranks(const float *values, uint32_t *below, uint16_t *texels)
{
    const size_t count = (size_t)CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE;
    double least = INFINITY;
    double most = -INFINITY;
    for (size_t i = 0; i < count; i++) {
        least = fmin(least, (double)values[i]);
        most = fmax(most, (double)values[i]);
    }
    const double scale = (RANK_BINS - 1) / (most - least);
    for (size_t i = 0; i < count; i++) {
        below[(size_t)(((double)values[i] - least) * scale) + 1]++;
    }
    for (size_t b = 0; b < RANK_BINS; b++) {
        below[b + 1] += below[b];
    }
    for (size_t i = 0; i < count; i++) {
        const double bin = ((double)values[i] - least) * scale;
        const size_t b = (size_t)bin;
        const double rank = below[b] + (bin - (double)b) * (below[b + 1] - below[b]);
        texels[2 * i] = (uint16_t)lround((CLOUD_STEPS - 1) * rank / (double)count);
    }
}

// The largest of a row of 2 CLOUD_BORDER + 1 texels, along one axis after the other.
static void spread_along(const uint16_t *in, int stride, uint16_t *out)
{
    const int mask = CLOUD_SIDE - 1; // a power of two
#pragma omp parallel for schedule(static) num_threads(lanes_max_threads())
    for (int i = 0; i < CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE; i++) {
        const int at = i / stride & mask;
        uint16_t most = 0;
        for (int k = -CLOUD_BORDER; k <= CLOUD_BORDER; k++) {
            const uint16_t there = in[i + (((at + k) & mask) - at) * stride];
            most = there > most ? there : most;
        }
        out[i] = most;
    }
}

static void fill_borders(uint16_t *scratch, uint16_t *texels)
{
    const int count = CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE;
    uint16_t *a = scratch;
    uint16_t *b = scratch + count;
    for (int i = 0; i < count; i++) {
        a[i] = texels[2 * i];
    }
    spread_along(a, 1, b);
    spread_along(b, CLOUD_SIDE, a);
    spread_along(a, CLOUD_SIDE * CLOUD_SIDE, b);
    for (int i = 0; i < count; i++) {
        texels[2 * i + 1] = b[i];
    }
}

trl_result cloud_noise_fill(const trl_context *ctx, uint32_t seed, uint16_t *texels)
{
    const size_t count = (size_t)CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE;
    float *values = mem_alloc(ctx, count, sizeof *values);
    uint32_t *below = mem_alloc(ctx, RANK_BINS + 1, sizeof *below);
    if (values && below) {
        fill_values(mix(seed), values);
        store_ranks(values, below, texels);
        fill_borders((uint16_t *)values, texels);
    }
    const trl_result result = values && below ? TRL_OK : TRL_ERROR_MEMORY;
    mem_free(ctx, values);
    mem_free(ctx, below);
    return result;
}
