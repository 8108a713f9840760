// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pictures of planets show the sea in its own colour. Where the sea is drawn by itself, land that
// the picture has no texel for would be as blue: beside the shore, and on small islands. So colours
// of land go on for some texels beyond it.
#include "terrain/land_mean.h"
#include "terrain/load.h"

#include <math.h>
#include <string.h>

enum {
    REACH = 4,       // texels beyond the land
    SHORE = 1,       // texels of land that the sea may have coloured
    DRY = 26,        // of 255: at most this much water
    STATE_SEA = 255, // not reached yet; below: in which step a texel had its colour
    STATE_SHORE = 254,
    // Texels that are looked at together, more than any of them can change by.
    BLOCK = 16
};

struct painter {
    const struct surface *surface;
    const struct layer_frame *frame;
    uint8_t *rgba;
    uint8_t *states, *next; // owned; of each texel
    uint32_t columns, rows; // of blocks
    uint8_t *kinds;         // owned; what is in each block
    bool *is_open;          // owned; whether a texel of it can change
    const struct land_mean *mean;
};

// The only mask, where its rows are those of the picture.
static const struct layer_frame *find_level_mask(const struct painter *p)
{
    const struct surface *s = p->surface;
    const struct layer_frame *mask = &s->layers[SURFACE_WATER][0].frame;
    const bool is_level = s->counts[SURFACE_WATER] == 1 && s->masks[0] && mask->pole == 0 &&
                          mask->is_whole_circle && p->frame->pole == 0;
    return is_level ? mask : NULL;
}

static void find_dry_row(const struct painter *p, const struct layer_frame *mask, uint32_t y)
{
    const struct layer_frame *f = p->frame;
    uint8_t *row = p->states + (size_t)y * f->width;
    const struct layer_geo west = layer_geo_of(f, 0, y);
    const struct layer_place first =
        mask ? layer_locate(mask, west.latitude, west.longitude) : (struct layer_place){0};
    const double step = mask ? f->texel_width / mask->texel_width : 0;
    const uint8_t *masked =
        mask ? p->surface->masks[0] + layer_texel_index(mask, 0, lrint(first.y)) : NULL;
    for (uint32_t x = 0; x < f->width; x++) {
        uint8_t water = 0;
        if (first.weight > 0) {
            const int64_t column = (int64_t)(first.x + x * step + 0.5);
            water = masked[column < mask->width ? column : column - mask->width];
        } else {
            const struct layer_geo at = layer_geo_of(f, x, y);
            water = surface_mask(p->surface, at.latitude, at.longitude);
        }
        row[x] = water > DRY ? STATE_SEA : 0;
    }
}

// Whether a texel beside this one, or how many, had a colour before a step; sums those up.
static int sum_around(const struct painter *p, const size_t around[8], int step, int sum[3])
{
    int count = 0;
    for (int k = 0; k < 8; k++) {
        if (p->states[around[k]] < step) {
            for (int c = 0; sum && c < 3; c++) {
                sum[c] += p->rgba[4 * around[k] + (size_t)c];
            }
            count++;
        }
    }
    return count;
}

static void find_around(const struct layer_frame *f, uint32_t x, uint32_t y, size_t around[8])
{
    const size_t w = f->width, i = (size_t)y * w + x;
    if (x > 0 && y > 0 && x + 1 < f->width && y + 1 < f->height) {
        const size_t inside[8] = {i - w - 1, i - w,     i - w + 1, i - 1,
                                  i + 1,     i + w - 1, i + w,     i + w + 1};
        memcpy(around, inside, sizeof inside);
        return;
    }
    int n = 0;
    for (int64_t dy = -1; dy <= 1; dy++) {
        for (int64_t dx = -1; dx <= 1; dx++) {
            if (dx != 0 || dy != 0) {
                around[n++] = layer_texel_index(f, (int64_t)x + dx, (int64_t)y + dy);
            }
        }
    }
}

static bool is_beside_sea(const struct painter *p, const size_t around[8])
{
    bool is_beside = false;
    for (int k = 0; k < 8; k++) {
        is_beside = is_beside || p->states[around[k]] == STATE_SEA;
    }
    return is_beside;
}

// What happens to a texel in a step.
typedef void (*painter_change)(const struct painter *p, int step, uint32_t x, uint32_t y);

// All texels that can change: those of blocks that have land and sea, or beside such.
static void change_all(const struct painter *p, painter_change change, int step)
{
    const struct layer_frame *f = p->frame;
#pragma omp parallel for schedule(dynamic, 64)
    for (uint32_t block = 0; block < p->columns * p->rows; block++) {
        const uint32_t x0 = block % p->columns * BLOCK, y0 = block / p->columns * BLOCK;
        for (uint32_t y = y0; p->is_open[block] && y < f->height && y < y0 + BLOCK; y++) {
            for (uint32_t x = x0; x < f->width && x < x0 + BLOCK; x++) {
                change(p, step, x, y);
            }
        }
    }
}

// Marks in `next` what the step changes: in step 0 land beside the sea, then texels that have a
// neighbour with a colour, first of the shore.
static void mark(const struct painter *p, int step, uint32_t x, uint32_t y)
{
    const size_t i = (size_t)y * p->frame->width + x;
    const uint8_t waiting = step == 0 ? 0 : step <= SHORE ? STATE_SHORE : STATE_SEA;
    size_t around[8];
    p->next[i] = 0;
    if (p->states[i] == waiting) {
        find_around(p->frame, x, y, around);
        p->next[i] = step == 0 ? is_beside_sea(p, around) : sum_around(p, around, step, NULL) > 0;
    }
}

static void paint_marked(const struct painter *p, int step, uint32_t x, uint32_t y)
{
    const size_t i = (size_t)y * p->frame->width + x;
    size_t around[8];
    int sum[3] = {0};
    if (p->next[i]) {
        find_around(p->frame, x, y, around);
        const int count = sum_around(p, around, step, sum);
        for (int c = 0; c < 3; c++) {
            p->rgba[4 * i + (size_t)c] = (uint8_t)((sum[c] + count / 2) / count);
        }
    }
}

static void set_marked(const struct painter *p, int step, uint32_t x, uint32_t y)
{
    const size_t i = (size_t)y * p->frame->width + x;
    p->states[i] = p->next[i] ? (step == 0 ? STATE_SHORE : (uint8_t)step) : p->states[i];
}

// What is left of the shore are islands, of which no texel is sure: they look like the land around.
static void paint_island(const struct painter *p, int step, uint32_t x, uint32_t y)
{
    const size_t i = (size_t)y * p->frame->width + x;
    if (p->states[i] == STATE_SHORE) {
        land_mean_at(p->mean, x, y, p->rgba + 4 * i);
        p->states[i] = (uint8_t)step;
    }
}

static void paint_step(const struct painter *p, int step)
{
    change_all(p, mark, step);
    change_all(p, paint_marked, step);
    change_all(p, set_marked, step);
}

// 1 where a block has land, 2 where it has sea, 3 both.
static void find_kinds(const struct painter *p)
{
    const struct layer_frame *f = p->frame;
#pragma omp parallel for
    for (uint32_t row = 0; row < p->rows; row++) {
        for (uint32_t y = row * BLOCK; y < f->height && y < (row + 1) * BLOCK; y++) {
            for (uint32_t x = 0; x < f->width; x++) {
                const bool is_sea = p->states[(size_t)y * f->width + x] == STATE_SEA;
                p->kinds[row * p->columns + x / BLOCK] |= is_sea ? 2 : 1;
            }
        }
    }
}

// Blocks of the border always: what is beside them may be far in the raster.
static void open_blocks(const struct painter *p)
{
    for (uint32_t y = 0; y < p->rows; y++) {
        for (uint32_t x = 0; x < p->columns; x++) {
            const bool is_border = x == 0 || y == 0 || x + 1 == p->columns || y + 1 == p->rows;
            int kinds = is_border ? 3 : 0;
            for (uint32_t k = 0; k < 9 && !is_border; k++) {
                kinds |= p->kinds[(y + k / 3 - 1) * p->columns + x + k % 3 - 1];
            }
            p->is_open[y * p->columns + x] = kinds == 3;
        }
    }
}

static trl_result paint(struct painter *p)
{
    const struct layer_frame *f = p->frame;
    const struct layer_frame *mask = find_level_mask(p);
#pragma omp parallel for schedule(dynamic, 16)
    for (uint32_t y = 0; y < f->height; y++) {
        find_dry_row(p, mask, y);
    }
    find_kinds(p);
    open_blocks(p);
    change_all(p, mark, 0);
    change_all(p, set_marked, 0);
    struct land_mean mean;
    const trl_result result = land_mean_init(p->surface->ctx, f, p->rgba, p->states, &mean);
    if (result != TRL_OK) {
        return result;
    }
    p->mean = &mean;
    for (int step = 1; step <= SHORE; step++) {
        paint_step(p, step);
    }
    change_all(p, paint_island, SHORE);
    land_mean_finish(&mean);
    for (int step = SHORE + 1; step <= SHORE + REACH; step++) {
        paint_step(p, step);
    }
    return TRL_OK;
}

trl_result load_paint_shore(const void *user, const struct terrain_layer *layer, uint8_t *rgba)
{
    const struct surface *s = user;
    if (s->counts[SURFACE_WATER] == 0 || !s->depth.is_told || layer->cover.is_there) {
        return TRL_OK;
    }
    const struct layer_frame *f = &layer->frame;
    struct painter p = {.surface = s, .frame = f, .rgba = rgba};
    p.columns = (f->width + BLOCK - 1) / BLOCK;
    p.rows = (f->height + BLOCK - 1) / BLOCK;
    p.states = mem_alloc(s->ctx, (size_t)f->width * f->height, 1);
    p.next = mem_alloc(s->ctx, (size_t)f->width * f->height, 1);
    p.kinds = mem_alloc(s->ctx, (size_t)p.columns * p.rows, 1);
    p.is_open = mem_alloc(s->ctx, (size_t)p.columns * p.rows, sizeof *p.is_open);
    const bool is_all = p.states && p.next && p.kinds && p.is_open;
    const trl_result result = is_all ? paint(&p) : TRL_ERROR_MEMORY;
    mem_free(s->ctx, p.states);
    mem_free(s->ctx, p.next);
    mem_free(s->ctx, p.kinds);
    mem_free(s->ctx, p.is_open);
    return result;
}
