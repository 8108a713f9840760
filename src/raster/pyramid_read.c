// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tiles and other windows of a pyramid's levels: from the file, or from what is held whole.
#include "raster/pyramid.h"

#include <string.h>

trl_result pyramid_read_pixels(const struct pyramid *p, const struct raster *level,
                               const struct raster_window *w, void *out)
{
    switch (p->format) {
    case PYRAMID_INT16:
        return raster_read_int16(level, w, 0, out);
    case PYRAMID_FLOAT:
        return raster_read_float(level, w, 0, out);
    case PYRAMID_RGBA8:
        return raster_read_rgba8(level, w, out);
    case PYRAMID_UINT8:
        break;
    }
    return raster_read_uint8(level, w, 0, out);
}

bool pyramid_has_tile(const struct pyramid *pyramid, const struct pyramid_tile *tile)
{
    return tile->level < pyramid->level_count && tile->x < pyramid->levels[tile->level].columns &&
           tile->y < pyramid->levels[tile->level].rows;
}

trl_result pyramid_reader_init(const trl_context *ctx, const struct pyramid *pyramid,
                               struct pyramid_reader *out)
{
    *out = (struct pyramid_reader){.pyramid = pyramid,
                                   .raster = {.ctx = ctx},
                                   .patch = mem_alloc(ctx, (size_t)PYRAMID_WINDOW * PYRAMID_WINDOW,
                                                      pyramid_texel_bytes(pyramid->format))};
    return out->patch ? TRL_OK : TRL_ERROR_MEMORY;
}

void pyramid_reader_finish(struct pyramid_reader *reader)
{
    if (reader->pyramid) {
        mem_free(reader->raster.ctx, reader->patch);
        raster_finish(&reader->raster);
    }
    *reader = (struct pyramid_reader){0};
}

// Where the texels of a window go.
struct window_texels {
    uint8_t *bytes;
    size_t texel; // bytes of one
    uint32_t width, height;
};

// A run of texels along one axis: `count` of the level's from `from` on go to the window's from
// `to` on; rows over a pole come in reverse, and from the opposite meridian.
struct run {
    int64_t from;
    uint32_t count, to;
    bool is_over_pole;
};
struct runs {
    uint32_t count;
    struct run run[3];
};

static void add_run(struct runs *runs, struct run run)
{
    if (run.count > 0) {
        runs->run[runs->count++] = run;
    }
}

// Of `count` texels from `first` on (which may be negative), those in [0, size).
static struct run clip_run(int64_t first, int64_t count, int64_t size)
{
    const int64_t from = first > 0 ? first : 0;
    const int64_t end = first + count < size ? first + count : size;
    return (struct run){from, (uint32_t)(end > from ? end - from : 0), (uint32_t)(from - first),
                        false};
}

static int64_t smaller(int64_t a, int64_t b)
{
    return a < b ? a : b;
}

static struct runs find_rows(const struct pyramid *p, const struct pyramid_window *w)
{
    struct runs rows = {0};
    const int64_t size = p->levels[w->level].height, y = w->y;
    const int64_t below = y + w->height - size;
    if (y < 0 && p->over_north) {
        const int64_t count = smaller(-y, size);
        add_run(&rows, (struct run){0, (uint32_t)count, (uint32_t)(-y - count), true});
    }
    add_run(&rows, clip_run(y, w->height, size));
    if (below > 0 && p->over_south) {
        // A last tile may end outside: beyond its border nothing is seen.
        const int64_t count = smaller(below, smaller(size, PYRAMID_MARGIN));
        add_run(&rows, (struct run){size - count, (uint32_t)count, (uint32_t)(size - y), true});
    }
    return rows;
}

// Where columns wrap, a level is no narrower than a window that comes here: two runs at most.
static struct runs find_columns(const struct pyramid *p, const struct pyramid_window *w, int64_t x)
{
    struct runs columns = {0};
    const int64_t size = p->levels[w->level].width;
    if (!p->wraps) {
        add_run(&columns, clip_run(x, w->width, size));
        return columns;
    }
    x = ((x % size) + size) % size;
    const struct run first = clip_run(x, w->width, size);
    add_run(&columns, first);
    add_run(&columns, (struct run){0, w->width - first.count, first.count, false});
    return columns;
}

// Places of the window, filled from the nearest that have been.
static void spread_borders(const struct runs *rows, const struct runs *columns,
                           const struct window_texels *out)
{
    const size_t texel = out->texel;
    const struct run *last = &columns->run[columns->count - 1];
    const uint32_t left = columns->run[0].to, right = last->to + last->count;
    const uint32_t top = rows->run[0].to;
    const uint32_t bottom = rows->run[rows->count - 1].to + rows->run[rows->count - 1].count;
    const size_t row_bytes = out->width * texel;
    for (uint32_t y = top; y < bottom; y++) {
        uint8_t *row = out->bytes + y * row_bytes;
        for (uint32_t x = 0; x < left; x++) {
            memcpy(row + x * texel, row + left * texel, texel);
        }
        for (uint32_t x = right; x < out->width; x++) {
            memcpy(row + x * texel, row + (right - 1) * texel, texel);
        }
    }
    for (uint32_t y = 0; y < top; y++) {
        memcpy(out->bytes + y * row_bytes, out->bytes + top * row_bytes, row_bytes);
    }
    for (uint32_t y = bottom; y < out->height; y++) {
        memcpy(out->bytes + y * row_bytes, out->bytes + (bottom - 1) * row_bytes, row_bytes);
    }
}

// Puts what `patch` holds of the crossing of two runs where it belongs.
static void place_patch(const struct run *rows, const struct run *columns, const void *patch,
                        const struct window_texels *out)
{
    const size_t bytes = columns->count * out->texel;
    for (uint32_t j = 0; j < rows->count; j++) {
        const uint32_t from = rows->is_over_pole ? rows->count - 1 - j : j;
        memcpy(out->bytes + ((size_t)(rows->to + j) * out->width + columns->to) * out->texel,
               (const uint8_t *)patch + from * bytes, bytes);
    }
}

static trl_result open_file(struct pyramid_reader *reader)
{
    if (reader->raster.dataset) {
        return TRL_OK;
    }
    struct raster like = reader->pyramid->raster;
    like.ctx = reader->raster.ctx;
    const trl_result result = raster_open_again(&like, &reader->raster);
    reader->raster.ctx = like.ctx;
    return result;
}

static trl_result read_from_file(struct pyramid_reader *reader, const struct pyramid_window *w,
                                 const struct window_texels *out)
{
    const struct pyramid *p = reader->pyramid;
    const struct pyramid_level *level = &p->levels[w->level];
    const struct runs rows = find_rows(p, w);
    trl_result result = open_file(reader);
    const struct raster reduced = raster_reduced(&reader->raster, level->width, level->height);
    struct runs columns = {0};
    for (uint32_t j = 0; j < rows.count && result == TRL_OK; j++) {
        const struct run *row = &rows.run[j];
        columns = find_columns(p, w, w->x + (row->is_over_pole ? level->width / 2 : 0));
        for (uint32_t i = 0; i < columns.count && result == TRL_OK; i++) {
            const struct run *column = &columns.run[i];
            const struct raster_window from = {(uint32_t)column->from, (uint32_t)row->from,
                                               column->count,          row->count,
                                               column->count,          row->count};
            result = pyramid_read_pixels(p, &reduced, &from, reader->patch);
            place_patch(row, column, reader->patch, out);
        }
    }
    if (result == TRL_OK) {
        spread_borders(&rows, &columns, out);
    }
    return result;
}

static int64_t clamp_index(int64_t i, int64_t size)
{
    return i < 0 ? 0 : i >= size ? size - 1 : i;
}

static void cut_from_whole(const struct pyramid *p, const struct pyramid_window *w,
                           const struct window_texels *out)
{
    const struct pyramid_level *level = &p->levels[w->level];
    const uint8_t *whole = p->whole[w->level];
    const int64_t width = level->width, height = level->height;
    for (int64_t j = 0; j < w->height; j++) {
        int64_t y = w->y + j;
        const bool is_over = (y < 0 && p->over_north) || (y >= height && p->over_south);
        // Beyond its border a tile may end outside the raster: whatever stands there is not seen.
        y = clamp_index(!is_over ? y : y < 0 ? -1 - y : 2 * height - 1 - y, height);
        for (int64_t i = 0; i < w->width; i++) {
            int64_t x = w->x + i;
            x += is_over ? width / 2 : 0;
            x = p->wraps ? ((x % width) + width) % width : clamp_index(x, width);
            memcpy(out->bytes + (size_t)(j * w->width + i) * out->texel,
                   whole + (size_t)(y * width + x) * out->texel, out->texel);
        }
    }
}

// Of a level that goes around the planet in fewer columns than the window has: all of them once,
// then as often as needed.
static trl_result read_narrow(struct pyramid_reader *reader, const struct pyramid_window *w,
                              const struct window_texels *out)
{
    const uint32_t width = reader->pyramid->levels[w->level].width;
    const struct pyramid_window once = {w->level, 0, w->y, width, w->height};
    uint8_t *bytes = mem_alloc(reader->raster.ctx, (size_t)width * w->height, out->texel);
    const struct window_texels columns = {bytes, out->texel, width, w->height};
    const trl_result result = bytes ? read_from_file(reader, &once, &columns) : TRL_ERROR_MEMORY;
    for (size_t i = 0; i < (size_t)w->width * w->height && result == TRL_OK; i++) {
        const int64_t x = (w->x + (int64_t)(i % w->width)) % width;
        const size_t from = i / w->width * width + (size_t)(x < 0 ? x + width : x);
        memcpy(out->bytes + i * out->texel, bytes + from * out->texel, out->texel);
    }
    mem_free(reader->raster.ctx, bytes);
    return result;
}

trl_result pyramid_read_window(struct pyramid_reader *reader, const struct pyramid_window *w,
                               void *texels)
{
    const struct window_texels out = {texels, pyramid_texel_bytes(reader->pyramid->format),
                                      w->width, w->height};
    if (w->level >= reader->pyramid->base_level) {
        cut_from_whole(reader->pyramid, w, &out);
        return TRL_OK;
    }
    const bool is_narrow = reader->pyramid->levels[w->level].width < w->width;
    return reader->pyramid->wraps && is_narrow ? read_narrow(reader, w, &out)
                                               : read_from_file(reader, w, &out);
}

struct pyramid_window pyramid_window_of(const struct pyramid_tile *tile)
{
    return (struct pyramid_window){tile->level, tile->x * (int64_t)PYRAMID_TILE - PYRAMID_BORDER,
                                   tile->y * (int64_t)PYRAMID_TILE - PYRAMID_BORDER, PYRAMID_SIDE,
                                   PYRAMID_SIDE};
}

trl_result pyramid_read(struct pyramid_reader *reader, const struct pyramid_tile *tile,
                        void *texels)
{
    const struct pyramid_window window = pyramid_window_of(tile);
    return pyramid_read_window(reader, &window, texels);
}
