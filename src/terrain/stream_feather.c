// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How pictures in tiles fade toward gaps. The feather may reach farther than a tile knows, so gaps
// are looked for on a coarser level, where it is a few texels wide; what a texel gets does not
// depend on the tile it is in.
#include "terrain/stream.h"
#include "terrain/voids.h"

#include <math.h>

// The feather on the level where gaps are looked for, and how far is looked at the most.
enum { FEATHER_TEXELS = 8, MOST_TEXELS = PYRAMID_MARGIN - 2 };

// Weights on a window of a level.
struct weights {
    struct pyramid_window window;
    double feather; // texels
    float *values;  // owned
};

static double feather_on(const struct stream_layer *l, uint32_t level)
{
    const struct layer_frame *f = &l->frame;
    return f->feather / f->texel_height * l->pyramid.levels[level].height / f->height;
}

static double map_texel(int64_t i, uint32_t from, uint32_t to)
{
    return ((double)i + 0.5) * to / from - 0.5;
}

// What a window covers on a coarser level, and `margin` more.
static struct pyramid_window cover(const struct pyramid *p, const struct pyramid_window *w,
                                   uint32_t level, int64_t margin)
{
    const struct pyramid_level *fine = &p->levels[w->level], *coarse = &p->levels[level];
    const int64_t x = (int64_t)floor(map_texel(w->x, fine->width, coarse->width)) - margin;
    const int64_t y = (int64_t)floor(map_texel(w->y, fine->height, coarse->height)) - margin;
    const double right = map_texel(w->x + w->width - 1, fine->width, coarse->width);
    const double bottom = map_texel(w->y + w->height - 1, fine->height, coarse->height);
    return (struct pyramid_window){level, x, y, (uint32_t)((int64_t)floor(right) + 2 + margin - x),
                                   (uint32_t)((int64_t)floor(bottom) + 2 + margin - y)};
}

static bool has_gap(const uint8_t *rgba, size_t count)
{
    bool is_there = false;
    for (size_t i = 0; i < count && !is_there; i++) {
        is_there = rgba[4 * i + 3] < 255;
    }
    return is_there;
}

static size_t count_texels(const struct pyramid_window *w)
{
    return (size_t)w->width * w->height;
}

// Whether there are gaps in a window, as far as the level that is held whole tells.
static bool may_have_gap(struct pyramid_reader *reader, const struct pyramid_window *w,
                         uint8_t *rgba)
{
    const struct pyramid *p = reader->pyramid;
    if (w->level >= p->base_level) {
        return true;
    }
    const struct pyramid_window base = cover(p, w, p->base_level, 0);
    return pyramid_read_window(reader, &base, rgba) != TRL_OK || has_gap(rgba, count_texels(&base));
}

// Half covered and less is a gap.
static trl_result weigh(const trl_context *ctx, const uint8_t *rgba, struct weights *w)
{
    const struct layer_frame frame = {.width = w->window.width, .height = w->window.height};
    const size_t count = count_texels(&w->window);
    for (size_t i = 0; i < count; i++) {
        w->values[i] = rgba[4 * i + 3] < 128 ? 0 : VOIDS_FAR;
    }
    const trl_result result = voids_measure(ctx, &frame, w->values);
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        w->values[i] = (float)voids_weight((double)w->values[i], w->feather);
    }
    return result;
}

static double weight_at(const struct weights *w, double x, double y)
{
    const size_t column = (size_t)x, row = (size_t)y;
    const double fx = x - (double)column, fy = y - (double)row;
    const float *upper = w->values + row * w->window.width + column;
    const float *lower = upper + w->window.width;
    const double north = (1 - fx) * (double)upper[0] + fx * (double)upper[1];
    const double south = (1 - fx) * (double)lower[0] + fx * (double)lower[1];
    return (1 - fy) * north + fy * south;
}

static void apply(const struct pyramid *p, const struct weights *w,
                  const struct pyramid_window *tile, uint8_t *rgba)
{
    const struct pyramid_level *fine = &p->levels[tile->level];
    const struct pyramid_level *coarse = &p->levels[w->window.level];
    for (size_t i = 0; i < count_texels(tile); i++) {
        const double x =
            map_texel(tile->x + (int64_t)(i % tile->width), fine->width, coarse->width);
        const double y =
            map_texel(tile->y + (int64_t)(i / tile->width), fine->height, coarse->height);
        const double weight = weight_at(w, x - (double)w->window.x, y - (double)w->window.y);
        rgba[4 * i + 3] = (uint8_t)lrint(weight * rgba[4 * i + 3]);
    }
}

trl_result stream_feather(const struct stream_layer *l, struct pyramid_reader *reader,
                          const struct pyramid_tile *tile, uint8_t *rgba)
{
    const struct pyramid *p = &l->pyramid;
    const trl_context *ctx = reader->raster.ctx;
    uint32_t level = tile->level;
    while (feather_on(l, level) > FEATHER_TEXELS && level + 1 < p->level_count) {
        level++;
    }
    const double feather = fmax(1, fmin(feather_on(l, level), MOST_TEXELS));
    const struct pyramid_window window = pyramid_window_of(tile);
    struct weights w = {.window = cover(p, &window, level, (int64_t)ceil(feather)),
                        .feather = feather};
    uint8_t *around = mem_alloc(ctx, (size_t)PYRAMID_WINDOW * PYRAMID_WINDOW, 4);
    w.values = mem_alloc(ctx, count_texels(&w.window), sizeof *w.values);
    trl_result result = around && w.values ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK && may_have_gap(reader, &w.window, around)) {
        result = pyramid_read_window(reader, &w.window, around);
        if (result == TRL_OK && has_gap(around, count_texels(&w.window))) {
            result = weigh(ctx, around, &w);
            if (result == TRL_OK) {
                apply(p, &w, &window, rgba);
            }
        }
    }
    mem_free(ctx, w.values);
    mem_free(ctx, around);
    return result;
}
