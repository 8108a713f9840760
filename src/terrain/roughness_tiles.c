// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Roughness of layers that are held in tiles: some tiles tell how that of the finest texels goes
// with that of the coarse level, which is known everywhere.
#include "shared/shared.glsl"
#include "terrain/roughness.h"
#include "terrain/stream.h"

#include <math.h>

// Of an equirectangular raster only tiles whose texels are nearly square.
enum { PLACES = 60, MOST_TILES = 12, STEP = 4 };
static const double MOST_LATITUDE = 0.9;

static double value_at(const struct stream_layer *l, const void *texels, uint32_t x, uint32_t y)
{
    const size_t i = (size_t)y * PYRAMID_SIDE + x;
    return l->pyramid.format == PYRAMID_INT16 ? ((const int16_t *)texels)[i]
                                              : (double)((const float *)texels)[i];
}

// The mean of what roughness.c measures, over a tile of the finest texels.
static double mean_of_tile(const struct stream_layer *l, const void *texels)
{
    const double scale = l->layer->heights.scale;
    double sum = 0, count = 0;
    const uint32_t far = ROUGHNESS_TEXELS;
    for (uint32_t y = far; y < PYRAMID_SIDE - far; y += STEP) {
        for (uint32_t x = far; x < PYRAMID_SIDE - far; x += STEP) {
            const double middle = 2 * value_at(l, texels, x, y);
            const double along =
                value_at(l, texels, x, y - far) + value_at(l, texels, x, y + far) - middle;
            const double across =
                value_at(l, texels, x - far, y) + value_at(l, texels, x + far, y) - middle;
            const double rounding = l->pyramid.format == PYRAMID_INT16 ? 0.5 : 0;
            sum += scale * scale * fmax(0.5 * (along * along + across * across) - rounding, 0);
            count++;
        }
    }
    return sum / count;
}

// The same of the coarse level where that tile is.
static double mean_of_coarse(const struct stream_layer *l, const struct pyramid_tile *tile)
{
    enum { SIDE = 4 };
    double sum = 0;
    for (int k = 0; k < SIDE * SIDE; k++) {
        const double x = (tile->x + (k % SIDE + 0.5) / SIDE) * PYRAMID_TILE - 0.5;
        const double y = (tile->y + (k / SIDE + 0.5) / SIDE) * PYRAMID_TILE - 0.5;
        const struct layer_geo g = layer_geo_of(&l->frame, x, y);
        sum += roughness_square_bend(l->layer, g.latitude, g.longitude);
    }
    return sum / (SIDE * SIDE);
}

static bool is_square_there(const struct stream_layer *l, const struct pyramid_tile *tile)
{
    const struct layer_geo g =
        layer_geo_of(&l->frame, (tile->x + 0.5) * PYRAMID_TILE, (tile->y + 0.5) * PYRAMID_TILE);
    return l->frame.pole != 0 || fabs(g.latitude) < MOST_LATITUDE;
}

double roughness_of_tiles(const trl_context *ctx, const struct terrain_layer *layer, double hurst)
{
    const struct stream_layer *l = layer->tiles;
    if (!l || l->pyramid.base_level == 0) {
        return 1;
    }
    const double assumed = pow(l->frame.texel_height / layer->frame.texel_height, hurst);
    struct pyramid_reader reader;
    void *texels = mem_alloc(ctx, PYRAMID_TEXELS, pyramid_texel_bytes(l->pyramid.format));
    double fine = 0, coarse = 0;
    int tiles = 0;
    if (!texels || pyramid_reader_init(ctx, &l->pyramid, &reader) != TRL_OK) {
        mem_free(ctx, texels);
        return assumed;
    }
    for (int i = 0; i < PLACES && tiles < MOST_TILES; i++) {
        // Whole tiles only, spread evenly: multiples of two numbers like the golden ratio.
        const double columns = l->frame.width / PYRAMID_TILE, rows = l->frame.height / PYRAMID_TILE;
        const struct pyramid_tile tile = {0, (uint32_t)(fmod(i * 0.75487766624669, 1) * columns),
                                          (uint32_t)(fmod(i * 0.56984029099805, 1) * rows)};
        const double beside = is_square_there(l, &tile) ? mean_of_coarse(l, &tile) : 0;
        struct tile_range range;
        const struct tile_load load = {tile, texels, &range};
        if (beside > 0 && pyramid_read(&reader, &tile, texels) == TRL_OK &&
            stream_prepare(l, &reader, &load) == TRL_OK) {
            fine += mean_of_tile(l, texels);
            coarse += beside;
            tiles++;
        }
    }
    pyramid_reader_finish(&reader);
    mem_free(ctx, texels);
    return fine > 0 && coarse > 0 ? sqrt(fine / coarse) : assumed;
}
