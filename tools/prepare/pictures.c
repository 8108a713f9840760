// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Colour of the ground and light of the cities: the largest picture that is there, as it is.
#include "prepare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { WORLD_COLUMNS = 4, WORLD_SIDE = 2048 }; // tiles of the 8k picture: 4 north, 4 south

static void format_world_tile(int i, char relative[static 160])
{
    snprintf(relative, 160, WORLD_8K, i < WORLD_COLUMNS ? 'N' : 'S', i % WORLD_COLUMNS + 1);
}

static bool has_world_8k(const struct places *places)
{
    bool is_complete = true;
    for (int i = 0; i < 2 * WORLD_COLUMNS && is_complete; i++) {
        char relative[160];
        format_world_tile(i, relative);
        is_complete = source_exists(places, relative);
    }
    return is_complete;
}

// Copies a tile's colours; its fourth band, the lights turned over, is not needed.
static void copy_tile(const struct picture *tile, int index, struct picture *whole)
{
    const size_t left = (size_t)(index % WORLD_COLUMNS) * WORLD_SIDE;
    const size_t top = (size_t)(index / WORLD_COLUMNS) * WORLD_SIDE;
    for (size_t y = 0; y < WORLD_SIDE; y++) {
        const uint8_t *from = tile->pixels + y * WORLD_SIDE * tile->bands;
        uint8_t *to = whole->pixels + ((top + y) * whole->width + left) * whole->bands;
        for (size_t x = 0; x < WORLD_SIDE; x++) {
            memcpy(to + 3 * x, from + tile->bands * x, 3);
        }
    }
}

static trl_result read_world_8k(const struct places *places, struct picture *out)
{
    *out = (struct picture){WORLD_COLUMNS * WORLD_SIDE, 2 * WORLD_SIDE, 3, NULL};
    out->pixels = mem_alloc(places->ctx, (size_t)out->width * out->height, out->bands);
    trl_result result = out->pixels ? TRL_OK : TRL_ERROR_MEMORY;
    for (int i = 0; i < 2 * WORLD_COLUMNS && result == TRL_OK; i++) {
        char relative[160];
        format_world_tile(i, relative);
        struct picture tile;
        result = picture_read(places, relative, &tile);
        if (result == TRL_OK &&
            (tile.width != WORLD_SIDE || tile.height != WORLD_SIDE || tile.bands < 3)) {
            result = trl_fail(places->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                              "%s: not the colour tile of %d x %d that is known", relative,
                              WORLD_SIDE, WORLD_SIDE);
        }
        if (result == TRL_OK) {
            copy_tile(&tile, i, out);
        }
        picture_finish(places, &tile);
    }
    return result;
}

// Around the poles, where there is hardly anything else, the picture keeps its snow.
static trl_result prepare_colour(const struct places *places, struct picture *snow)
{
    struct picture picture = {0};
    trl_result result;
    if (has_world_8k(places)) {
        result = read_world_8k(places, &picture);
    } else {
        const bool has_4k = source_exists(places, BLUE_MARBLE_4K);
        result = picture_read(places, has_4k ? BLUE_MARBLE_4K : BLUE_MARBLE_SMALL, &picture);
    }
    if (result == TRL_OK) {
        const struct globe_values globe = {picture.width, picture.height, picture.bands, NULL,
                                           picture.pixels};
        result = polar_prepare(places, "earth", "colour", &globe);
    }
    if (result == TRL_OK) {
        result = snow_take_out(places, &picture, snow);
    }
    if (result == TRL_OK) {
        result = picture_write(places, "colour.tif", &picture);
    }
    picture_finish(places, &picture);
    return result;
}

// Red of the brightest cities in each picture.
static const double WHITE_4K = 110;
static const double WHITE_SMALL = 255;

// The published pictures show lights over moonlit land and ice, which is blue, painted in. What is
// not redder than that is no lamp. The rest is stretched until the brightest cities are white.
static void keep_lamps(struct picture *picture, double white)
{
    const size_t count = (size_t)picture->width * picture->height;
    const double gain = 255 / white;
    for (size_t i = 0; i < count; i++) {
        uint8_t *pixel = picture->pixels + i * picture->bands;
        const double excess = gain * (pixel[0] - 0.6 * pixel[2]) - 12;
        const double lamp = fmin(1, fmax(0, excess / 40));
        for (uint32_t band = 0; band < picture->bands; band++) {
            pixel[band] = (uint8_t)lrint(fmin(255, lamp * gain * pixel[band]));
        }
    }
}

static trl_result prepare_lights(const struct places *places)
{
    const bool has_4k = source_exists(places, CITY_LIGHTS_4K);
    struct picture picture;
    trl_result result = picture_read(places, has_4k ? CITY_LIGHTS_4K : CITY_LIGHTS_SMALL, &picture);
    if (result == TRL_OK && picture.bands < 3) {
        result = trl_fail(places->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                          "the picture of the night is not in colour");
    }
    if (result == TRL_OK) {
        keep_lamps(&picture, has_4k ? WHITE_4K : WHITE_SMALL);
        result = picture_write(places, "lights.tif", &picture);
    }
    picture_finish(places, &picture);
    return result;
}

// A day's clouds over the globe, as cover. Without the picture there is none.
static trl_result prepare_clouds(const struct places *places)
{
    if (!source_exists(places, CLOUD_COVER_4K)) {
        return TRL_OK;
    }
    struct picture picture;
    trl_result result = picture_read_opacity(places, CLOUD_COVER_4K, &picture);
    if (result == TRL_OK) {
        result = picture_write(places, "clouds.tif", &picture);
    }
    picture_finish(places, &picture);
    return result;
}

trl_result earth_prepare_pictures(const struct places *places, struct picture *snow)
{
    *snow = (struct picture){0};
    trl_result result = prepare_colour(places, snow);
    if (result == TRL_OK) {
        result = prepare_lights(places);
    }
    return result == TRL_OK ? prepare_clouds(places) : result;
}
