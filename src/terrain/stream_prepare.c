// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What is done to a tile on a loader's thread: the same that is done to rasters that are held whole
// (load.c), as far as a tile can know it.
#include "terrain/stream.h"

#include "shared/blend.glsl"
#include "terrain/surface.h"
#include "terrain/voids.h"

#include <math.h>
#include <string.h>

// Cosines of the latitude between which heights go over to the coarse level's: there it is that
// texels are averaged around the pole, since they are narrower than high.
static const double POLE_BEGINS = 1.0 / 16, POLE_ENDS = 1.0 / 48;

struct tile_heights {
    const struct stream_layer *l;
    uint32_t level;
    double first_x, first_y; // of the tile's texels, in those of the level
    int16_t *shorts;
    float *floats;
};

static double get_height(const struct tile_heights *t, size_t i)
{
    return t->shorts ? t->shorts[i] : (double)t->floats[i];
}

static void set_height(const struct tile_heights *t, size_t i, double value)
{
    if (t->shorts) {
        t->shorts[i] = (int16_t)lrint(fmax(INT16_MIN, fmin(INT16_MAX, value)));
    } else {
        t->floats[i] = (float)value;
    }
}

// Column or row of a tile's texel on another grid over the same raster.
static double map_texel(double first, size_t i, uint32_t from, uint32_t to)
{
    return (first + (double)i + 0.5) * to / from - 0.5;
}

// What the coarse level holds at a texel, in units of the file.
static double coarse_value(const struct tile_heights *t, size_t i)
{
    const struct terrain_layer *layer = t->l->layer;
    const struct pyramid_level *level = &t->l->pyramid.levels[t->level];
    const double x = map_texel(t->first_x, i % PYRAMID_SIDE, level->width, layer->frame.width);
    const double y = map_texel(t->first_y, i / PYRAMID_SIDE, level->height, layer->frame.height);
    return (layer_sample_held(layer, x, y) - layer->heights.offset_m) / layer->heights.scale;
}

static struct layer_geo place_of(const struct tile_heights *t, size_t i)
{
    const struct layer_frame *f = &t->l->frame;
    const struct pyramid_level *level = &t->l->pyramid.levels[t->level];
    return layer_geo_of(f, map_texel(t->first_x, i % PYRAMID_SIDE, level->width, f->width),
                        map_texel(t->first_y, i / PYRAMID_SIDE, level->height, f->height));
}

// In what is left of gaps stands what the coarse level has there: its own were filled when it was
// read.
static void fill_voids(const struct tile_heights *t)
{
    const struct raster *raster = &t->l->pyramid.raster;
    for (size_t i = 0; i < PYRAMID_TEXELS; i++) {
        const bool is_void = t->floats
                                 ? !isfinite(t->floats[i])
                                 : raster->has_nodata && (double)t->shorts[i] == raster->nodata;
        if (is_void) {
            set_height(t, i, coarse_value(t, i));
        }
    }
}

static void level_pole(const struct tile_heights *t)
{
    const struct layer_frame *f = &t->l->frame;
    for (size_t row = 0; row < PYRAMID_SIDE && f->is_whole_circle; row++) {
        const struct layer_geo g = place_of(t, row * PYRAMID_SIDE);
        const bool is_near = g.latitude > 0 ? f->touches_north : f->touches_south;
        const double part = (POLE_BEGINS - cos(g.latitude)) / (POLE_BEGINS - POLE_ENDS);
        if (!is_near || part <= 0) {
            continue;
        }
        const double s = fmin(part, 1);
        for (size_t i = row * PYRAMID_SIDE; i < (row + 1) * PYRAMID_SIDE; i++) {
            const double value = get_height(t, i);
            set_height(t, i, value + s * s * (3 - 2 * s) * (coarse_value(t, i) - value));
        }
    }
}

static void raise_sea(const struct tile_heights *t)
{
    const struct terrain_layer *layer = t->l->layer;
    const struct surface *s = t->l->surface;
    const double zero = -layer->heights.offset_m / layer->heights.scale;
    if (s->counts[SURFACE_WATER] == 0 || blend_is_change(layer->mode) || layer->heights.has_bed) {
        return;
    }
    for (size_t i = 0; i < PYRAMID_TEXELS; i++) {
        if (get_height(t, i) < zero) {
            const struct layer_geo g = place_of(t, i);
            if (surface_mask(s, g.latitude, g.longitude) > 127) {
                set_height(t, i, zero);
            }
        }
    }
}

static struct tile_range find_range(const struct tile_heights *t)
{
    const struct layer_heights *h = &t->l->layer->heights;
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < PYRAMID_TEXELS; i++) {
        const double value = h->offset_m + h->scale * get_height(t, i);
        low = fmin(low, value);
        high = fmax(high, value);
    }
    return (struct tile_range){(float)low, (float)high};
}

// Colours spread into gaps, so that filters mix in no black; alpha falls toward them, where the
// file does not say by itself how; then roots.
static trl_result prepare_picture(const struct stream_layer *l, struct pyramid_reader *reader,
                                  const struct tile_load *load)
{
    uint8_t *rgba = load->texels;
    const struct layer_frame frame = {.width = PYRAMID_SIDE, .height = PYRAMID_SIDE};
    trl_result result = TRL_OK;
    size_t voids = 0;
    for (size_t i = 0; i < PYRAMID_TEXELS; i++) {
        voids += rgba[4 * i + 3] == 0;
    }
    if (voids > 0 && voids < PYRAMID_TEXELS) {
        result = voids_spread_colours(reader->raster.ctx, &frame, rgba);
    }
    if (result == TRL_OK && voids < PYRAMID_TEXELS && !l->pyramid.raster.has_alpha) {
        result = stream_feather(l, reader, &load->tile, rgba);
    }
    if (result == TRL_OK && l->is_root) {
        layer_take_roots(&l->layer->cover, rgba, PYRAMID_TEXELS);
    }
    return result;
}

static trl_result prepare_heights(const struct stream_layer *l, struct pyramid_reader *reader,
                                  const struct tile_load *load)
{
    const struct pyramid_window window = pyramid_window_of(&load->tile);
    const bool is_float = l->pyramid.format == PYRAMID_FLOAT;
    const struct tile_heights t = {.l = l,
                                   .level = window.level,
                                   .first_x = (double)window.x,
                                   .first_y = (double)window.y,
                                   .shorts = is_float ? NULL : load->texels,
                                   .floats = is_float ? load->texels : NULL};
    const trl_result result = pyramid_fill_gaps(reader, &window, load->texels);
    if (result == TRL_OK) {
        fill_voids(&t);
        level_pole(&t);
        raise_sea(&t);
        *load->range = find_range(&t);
    }
    return result;
}

trl_result stream_prepare(const void *user, struct pyramid_reader *reader,
                          const struct tile_load *load)
{
    const struct stream_layer *l = user;
    if (l->is_elevation) {
        return prepare_heights(l, reader, load);
    }
    return l->pyramid.format == PYRAMID_RGBA8 ? prepare_picture(l, reader, load) : TRL_OK;
}
