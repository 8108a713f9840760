// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Heights of open water are raised to sea level while they are loaded, by the masks of water.
#include "terrain/load.h"

#include "shared/blend.glsl"
#include "terrain/bounds.h"

#include <math.h>
#include <string.h>

// Texels of a map about a pole, and of a mask, that are looked at together.
enum { BLOCK = 32 };

// What a mask says of a block of its texels, or of a block of a layer.
enum mask_answer { MASK_LAND = 1, MASK_WATER = 2, MASK_BOTH = 3 };

// The mask that alone decides, because it lies over all others and covers the globe, in blocks.
struct mask_blocks {
    const struct terrain_layer *mask; // NULL: there is none
    const uint8_t *texels;
    uint32_t columns, rows;
    uint8_t *answers; // owned
};

static void sum_up_block(struct mask_blocks *blocks, uint32_t column, uint32_t row)
{
    const struct layer_frame *f = &blocks->mask->frame;
    int answer = 0;
    for (uint32_t y = row * BLOCK; y < f->height && y < (row + 1) * BLOCK; y++) {
        for (uint32_t x = column * BLOCK; x < f->width && x < (column + 1) * BLOCK; x++) {
            answer |= blocks->texels[(size_t)y * f->width + x] > 127 ? MASK_WATER : MASK_LAND;
        }
    }
    blocks->answers[(size_t)row * blocks->columns + column] = (uint8_t)answer;
}

// Only for maps about a pole: rows of the others are rows of the mask.
static trl_result sum_up_mask(const struct surface *s, const struct terrain_layer *layer,
                              struct mask_blocks *out)
{
    *out = (struct mask_blocks){.mask = NULL};
    const size_t last = s->counts[SURFACE_WATER] - 1;
    const struct terrain_layer *mask = &s->layers[SURFACE_WATER][last];
    const struct layer_frame *f = &mask->frame;
    const bool is_globe = mask->mode == BLEND_OVER && f->pole == 0 && f->is_whole_circle &&
                          f->touches_north && f->touches_south;
    if (layer->frame.pole == 0 || !is_globe) {
        return TRL_OK;
    }
    out->columns = (f->width + BLOCK - 1) / BLOCK;
    out->rows = (f->height + BLOCK - 1) / BLOCK;
    out->answers = mem_alloc(s->ctx, (size_t)out->columns * out->rows, 1);
    if (!out->answers) {
        return TRL_ERROR_MEMORY;
    }
    out->mask = mask;
    out->texels = s->masks[last];
#pragma omp parallel for schedule(dynamic, 4)
    for (uint32_t row = 0; row < out->rows; row++) {
        for (uint32_t column = 0; column < out->columns; column++) {
            sum_up_block(out, column, row);
        }
    }
    return TRL_OK;
}

// What the mask says within an angle of a direction.
static int ask_around(const struct mask_blocks *blocks, struct vec3 direction, double angle_rad)
{
    const struct layer_frame *f = &blocks->mask->frame;
    const double latitude = atan2(direction.z, hypot(direction.x, direction.y));
    const double ratio = sin(angle_rad) / fmax(cos(latitude), 1e-9);
    if (angle_rad > 0.5 || ratio > 0.5) {
        return MASK_BOTH; // around the pole longitudes say little
    }
    const struct layer_place place = layer_locate(f, latitude, atan2(direction.y, direction.x));
    // A texel more: the nearest is asked.
    const double east = asin(ratio) / f->texel_width + 1, north = angle_rad / f->texel_height + 1;
    const double first = floor((place.x - east) / BLOCK), last = floor((place.x + east) / BLOCK);
    const int64_t top = (int64_t)fmax(0, floor((place.y - north) / BLOCK));
    const int64_t bottom = (int64_t)fmin(blocks->rows - 1.0, floor((place.y + north) / BLOCK));
    if (first < 0 || last >= blocks->columns - 1.0) {
        return MASK_BOTH; // where the circle closes
    }
    int answer = 0;
    for (int64_t row = top; row <= bottom; row++) {
        for (int64_t column = (int64_t)first; column <= (int64_t)last; column++) {
            answer |= blocks->answers[row * blocks->columns + column];
        }
    }
    return answer;
}

// Part of a row of a layer, and what masks say there.
struct load_row {
    uint32_t y, from, to;
    uint8_t *mask; // of the whole row
};

// Of a mask that does not lie along the layer's rows, where the layer is below the sea.
static void read_mask_places(const struct terrain_layer *m, const uint8_t *texels,
                             const struct terrain_layer *layer, struct load_row row)
{
    for (uint32_t x = row.from; x < row.to; x++) {
        if (layer_texel(layer, x, row.y) < 0) {
            const struct layer_geo at = layer_geo_of(&layer->frame, x, row.y);
            const struct layer_place p = layer_locate(&m->frame, at.latitude, at.longitude);
            const size_t texel = layer_texel_index(&m->frame, lrint(p.x), lrint(p.y));
            row.mask[x] =
                p.weight > 0 ? surface_blend_mask(m, row.mask[x], texels[texel]) : row.mask[x];
        }
    }
}

// What the masks make of each other along a row of a layer; 0 where none is.
static void read_mask_row(const struct loader *loader, const struct terrain_layer *layer,
                          uint32_t y, uint8_t *row)
{
    const struct surface *s = loader->surface;
    const struct layer_frame *f = &layer->frame;
    memset(row, 0, f->width);
    for (size_t i = 0; i < s->counts[SURFACE_WATER]; i++) {
        const struct terrain_layer *mask = &s->layers[SURFACE_WATER][i];
        const struct layer_frame *m = &mask->frame;
        const struct layer_geo west = layer_geo_of(f, 0, y);
        const struct layer_place first = layer_locate(m, west.latitude, west.longitude);
        const uint8_t *texels =
            loader->surface->masks[i] + layer_texel_index(m, 0, (int64_t)floor(first.y + 0.5));
        // Both equirectangular: a row of places is a row of the mask.
        const bool is_row = f->pole == 0 && m->pole == 0 && m->is_whole_circle && first.weight > 0;
        if (is_row && m->width == f->width && fabs(first.x) < 0.5 && mask->mode == BLEND_OVER) {
            memcpy(row, texels, m->width);
            continue;
        }
        const double step = f->texel_width / m->texel_width;
        for (uint32_t x = 0; x < f->width && is_row; x++) {
            const uint32_t column = (uint32_t)(first.x + 0.5 + x * step);
            const uint8_t value = texels[column < m->width ? column : column - m->width];
            row[x] = surface_blend_mask(mask, row[x], value);
        }
        if (!is_row) {
            read_mask_places(mask, s->masks[i], layer, (struct load_row){y, 0, f->width, row});
        }
    }
}

static void raise_row(const struct layer_frame *f, const struct layer_heights *h, uint32_t y,
                      const uint8_t *mask)
{
    const int16_t zero_short = (int16_t)fmax(INT16_MIN, fmin(INT16_MAX, -h->offset_m / h->scale));
    const float zero_float = (float)(-h->offset_m / h->scale);
    const size_t base = (size_t)y * f->width;
    for (uint32_t x = 0; x < f->width && h->shorts; x++) {
        const int16_t v = h->shorts[base + x];
        h->shorts[base + x] = v < zero_short && mask[x] > 127 ? zero_short : v;
    }
    for (uint32_t x = 0; x < f->width && h->floats; x++) {
        const float v = h->floats[base + x];
        h->floats[base + x] = v < zero_float && mask[x] > 127 ? zero_float : v;
    }
}

// The same where one mask decides. What it says of whole blocks of the layer is found once for as
// many rows (`answers`).
static void read_mask_blocks(const struct mask_blocks *blocks, const struct terrain_layer *layer,
                             uint32_t y, uint8_t *row, const uint8_t *answers)
{
    const uint32_t width = layer->frame.width;
    for (uint32_t x = 0; x < width; x += BLOCK) {
        const uint32_t end = x + BLOCK < width ? x + BLOCK : width;
        const int answer = answers[x / BLOCK];
        memset(row + x, answer == MASK_WATER ? 255 : 0, end - x);
        if (answer == MASK_BOTH) {
            read_mask_places(blocks->mask, blocks->texels, layer,
                             (struct load_row){y, x, end, row});
        }
    }
}

static void ask_for_row(const struct mask_blocks *blocks, const struct layer_frame *f, uint32_t y,
                        uint8_t *answers)
{
    for (uint32_t x = 0; x < f->width; x += BLOCK) {
        const struct layer_rectangle r = {x, y, BLOCK, BLOCK};
        struct vec3 direction;
        double angle_rad;
        surface_bound_rectangle(f, &r, &direction, &angle_rad);
        answers[x / BLOCK] = (uint8_t)ask_around(blocks, direction, angle_rad);
    }
}

// Rows of a block's height.
static void raise_rows(const struct loader *loader, const struct mask_blocks *blocks,
                       struct terrain_layer *layer, uint32_t first, uint8_t *mask)
{
    const struct layer_frame *f = &layer->frame;
    uint8_t *answers = mask + f->width;
    if (blocks->mask) {
        ask_for_row(blocks, f, first, answers);
    }
    for (uint32_t y = first; y < f->height && y < first + BLOCK; y++) {
        if (blocks->mask) {
            read_mask_blocks(blocks, layer, y, mask, answers);
        } else {
            read_mask_row(loader, layer, y, mask);
        }
        raise_row(f, &layer->heights, y, mask);
    }
}

static trl_result raise_layer(const struct loader *loader, const struct mask_blocks *blocks,
                              struct terrain_layer *layer)
{
    const struct layer_frame *f = &layer->frame;
    bool is_out_of_memory = false;
#pragma omp parallel
    {
        // Of a row, and an answer for each of its blocks.
        uint8_t *mask = mem_alloc(layer->ctx, (size_t)f->width + f->width / BLOCK + 1, 1);
        if (!mask) {
#pragma omp atomic write
            is_out_of_memory = true;
        }
#pragma omp for schedule(dynamic)
        for (uint32_t y = 0; y < f->height; y += BLOCK) {
            if (mask) {
                raise_rows(loader, blocks, layer, y, mask);
            }
        }
        mem_free(layer->ctx, mask);
    }
    return is_out_of_memory ? TRL_ERROR_MEMORY : TRL_OK;
}

// Open water draws at sea level; what lies below it is the ocean's to show. Dry land below sea
// level stays.
trl_result load_raise_sea(const struct loader *loader, struct terrain_layer *layer)
{
    // Layers that add or multiply hold differences and factors, not heights; a bed is to be seen.
    if (loader->surface->counts[SURFACE_WATER] == 0 || blend_is_change(layer->mode) ||
        layer->heights.has_bed) {
        return TRL_OK;
    }
    struct mask_blocks blocks;
    trl_result result = sum_up_mask(loader->surface, layer, &blocks);
    if (result == TRL_OK) {
        result = raise_layer(loader, &blocks, layer);
    }
    mem_free(loader->surface->ctx, blocks.answers);
    return result;
}
