// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Models of small areas, and the colours of one.
#include "prepare.h"

#include "raster/raster.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define PI 3.14159265358979323846

static trl_result write_inset(const struct places *places, const struct inset *inset,
                              const struct raster *raster)
{
    const uint32_t margin = inset->margin;
    const uint32_t width = raster->width + 2 * margin, height = raster->height + 2 * margin;
    float *values = mem_alloc(places->ctx, (size_t)raster->width * raster->height, sizeof *values);
    float *wide = mem_alloc(places->ctx, (size_t)width * height, sizeof *wide);
    const struct raster_window window = raster_window_whole(raster, 0);
    trl_result result =
        values && wide ? raster_read_float(raster, &window, 0, values) : TRL_ERROR_MEMORY;
    for (size_t i = 0; i < (size_t)width * height && result == TRL_OK; i++) {
        wide[i] = NAN;
    }
    for (uint32_t y = 0; y < raster->height && result == TRL_OK; y++) {
        memcpy(wide + (size_t)(y + margin) * width + margin, values + (size_t)y * raster->width,
               raster->width * sizeof *wide);
    }
    const struct inset_grid grid = {width,
                                    height,
                                    raster->west_deg - margin * raster->pixel_width_deg,
                                    raster->north_deg + margin * raster->pixel_height_deg,
                                    raster->pixel_height_deg,
                                    wide};
    if (result == TRL_OK && inset->has_sea) {
        result = coast_make_bed(places, &grid);
    }
    if (result == TRL_OK) {
        const struct geotiff g = {.name = inset->name,
                                  .width = width,
                                  .height = height,
                                  .bands = 1,
                                  .kind = PIXEL_FLOAT,
                                  .west_deg = grid.west_deg,
                                  .north_deg = grid.north_deg,
                                  .pixel_width_deg = raster->pixel_width_deg,
                                  .pixel_height_deg = raster->pixel_height_deg,
                                  .pixels = wide,
                                  .unit = "metre"};
        result = geotiff_write(places, &g);
    }
    mem_free(places->ctx, values);
    mem_free(places->ctx, wide);
    return result;
}

trl_result inset_prepare(const struct places *places, const struct inset *inset)
{
    char *path = source_path(places, inset->file);
    struct raster raster = {0};
    trl_result result = path ? raster_open(places->ctx, path, &raster) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = write_inset(places, inset, &raster);
        raster_finish(&raster);
    }
    mem_free(places->ctx, path);
    return result;
}

// 9 km around the tiles of 3 seconds, 4 km around Mount St. Helens' 30 m.
trl_result earth_prepare_insets(const struct places *places)
{
    static const struct inset INSETS[] = {
        {"earth/insets/N42E001.hgt.zip", "andorra.tif", 100, false},
        {"earth/insets/N43E007.hgt.zip", "monaco.tif", 100, true},
        {"earth/insets/SainteHelens.dem", "st-helens.tif", 130, false}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof INSETS / sizeof INSETS[0] && result == TRL_OK; i++) {
        if (source_exists(places, INSETS[i].file)) {
            result = inset_prepare(places, &INSETS[i]);
        }
    }
    return result;
}

// Four tiles of zoom 17, counted from the south: column, row.
enum { GALE_ZOOM = 17, GALE_COLUMN = 115550, GALE_ROW = 63834, GALE_TILES = 2, TILE = 256 };
#define GALE_TILE "mars/gale_inset/tiles_tms/%d/%d/%d.png"

static trl_result read_gale_tile(const struct places *places, int column, int row,
                                 struct picture *whole)
{
    char relative[96];
    snprintf(relative, sizeof relative, GALE_TILE, GALE_ZOOM, GALE_COLUMN + column, GALE_ROW + row);
    struct picture tile;
    trl_result result = picture_read(places, relative, &tile);
    if (result == TRL_OK && (tile.width != TILE || tile.height != TILE || tile.bands < 3)) {
        result = trl_fail(places->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                          "%s: not a colour tile of %d x %d", relative, TILE, TILE);
    }
    const size_t top = (size_t)(GALE_TILES - 1 - row) * TILE, left = (size_t)column * TILE;
    for (size_t i = 0; i < (size_t)TILE * TILE && result == TRL_OK; i++) {
        const size_t to = (top + i / TILE) * whole->width + left + i % TILE;
        memcpy(whole->pixels + 3 * to, tile.pixels + i * tile.bands, 3);
    }
    picture_finish(places, &tile);
    return result;
}

// The mean light of the globe's colours there, which the inset's shall have, too.
static trl_result read_base(const struct places *places, double light[3])
{
    char *path = mem_printf(places->ctx, "%s/colour.tif", places->out_dir);
    struct raster raster = {0};
    trl_result result = path ? raster_open(places->ctx, path, &raster) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        const double longitude = GALE_COLUMN * 360.0 / (1 << GALE_ZOOM) - 180, latitude = -4.667;
        const struct raster_window one = {
            (uint32_t)((longitude - raster.west_deg) / raster.pixel_width_deg),
            (uint32_t)((raster.north_deg - latitude) / raster.pixel_height_deg),
            1,
            1,
            1,
            1};
        uint8_t pixel[4];
        result = raster_read_rgba8(&raster, &one, pixel);
        for (int c = 0; c < 3 && result == TRL_OK; c++) {
            light[c] = light_of_code(pixel[c]);
        }
        raster_finish(&raster);
    }
    mem_free(places->ctx, path);
    return result;
}

// The picture is in false colours (infrared, red, blue-green). Its brightness is kept, half of its
// contrast, and a part of its colours; the mean becomes that of the globe's map.
static void turn_into_albedo(struct picture *p, const double base[3])
{
    static const double CONTRAST = 0.5, COLOUR = 0.25, WHITE = 0.45;
    const size_t count = (size_t)p->width * p->height;
    double mean[3] = {0};
    for (size_t i = 0; i < 3 * count; i++) {
        mean[i % 3] += light_of_code(p->pixels[i]) / (double)count;
    }
    for (size_t i = 0; i < count; i++) {
        double part[3], grey = 0;
        for (size_t c = 0; c < 3; c++) {
            part[c] = light_of_code(p->pixels[3 * i + c]) / mean[c];
            grey += part[c] / 3;
        }
        for (size_t c = 0; c < 3; c++) {
            const double own = grey + COLOUR * (part[c] - grey);
            const double light = base[c] * fmax(0.2, 1 + CONTRAST * (own - 1));
            p->pixels[3 * i + c] = (uint8_t)lrint(code_of_light(fmin(light, WHITE)));
        }
    }
}

static trl_result prepare_gale_colour(const struct places *places)
{
    struct picture p = {GALE_TILES * TILE, GALE_TILES * TILE, 3, NULL};
    p.pixels = mem_alloc(places->ctx, (size_t)p.width * p.height, 3);
    double base[3];
    trl_result result = p.pixels ? read_base(places, base) : TRL_ERROR_MEMORY;
    for (int i = 0; i < GALE_TILES * GALE_TILES && result == TRL_OK; i++) {
        result = read_gale_tile(places, i % GALE_TILES, i / GALE_TILES, &p);
    }
    if (result == TRL_OK) {
        turn_into_albedo(&p, base);
        // Spherical Mercator: the side of a tile is the circumference over 2^zoom.
        const double tile_m = 2 * PI * 3396190 / (1 << GALE_ZOOM);
        const double middle = 1 << (GALE_ZOOM - 1);
        const struct geotiff g = {.name = "gale-colour.tif",
                                  .width = p.width,
                                  .height = p.height,
                                  .bands = 3,
                                  .kind = PIXEL_UINT8,
                                  .projection =
                                      "+proj=merc +lon_0=0 +k=1 +R=3396190 +units=m +no_defs",
                                  .left_m = (GALE_COLUMN - middle) * tile_m,
                                  .top_m = (GALE_ROW + GALE_TILES - middle) * tile_m,
                                  .pixel_m = tile_m / TILE,
                                  .pixels = p.pixels};
        result = geotiff_write(places, &g);
    }
    picture_finish(places, &p);
    return result;
}

trl_result mars_prepare_insets(const struct places *places)
{
    const struct inset gale = {"mars/gale_inset/gale_hirise_dem_1m.tif", "gale.tif", 600, false};
    char relative[96];
    snprintf(relative, sizeof relative, GALE_TILE, GALE_ZOOM, GALE_COLUMN, GALE_ROW);
    trl_result result = TRL_OK;
    if (source_exists(places, gale.file)) {
        result = inset_prepare(places, &gale);
    }
    if (result == TRL_OK && source_exists(places, relative) &&
        source_exists(places, "mars/mars_color_5400x2700.jpg")) {
        result = prepare_gale_colour(places);
    }
    return result;
}
