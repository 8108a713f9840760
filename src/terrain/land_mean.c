// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/land_mean.h"

#include <math.h>

enum { FIRST = 4 }; // texels a side of the finest squares
// Where this part of a square is known, nothing wider is asked.
static const float ENOUGH = 0.25f;

void land_mean_finish(struct land_mean *mean)
{
    for (int k = 0; k < mean->count; k++) {
        mem_free(mean->ctx, mean->levels[k].texels);
    }
    *mean = (struct land_mean){0};
}

static trl_result make_level(struct land_mean *m, uint32_t width, uint32_t height)
{
    struct land_mean_level *level = &m->levels[m->count++];
    *level = (struct land_mean_level){width, height, NULL};
    level->texels = mem_alloc(m->ctx, (size_t)width * height, 4 * sizeof *level->texels);
    return level->texels ? TRL_OK : TRL_ERROR_MEMORY;
}

// Sums of the picture, and of each level for the next.
static void sum_picture(struct land_mean_level *level, const struct layer_frame *f,
                        const uint8_t *rgba, const uint8_t *states)
{
#pragma omp parallel for schedule(dynamic, 16)
    for (uint32_t y = 0; y < level->height; y++) {
        for (uint32_t x = 0; x < level->width; x++) {
            float *sum = level->texels + 4 * ((size_t)y * level->width + x);
            for (int k = 0; k < 4; k++) {
                sum[k] = 0;
            }
            for (uint32_t i = 0; i < FIRST * FIRST; i++) {
                const uint32_t column = x * FIRST + i % FIRST, row = y * FIRST + i / FIRST;
                const size_t at = (size_t)row * f->width + column;
                if (column < f->width && row < f->height && states[at] == 0) {
                    for (size_t c = 0; c < 3; c++) {
                        sum[c] += (float)rgba[4 * at + c] / (FIRST * FIRST);
                    }
                    sum[3] += 1.0f / (FIRST * FIRST);
                }
            }
        }
    }
}

static void sum_level(const struct land_mean_level *fine, struct land_mean_level *level)
{
    for (uint32_t y = 0; y < level->height; y++) {
        for (uint32_t x = 0; x < level->width; x++) {
            float *sum = level->texels + 4 * ((size_t)y * level->width + x);
            for (int k = 0; k < 4; k++) {
                sum[k] = 0;
            }
            for (uint32_t i = 0; i < 4; i++) {
                const uint32_t column = 2 * x + i % 2, row = 2 * y + i / 2;
                const size_t at = (size_t)row * fine->width + column;
                for (size_t k = 0; k < 4 && column < fine->width && row < fine->height; k++) {
                    sum[k] += 0.25f * fine->texels[4 * at + k];
                }
            }
        }
    }
}

// Between texels of a level; (0, 0) is the first one's middle.
static void sample(const struct land_mean *m, int k, double x, double y, float out[4])
{
    const struct land_mean_level *level = &m->levels[k];
    const int64_t column = (int64_t)floor(x), row = (int64_t)floor(y);
    const double part_x = x - (double)column, part_y = y - (double)row;
    const int64_t last_x = (int64_t)level->width - 1, last_y = (int64_t)level->height - 1;
    for (int c = 0; c < 4; c++) {
        out[c] = 0;
    }
    for (int i = 0; i < 4; i++) {
        int64_t at_x = column + i % 2, at_y = row + i / 2;
        at_x += m->is_round ? (at_x < 0 ? last_x + 1 : at_x > last_x ? -last_x - 1 : 0) : 0;
        at_x = at_x < 0 ? 0 : at_x > last_x ? last_x : at_x;
        at_y = at_y < 0 ? 0 : at_y > last_y ? last_y : at_y;
        const double weight = (i % 2 ? part_x : 1 - part_x) * (i / 2 ? part_y : 1 - part_y);
        const float *texel = level->texels + 4 * ((size_t)at_y * level->width + (size_t)at_x);
        for (int c = 0; c < 4; c++) {
            out[c] += (float)weight * texel[c];
        }
    }
}

// What a level lacks comes from the next, so that all of it is known: 1, or 0 where nothing is.
static void fill_level(const struct land_mean *m, int k)
{
    const struct land_mean_level *level = &m->levels[k];
    for (uint32_t y = 0; y < level->height; y++) {
        for (uint32_t x = 0; x < level->width; x++) {
            float *texel = level->texels + 4 * ((size_t)y * level->width + x);
            float wide[4] = {0};
            if (k + 1 < m->count) {
                sample(m, k + 1, 0.5 * x - 0.25, 0.5 * y - 0.25, wide);
            }
            const float own = fminf(texel[3] / ENOUGH, 1);
            const float rest = (1 - own) * wide[3];
            const float whole = own + rest;
            for (int c = 0; c < 3 && whole > 0; c++) {
                texel[c] = (own > 0 ? own * texel[c] / texel[3] : 0) + rest * wide[c];
                texel[c] /= whole;
            }
            texel[3] = whole > 0 ? 1 : 0;
        }
    }
}

trl_result land_mean_init(const trl_context *ctx, const struct layer_frame *frame,
                          const uint8_t *rgba, const uint8_t *states, struct land_mean *out)
{
    *out = (struct land_mean){.ctx = ctx, .is_round = frame->is_whole_circle};
    uint32_t width = (frame->width + FIRST - 1) / FIRST;
    uint32_t height = (frame->height + FIRST - 1) / FIRST;
    trl_result result = TRL_OK;
    bool is_last = false;
    while (!is_last && out->count < LAND_MEAN_LEVELS && result == TRL_OK) {
        result = make_level(out, width, height);
        if (result == TRL_OK && out->count == 1) {
            sum_picture(&out->levels[0], frame, rgba, states);
        } else if (result == TRL_OK) {
            sum_level(&out->levels[out->count - 2], &out->levels[out->count - 1]);
        }
        is_last = width == 1 && height == 1;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    for (int k = out->count - 1; k >= 0 && result == TRL_OK; k--) {
        fill_level(out, k);
    }
    if (result != TRL_OK) {
        land_mean_finish(out);
    }
    return result;
}

bool land_mean_at(const struct land_mean *mean, uint32_t x, uint32_t y, uint8_t rgb[3])
{
    float texel[4];
    sample(mean, 0, (x + 0.5) / FIRST - 0.5, (y + 0.5) / FIRST - 0.5, texel);
    for (int c = 0; c < 3 && texel[3] > 0; c++) {
        rgb[c] = (uint8_t)lrintf(fminf(fmaxf(texel[c] / texel[3], 0), 255));
    }
    return texel[3] > 0;
}
