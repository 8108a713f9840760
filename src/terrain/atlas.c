// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/atlas.h"

#include <math.h>
#include <string.h>

// Slots a side: at least so many, that a small picture finds room, and at most what makes a texture
// of 8192 texels.
enum { MIN_SIDE = 5, MAX_SIDE = 31, ENTRY_BYTES = 4 };
static const uint64_t FOR_EVER = UINT64_MAX;

static enum gpu_format choose_format(const struct gpu *gpu, enum pyramid_format format)
{
    switch (format) {
    case PYRAMID_INT16:
        return gpu->caps.has_norm16 ? GPU_FORMAT_R16 : GPU_FORMAT_R32F;
    case PYRAMID_FLOAT:
        return GPU_FORMAT_R32F;
    case PYRAMID_RGBA8:
        return GPU_FORMAT_RGBA8;
    case PYRAMID_UINT8:
        break;
    }
    return GPU_FORMAT_R8;
}

static size_t slot_bytes(enum gpu_format format)
{
    return PYRAMID_TEXELS * gpu_format_texel_bytes(format);
}

static trl_result make_texture(struct atlas *atlas, enum gpu_format format, double slots)
{
    struct atlas_texture *t = &atlas->textures[atlas->texture_count];
    const uint32_t most = atlas->gpu->caps.max_texture_size / PYRAMID_SIDE;
    const double side = floor(sqrt(slots));
    t->side = (uint32_t)fmax(MIN_SIDE, fmin(fmin(MAX_SIDE, most), side));
    t->slots = mem_alloc(atlas->gpu->ctx, (size_t)t->side * t->side, sizeof *t->slots);
    if (!t->slots) {
        return TRL_ERROR_MEMORY;
    }
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "tiles";
    desc.format = format;
    desc.width = desc.height = t->side * PYRAMID_SIDE;
    const bool is_filtered = format != GPU_FORMAT_R32F || atlas->gpu->caps.has_float_linear;
    desc.filter = is_filtered ? GPU_FILTER_LINEAR : GPU_FILTER_NEAREST;
    atlas->texture_count++;
    atlas->bytes += (size_t)t->side * t->side * slot_bytes(format);
    return gpu_texture_init(atlas->gpu, &desc, &t->texture);
}

// Layers of a format share a texture; each layer gets as many slots as any other.
static trl_result make_textures(struct atlas *atlas, size_t max_bytes)
{
    size_t layer_bytes = 0;
    for (uint32_t i = 0; i < atlas->layer_count; i++) {
        layer_bytes += slot_bytes(choose_format(atlas->gpu, atlas->layers[i].pyramid->format));
    }
    const double slots = (double)max_bytes / (double)(layer_bytes ? layer_bytes : 1);
    trl_result result = TRL_OK;
    for (uint32_t i = 0; i < atlas->layer_count && result == TRL_OK; i++) {
        const enum gpu_format format = choose_format(atlas->gpu, atlas->layers[i].pyramid->format);
        uint32_t alike = 0, texture = 0;
        for (uint32_t k = 0; k < atlas->layer_count; k++) {
            alike += choose_format(atlas->gpu, atlas->layers[k].pyramid->format) == format;
        }
        while (texture < atlas->texture_count &&
               atlas->textures[texture].texture.format != format) {
            texture++;
        }
        atlas->layers[i].texture = texture;
        if (texture == atlas->texture_count) {
            result = make_texture(atlas, format, slots * alike);
        }
    }
    return result;
}

static trl_result make_pages(struct atlas *atlas)
{
    uint32_t width = 1, height = 0;
    for (uint32_t i = 0; i < atlas->layer_count; i++) {
        struct atlas_layer *layer = &atlas->layers[i];
        const struct pyramid_level *finest = &layer->pyramid->levels[0];
        layer->first_row = height;
        layer->rows = 1;
        while (layer->rows < finest->rows || layer->rows < finest->columns) {
            layer->rows *= 2;
        }
        width = finest->columns > width ? finest->columns : width;
        height += 2 * layer->rows;
    }
    atlas->entries = mem_alloc(atlas->gpu->ctx, (size_t)width * height, ENTRY_BYTES);
    if (!atlas->entries) {
        return TRL_ERROR_MEMORY;
    }
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "pages";
    desc.width = width;
    desc.height = height;
    desc.filter = GPU_FILTER_NEAREST;
    atlas->bytes += (size_t)width * height * ENTRY_BYTES;
    return gpu_texture_init(atlas->gpu, &desc, &atlas->pages);
}

trl_result atlas_init(struct gpu *gpu, const struct atlas_desc *desc, struct atlas *out)
{
    *out = (struct atlas){.gpu = gpu, .frame = 1, .layer_count = desc->layer_count};
    for (uint32_t i = 0; i < desc->layer_count; i++) {
        out->layers[i].pyramid = desc->pyramids[i];
    }
    out->converted = mem_alloc(gpu->ctx, PYRAMID_TEXELS, sizeof(float));
    trl_result result = out->converted ? make_textures(out, desc->max_bytes) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = make_pages(out);
    }
    if (result != TRL_OK) {
        atlas_finish(out);
    }
    return result;
}

void atlas_finish(struct atlas *atlas)
{
    for (uint32_t i = 0; i < atlas->texture_count; i++) {
        mem_free(atlas->gpu->ctx, atlas->textures[i].slots);
        gpu_texture_finish(&atlas->textures[i].texture);
    }
    if (atlas->gpu) {
        mem_free(atlas->gpu->ctx, atlas->entries);
        mem_free(atlas->gpu->ctx, atlas->converted);
    }
    gpu_texture_finish(&atlas->pages);
    *atlas = (struct atlas){0};
}

void atlas_begin(struct atlas *atlas)
{
    atlas->frame++;
}

// The row of the table that a row of tiles is in: below rows * (1 + 1/2 + …).
static uint32_t find_row(const struct atlas *atlas, uint32_t layer, uint32_t level, uint32_t y)
{
    const struct atlas_layer *l = &atlas->layers[layer];
    return l->first_row + 2 * l->rows - (2 * l->rows >> level) + y;
}

static uint8_t *find_entry(const struct atlas *atlas, uint32_t layer,
                           const struct pyramid_tile *tile)
{
    const size_t row = find_row(atlas, layer, tile->level, tile->y);
    return atlas->entries + (row * atlas->pages.width + tile->x) * ENTRY_BYTES;
}

static void set_entry(struct atlas *atlas, uint32_t layer, const struct pyramid_tile *tile,
                      const uint8_t entry[ENTRY_BYTES])
{
    const uint32_t row = find_row(atlas, layer, tile->level, tile->y);
    const bool is_first = atlas->changed_end == 0;
    atlas->changed_first = is_first || row < atlas->changed_first ? row : atlas->changed_first;
    atlas->changed_end = row + 1 > atlas->changed_end ? row + 1 : atlas->changed_end;
    memcpy(find_entry(atlas, layer, tile), entry, ENTRY_BYTES);
}

// An entry that names no slot has 0 here.
static bool is_own(const uint8_t *entry, uint32_t level)
{
    return entry[3] != 0 && entry[2] == level;
}

// Entries below a tile whose own has changed: they follow their parents unless they have tiles.
static void refresh_below(struct atlas *atlas, uint32_t layer, const struct pyramid_tile *tile)
{
    const struct pyramid *p = atlas->layers[layer].pyramid;
    for (uint32_t i = 1; i <= tile->level; i++) {
        const uint32_t level = tile->level - i;
        const uint32_t right = (tile->x + 1) << i, bottom = (tile->y + 1) << i;
        for (uint32_t y = tile->y << i; y < bottom && y < p->levels[level].rows; y++) {
            for (uint32_t x = tile->x << i; x < right && x < p->levels[level].columns; x++) {
                const struct pyramid_tile at = {level, x, y};
                const struct pyramid_tile parent = {level + 1, x / 2, y / 2};
                if (!is_own(find_entry(atlas, layer, &at), level)) {
                    set_entry(atlas, layer, &at, find_entry(atlas, layer, &parent));
                }
            }
        }
    }
}

bool atlas_touch(struct atlas *atlas, uint32_t layer, const struct pyramid_tile *tile)
{
    const uint8_t *entry = find_entry(atlas, layer, tile);
    if (!is_own(entry, tile->level)) {
        return false;
    }
    struct atlas_texture *t = &atlas->textures[atlas->layers[layer].texture];
    struct atlas_slot *slot = &t->slots[entry[1] * t->side + entry[0]];
    slot->frame = slot->frame == FOR_EVER ? FOR_EVER : atlas->frame;
    return true;
}

uint32_t atlas_capacity(const struct atlas *atlas, uint32_t layer)
{
    const struct atlas_texture *t = &atlas->textures[atlas->layers[layer].texture];
    return t->side * t->side;
}

static struct atlas_slot *find_oldest(struct atlas_texture *t)
{
    struct atlas_slot *oldest = &t->slots[0];
    for (uint32_t i = 1; i < t->side * t->side; i++) {
        oldest = t->slots[i].frame < oldest->frame ? &t->slots[i] : oldest;
    }
    return oldest;
}

static void evict(struct atlas *atlas, const struct atlas_slot *slot)
{
    const struct pyramid_tile parent = {slot->tile.level + 1, slot->tile.x / 2, slot->tile.y / 2};
    set_entry(atlas, slot->layer, &slot->tile, find_entry(atlas, slot->layer, &parent));
    refresh_below(atlas, slot->layer, &slot->tile);
}

// Texels as the texture wants them: shorts as steps from the lowest, or as floats.
static const void *convert(struct atlas *atlas, const struct atlas_texture *t,
                           enum pyramid_format format, const void *texels)
{
    const int16_t *shorts = texels;
    uint16_t *steps = atlas->converted;
    float *floats = atlas->converted;
    if (format != PYRAMID_INT16) {
        return texels;
    }
    for (size_t i = 0; i < PYRAMID_TEXELS && t->texture.format == GPU_FORMAT_R16; i++) {
        steps[i] = (uint16_t)(shorts[i] - INT16_MIN);
    }
    for (size_t i = 0; i < PYRAMID_TEXELS && t->texture.format == GPU_FORMAT_R32F; i++) {
        floats[i] = shorts[i];
    }
    return atlas->converted;
}

trl_result atlas_put(struct atlas *atlas, uint32_t layer, const struct pyramid_tile *tile,
                     const void *texels, bool *is_put)
{
    const struct pyramid *p = atlas->layers[layer].pyramid;
    struct atlas_texture *t = &atlas->textures[atlas->layers[layer].texture];
    struct atlas_slot *slot = find_oldest(t);
    *is_put = slot->frame < atlas->frame;
    if (!*is_put) {
        return TRL_OK;
    }
    if (slot->frame > 0) {
        evict(atlas, slot);
    }
    const uint32_t index = (uint32_t)(slot - t->slots);
    const uint32_t column = index % t->side, row = index / t->side;
    const bool is_last = tile->level + 1 == p->level_count;
    *slot = (struct atlas_slot){is_last ? FOR_EVER : atlas->frame, layer, *tile};
    const uint8_t entry[ENTRY_BYTES] = {(uint8_t)column, (uint8_t)row, (uint8_t)tile->level, 255};
    set_entry(atlas, layer, tile, entry);
    refresh_below(atlas, layer, tile);
    const struct gpu_region region = {
        0, column * PYRAMID_SIDE, row * PYRAMID_SIDE, 0, PYRAMID_SIDE, PYRAMID_SIDE, 1};
    return gpu_texture_upload(&t->texture, &region, convert(atlas, t, p->format, texels));
}

trl_result atlas_commit(struct atlas *atlas)
{
    const uint32_t first = atlas->changed_first, end = atlas->changed_end;
    if (end == 0) {
        return TRL_OK;
    }
    atlas->changed_first = atlas->changed_end = 0;
    const struct gpu_region rows = {0, 0, first, 0, atlas->pages.width, end - first, 1};
    return gpu_texture_upload(&atlas->pages, &rows,
                              atlas->entries + (size_t)first * atlas->pages.width * ENTRY_BYTES);
}

void atlas_describe(const struct atlas *atlas, uint32_t layer, float paging[4])
{
    const struct atlas_layer *l = &atlas->layers[layer];
    paging[0] = (float)l->pyramid->levels[0].width;
    paging[1] = (float)l->pyramid->levels[0].height;
    paging[2] = (float)l->first_row;
    paging[3] = (float)l->rows + (float)(l->pyramid->level_count - 1) / 32;
}
