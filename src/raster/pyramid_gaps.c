// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Gaps of heights in tiles. A coarser level has data in more of a gap, since a mean counts only
// what there is: next to the rim stands the mean of what is beside, farther in that of what is
// farther away. The same everywhere, whatever tile a place is in, so neighbours fit without knowing
// of one another (pull and push, Gortler et al. 1996, The Lumigraph).
#include "raster/pyramid.h"

#include <math.h>

// As far as a tile's border tells, nearly: a rim may lie in the next tile.
enum { RIM_TEXELS = PYRAMID_BORDER };

static bool is_void(const struct pyramid *p, const void *texels, size_t i)
{
    return p->format == PYRAMID_FLOAT
               ? !isfinite(((const float *)texels)[i])
               : p->raster.has_nodata && (double)((const int16_t *)texels)[i] == p->raster.nodata;
}

static double get_height(const struct pyramid *p, const void *texels, size_t i)
{
    return p->format == PYRAMID_FLOAT ? (double)((const float *)texels)[i]
                                      : ((const int16_t *)texels)[i];
}

static void set_height(const struct pyramid *p, void *texels, size_t i, double value)
{
    if (p->format == PYRAMID_FLOAT) {
        ((float *)texels)[i] = (float)value;
    } else {
        ((int16_t *)texels)[i] = (int16_t)lrint(fmax(INT16_MIN, fmin(INT16_MAX, value)));
    }
}

static bool has_void(const struct pyramid *p, const struct pyramid_window *w, const void *texels)
{
    bool is_there = false;
    for (size_t i = 0; i < (size_t)w->width * w->height && !is_there; i++) {
        is_there = is_void(p, texels, i);
    }
    return is_there;
}

// Columns or rows of a level as those of the next one.
struct axis {
    double ratio;
    int64_t first; // of the coarser window
};

static double map_axis(const struct axis *axis, int64_t i)
{
    return ((double)i + 0.5) * axis->ratio - 0.5 - (double)axis->first;
}

static struct axis find_axis(uint32_t fine, uint32_t coarse, int64_t first)
{
    struct axis axis = {.ratio = (double)coarse / fine};
    axis.first = (int64_t)floor(map_axis(&axis, first));
    return axis;
}

// A finer texel's place in the coarser window: linear between four, of which only those with data
// count. False where none has any.
static bool mix_four(const struct pyramid *p, const struct pyramid_window *w, const void *texels,
                     const double at[2], double *value)
{
    const size_t column = (size_t)at[0], row = (size_t)at[1];
    const double fx = at[0] - (double)column, fy = at[1] - (double)row;
    double sum = 0, weights = 0;
    for (size_t k = 0; k < 4; k++) {
        const size_t i = (row + k / 2) * w->width + column + k % 2;
        const double weight = (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
        if (weight > 0 && !is_void(p, texels, i)) {
            sum += weight * get_height(p, texels, i);
            weights += weight;
        }
    }
    *value = weights > 0 ? sum / weights : 0;
    return weights > 0;
}

// What the coarser level has at each texel of a window; NaN: nothing.
static void interpolate(const struct pyramid *p, const struct pyramid_window *coarse,
                        const void *from, const struct pyramid_window *w, float *out)
{
    const struct pyramid_level *fine = &p->levels[w->level], *next = &p->levels[coarse->level];
    const struct axis across = {(double)next->width / fine->width, coarse->x};
    const struct axis down = {(double)next->height / fine->height, coarse->y};
    for (size_t i = 0; i < (size_t)w->width * w->height; i++) {
        const double at[2] = {map_axis(&across, w->x + (int64_t)(i % w->width)),
                              map_axis(&down, w->y + (int64_t)(i / w->width))};
        double value;
        out[i] = mix_four(p, coarse, from, at, &value) ? (float)value : NAN;
    }
}

// A rim ends in single texels, the coarser level in their mean: what lies between, of the texels
// with data around, runs out over RIM_TEXELS, the nearest ones' counting most.
static double rim_difference(const struct pyramid *p, const struct pyramid_window *w,
                             const void *texels, const float *coarse, size_t i)
{
    const int64_t x = (int64_t)(i % w->width), y = (int64_t)(i / w->width);
    double sum = 0, weights = 0, nearest = RIM_TEXELS + 1;
    for (int64_t v = y - RIM_TEXELS; v <= y + RIM_TEXELS; v++) {
        for (int64_t u = x - RIM_TEXELS; u <= x + RIM_TEXELS; u++) {
            const size_t k = (size_t)(v * w->width + u);
            if (u < 0 || v < 0 || u >= w->width || v >= w->height || is_void(p, texels, k) ||
                isnan(coarse[k])) {
                continue;
            }
            const double squared = (double)((u - x) * (u - x) + (v - y) * (v - y));
            const double weight = 1 / (squared * squared);
            sum += weight * (get_height(p, texels, k) - (double)coarse[k]);
            weights += weight;
            nearest = fmin(nearest, sqrt(squared));
        }
    }
    const double part = nearest / (RIM_TEXELS + 1);
    return weights > 0 && part < 1 ? (1 - part * part * (3 - 2 * part)) * sum / weights : 0;
}

// Takes `coarse` as room for what comes out: nobody looks at it where there is a gap.
static void push(const struct pyramid *p, const struct pyramid_window *w, float *coarse,
                 void *texels)
{
    const size_t count = (size_t)w->width * w->height;
    for (size_t i = 0; i < count; i++) {
        if (is_void(p, texels, i) && !isnan(coarse[i])) {
            coarse[i] += (float)rim_difference(p, w, texels, coarse, i);
        }
    }
    for (size_t i = 0; i < count; i++) {
        if (is_void(p, texels, i) && !isnan(coarse[i])) {
            set_height(p, texels, i, (double)coarse[i]);
        }
    }
}

trl_result pyramid_fill_gaps(struct pyramid_reader *reader, const struct pyramid_window *w,
                             void *texels)
{
    const struct pyramid *p = reader->pyramid;
    if (w->level >= p->base_level || !has_void(p, w, texels)) {
        return TRL_OK;
    }
    const struct pyramid_level *fine = &p->levels[w->level], *next = fine + 1;
    const struct axis across = find_axis(fine->width, next->width, w->x);
    const struct axis down = find_axis(fine->height, next->height, w->y);
    const double last_x = map_axis(&across, w->x + w->width - 1);
    const double last_y = map_axis(&down, w->y + w->height - 1);
    const struct pyramid_window coarse = {w->level + 1, across.first, down.first,
                                          (uint32_t)floor(last_x) + 2, (uint32_t)floor(last_y) + 2};
    const trl_context *ctx = reader->raster.ctx;
    void *from =
        mem_alloc(ctx, (size_t)coarse.width * coarse.height, pyramid_texel_bytes(p->format));
    float *values = mem_alloc(ctx, (size_t)w->width * w->height, sizeof *values);
    trl_result result =
        from && values ? pyramid_read_window(reader, &coarse, from) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = pyramid_fill_gaps(reader, &coarse, from);
    }
    if (result == TRL_OK) {
        interpolate(p, &coarse, from, w, values);
        push(p, w, values, texels);
    }
    mem_free(ctx, from);
    mem_free(ctx, values);
    return result;
}
