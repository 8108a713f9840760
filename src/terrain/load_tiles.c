// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Which rasters of a surface are held in tiles, and how those begin.
#include "terrain/load.h"
#include "terrain/stream.h"
#include "terrain/voids.h"

#include <math.h>
#include <string.h>

// What tiles get at the least, however much the rasters held whole take.
static const double LEAST_TILE_BYTES = 32e6;

static bool must_be_tiled(const struct loader *loader, const struct raster *raster)
{
    const struct gpu *gpu = loader->surface->gpu;
    const uint32_t longest = raster->width > raster->height ? raster->width : raster->height;
    return raster->is_remote || (gpu && longest > gpu->caps.max_texture_size);
}

static bool is_candidate(const struct load_item *item)
{
    return item->opened == TRL_OK && !item->is_passed_over && !item->is_tiled;
}

void load_choose_tiled(struct loader *loader)
{
    const struct surface_desc *desc = loader->desc;
    double whole = 0;
    bool has_tiled = false;
    for (size_t i = 0; i < desc->layer_count; i++) {
        struct load_item *item = &loader->items[i];
        item->is_tiled = is_candidate(item) && must_be_tiled(loader, &item->raster);
        has_tiled = has_tiled || item->is_tiled;
        whole += is_candidate(item) ? load_whole_bytes(loader, &desc->layers[i], &item->raster) : 0;
    }
    while (whole > (has_tiled ? desc->max_bytes / 2 : desc->max_bytes)) {
        double largest = 0;
        size_t index = 0;
        for (size_t i = 0; i < desc->layer_count; i++) {
            const struct load_item *item = &loader->items[i];
            const double bytes =
                is_candidate(item) ? load_whole_bytes(loader, &desc->layers[i], &item->raster) : 0;
            index = bytes > largest ? i : index;
            largest = fmax(largest, bytes);
        }
        loader->items[index].is_tiled = has_tiled = true;
        whole -= largest;
    }
}

static enum pyramid_format choose_format(enum surface_kind kind, const struct raster *raster)
{
    switch (kind) {
    case SURFACE_ELEVATION:
        return raster->type == RASTER_FLOAT ? PYRAMID_FLOAT : PYRAMID_INT16;
    case SURFACE_WATER:
        return PYRAMID_UINT8;
    default:
        return PYRAMID_RGBA8;
    }
}

// Finer tiles fill their gaps from this level.
static void give_filled(struct pyramid *p, const struct terrain_layer *layer)
{
    const struct layer_heights *h = &layer->heights;
    float *floats = p->whole[p->base_level];
    int16_t *shorts = p->whole[p->base_level];
    for (size_t i = 0; i < (size_t)layer->frame.width * layer->frame.height; i++) {
        if (h->floats && !isfinite(floats[i])) {
            floats[i] = h->floats[i];
        } else if (h->shorts && p->raster.has_nodata && (double)shorts[i] == p->raster.nodata) {
            shorts[i] = h->shorts[i];
        }
    }
}

static trl_result take_elevation(struct loader *loader, const struct surface_layer_desc *desc,
                                 struct stream_layer *tiles, struct terrain_layer *layer)
{
    const struct load_below under = {loader->surface, layer->mode};
    const struct layer_fill below = {load_fill_height, &under};
    struct pyramid *p = &tiles->pyramid;
    trl_result result = load_set_scale(loader, desc, &p->raster, layer);
    if (result == TRL_OK) {
        result = layer_take_heights(&p->raster, p->whole[p->base_level], &below, layer);
        // Tiles hold nothing but heights.
        mem_free(layer->ctx, layer->heights.coarser);
        layer->heights.coarser = NULL;
    }
    if (result == TRL_OK) {
        give_filled(p, layer);
    }
    if (result == TRL_OK) {
        result = load_raise_sea(loader, layer);
    }
    if (result == TRL_OK && loader->surface->gpu) {
        layer_scale_texture(loader->surface->gpu, layer);
    }
    return result;
}

// The coarse level of a mask or a picture, as bytes.
static trl_result take_bytes(const struct stream_layer *tiles, struct terrain_layer *layer,
                             uint8_t **out)
{
    const struct pyramid *p = &tiles->pyramid;
    const size_t count = (size_t)layer->frame.width * layer->frame.height;
    const size_t texel = pyramid_texel_bytes(p->format);
    *out = mem_alloc(layer->ctx, count, texel);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    memcpy(*out, p->whole[p->base_level], count * texel);
    return TRL_OK;
}

static trl_result take_picture(const struct loader *loader, const struct stream_layer *tiles,
                               struct terrain_layer *layer)
{
    if (loader->surface->gpu) {
        return TRL_OK;
    }
    trl_result result = take_bytes(tiles, layer, &layer->roots);
    if (result == TRL_OK) {
        result = voids_fill_picture(&tiles->pyramid.raster, &layer->frame, layer->roots);
    }
    if (result == TRL_OK && tiles->is_root) {
        layer_take_roots(&layer->cover, layer->roots,
                         (size_t)layer->frame.width * layer->frame.height);
    }
    return result;
}

static trl_result take_coarse(struct loader *loader, const struct surface_layer_desc *desc,
                              struct stream_layer *tiles, struct terrain_layer *layer)
{
    struct surface *s = loader->surface;
    switch (desc->kind) {
    case SURFACE_ELEVATION:
        return take_elevation(loader, desc, tiles, layer);
    case SURFACE_WATER:
        return take_bytes(tiles, layer, &s->masks[s->counts[SURFACE_WATER]]);
    default:
        return take_picture(loader, tiles, layer);
    }
}

static trl_result make_tiles(const struct loader *loader, const struct surface_layer_desc *desc,
                             const struct raster *raster, struct stream_layer *tiles)
{
    const struct layer_frame frame =
        layer_frame_of(raster, raster->width, raster->height, desc->feather_rad);
    const struct pyramid_desc pyramid = {.raster = raster,
                                         .format = choose_format(desc->kind, raster),
                                         .wraps = frame.is_whole_circle,
                                         .over_north = frame.touches_north,
                                         .over_south = frame.touches_south};
    tiles->frame = frame;
    tiles->surface = loader->surface;
    tiles->is_elevation = desc->kind == SURFACE_ELEVATION;
    tiles->is_root = desc->kind == SURFACE_COLOUR || desc->kind == SURFACE_LIGHTS;
    return pyramid_init(&loader->quiet, &pyramid, &tiles->pyramid);
}

trl_result load_tiled(struct loader *loader, const struct surface_layer_desc *desc,
                      const struct raster *raster, struct terrain_layer *layer)
{
    struct surface *s = loader->surface;
    trl_result result = TRL_OK;
    if (!s->stream) {
        result = stream_create(s->ctx, s->gpu, loader->desc->waits, &s->stream);
    }
    struct stream_layer *tiles = result == TRL_OK ? stream_add(s->stream) : NULL;
    if (!tiles) {
        return result == TRL_OK ? TRL_ERROR_INVALID : result;
    }
    result = make_tiles(loader, desc, raster, tiles);
    if (result == TRL_OK) {
        const struct pyramid_level *coarse = &tiles->pyramid.levels[tiles->pyramid.base_level];
        layer->frame = layer_frame_of(raster, coarse->width, coarse->height, desc->feather_rad);
        result = take_coarse(loader, desc, tiles, layer);
    }
    if (result != TRL_OK) {
        stream_drop(s->stream);
        return result;
    }
    tiles->pyramid.ctx = tiles->pyramid.raster.ctx = s->ctx; // the loader is gone soon
    tiles->layer = layer;
    layer->stream = s->stream;
    layer->tiles = tiles;
    return TRL_OK;
}

trl_result load_start_stream(struct loader *loader)
{
    struct surface *s = loader->surface;
    if (s->stream && s->stream->layer_count == 0) {
        stream_destroy(&s->stream); // none that was to be held in tiles is any good
    }
    if (!s->stream) {
        return TRL_OK;
    }
    double left = loader->desc->max_bytes - loader->bytes;
    for (uint32_t i = 0; i < s->stream->layer_count; i++) {
        left -= (double)s->stream->layers[i].pyramid.bytes;
    }
    return stream_start(s->stream, (size_t)fmax(left, LEAST_TILE_BYTES));
}
