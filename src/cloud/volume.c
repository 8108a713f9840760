// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/volume.h"

#include <math.h>

static size_t level_texels(int level)
{
    const size_t side = CLOUD_SIDE >> level;
    return side * side * side;
}

// Means of eight texels of the level below.
static void fill_level(const uint16_t *fine, int side, uint16_t *out)
{
    const size_t row = (size_t)side * 2;
    for (int z = 0; z < side; z++) {
        for (int y = 0; y < side; y++) {
            for (int x = 0; x < side; x++, out += 2) {
                for (size_t c = 0; c < 2; c++) {
                    unsigned sum = 0;
                    for (size_t n = 0; n < 8; n++) {
                        const size_t fx = 2 * (size_t)x + (n & 1);
                        const size_t fy = 2 * (size_t)y + (n >> 1 & 1);
                        const size_t fz = 2 * (size_t)z + (n >> 2);
                        sum += fine[((fz * row + fy) * row + fx) * 2 + c];
                    }
                    out[c] = (uint16_t)((sum + 4) / 8);
                }
            }
        }
    }
}

// Even over +- s is a variance of s^2 / 3. What texels of a level are the means of has the whole
// variance less that of the means.
static void find_spreads(struct cloud_volume *v)
{
    double whole = 0;
    for (int level = 0; level < CLOUD_LEVELS; level++) {
        const size_t count = level_texels(level);
        double sum = 0;
        double squares = 0;
        for (size_t i = 0; i < count; i++) {
            const double value = (double)v->texels[level][2 * i] / CLOUD_STEPS;
            sum += value;
            squares += value * value;
        }
        const double mean = sum / (double)count;
        const double variance = squares / (double)count - mean * mean;
        whole = level == 0 ? variance : whole;
        v->spread[level] = sqrt(3 * fmax(0, whole - variance));
    }
}

trl_result cloud_volume_init(const trl_context *ctx, uint32_t seed, struct cloud_volume *out)
{
    *out = (struct cloud_volume){.ctx = ctx};
    size_t count = 0;
    for (int level = 0; level < CLOUD_LEVELS; level++) {
        count += level_texels(level);
    }
    uint16_t *texels = mem_alloc(ctx, count, 2 * sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (int level = 0; level < CLOUD_LEVELS; level++) {
        out->texels[level] = texels;
        texels += 2 * level_texels(level);
    }
    if (!cloud_cache_load(ctx, seed, out->texels[0])) {
        trl_result result = trl_progress(ctx, "clouds", 0);
        if (result == TRL_OK) {
            result = cloud_noise_fill(ctx, seed, out->texels[0]);
        }
        if (result == TRL_OK) {
            cloud_cache_store(ctx, seed, out->texels[0]);
            result = trl_progress(ctx, "clouds", 1);
        }
        if (result != TRL_OK) {
            cloud_volume_finish(out);
            return result;
        }
    }
    for (int level = 1; level < CLOUD_LEVELS; level++) {
        fill_level(out->texels[level - 1], CLOUD_SIDE >> level, out->texels[level]);
    }
    find_spreads(out);
    return TRL_OK;
}

void cloud_volume_finish(struct cloud_volume *volume)
{
    mem_free(volume->ctx, volume->texels[0]);
    *volume = (struct cloud_volume){0};
}

static struct cloud_noise sample_level(const struct cloud_volume *v, const double place[3],
                                       int level)
{
    const int side = CLOUD_SIDE >> level;
    int first[3];
    double part[3];
    for (int k = 0; k < 3; k++) {
        const double at = (place[k] - floor(place[k])) * side - 0.5;
        first[k] = (int)floor(at);
        part[k] = at - first[k];
    }
    struct cloud_noise sum = {0};
    for (int n = 0; n < 8; n++) {
        double weight = 1;
        int at[3];
        for (int k = 0; k < 3; k++) {
            const int next = n >> k & 1;
            at[k] = (first[k] + next) & (side - 1);
            weight *= next ? part[k] : 1 - part[k];
        }
        const uint16_t *texel = v->texels[level] + 2 * ((at[2] * side + at[1]) * side + at[0]);
        sum.value += weight * texel[0] / CLOUD_STEPS;
        sum.around += weight * texel[1] / CLOUD_STEPS;
    }
    return sum;
}

// Between which levels, and how far from the lower one.
static int find_level(double level, double *part)
{
    const double clamped = fmax(0, fmin(CLOUD_LEVELS - 1, level));
    const int low = clamped < CLOUD_LEVELS - 2 ? (int)clamped : CLOUD_LEVELS - 2;
    *part = clamped - low;
    return low;
}

struct cloud_noise cloud_volume_sample(const struct cloud_volume *volume, const double place[3],
                                       double level)
{
    double part;
    const int low = find_level(level, &part);
    const struct cloud_noise fine = sample_level(volume, place, low);
    if (part <= 0) {
        return fine;
    }
    const struct cloud_noise coarse = sample_level(volume, place, low + 1);
    return (struct cloud_noise){fine.value + (coarse.value - fine.value) * part,
                                fine.around + (coarse.around - fine.around) * part};
}

double cloud_volume_spread(const struct cloud_volume *volume, double level)
{
    double part;
    const int low = find_level(level, &part);
    return volume->spread[low] + (volume->spread[low + 1] - volume->spread[low]) * part;
}
