// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/make.h"

#include "terrain/roughness.h"

#include <math.h>

// Below the data: half folded; natural slopes grow with the -0.1st power of the scale or so;
// gullies are from an eighth of the first wave down; level ground is as much smoother; and there is
// no relief at sea level, where water is.
static const double DETAIL_RIDGED = 0.5;
static const double DETAIL_HURST = 0.9;
static const double DETAIL_WAVES_TO_GULLY = 8;
static const double DETAIL_LEVEL_ROUGHNESS = 0.35;
static const double DETAIL_FULL_HEIGHT_M = 25;

trl_result make_ground(const struct surface_desc *desc, struct surface *s)
{
    s->noise.ctx = s->ctx;
    s->noise.radius_m = s->radius_m;
    s->biomes = desc->biomes;
    if (desc->noise.octaves == 0 || !(desc->continents.height_m > 0)) {
        return TRL_OK;
    }
    struct noise_map map;
    trl_result result = continents_make(s->ctx, &desc->continents, &map);
    if (result == TRL_OK) {
        result = noise_init(s->gpu, &desc->noise, &map, &s->noise);
    }
    s->is_invented = result == TRL_OK;
    return result;
}

trl_result make_detail(const struct surface_desc *desc, struct surface *s)
{
    const struct surface_detail *d = &desc->detail;
    const bool is_wanted = d->smallest_m > 0 && (d->roughness > 0 || d->albedo_variation > 0);
    if (s->is_invented || !is_wanted || s->counts[SURFACE_ELEVATION] == 0) {
        return TRL_OK;
    }
    const struct terrain_layer *lowest = &s->layers[SURFACE_ELEVATION][0];
    const double texel_m = layer_finest_frame(lowest)->texel_height * s->radius_m;
    // Measured on what is held of the layer: of tiles, that is a coarse level.
    const double finer = roughness_of_tiles(s->ctx, lowest, DETAIL_HURST);
    const struct roughness_desc roughness = {lowest, s->radius_m, d->roughness * finer,
                                             DETAIL_RIDGED};
    const double wave_m = ROUGHNESS_TEXELS * texel_m;
    const struct noise_desc noise = {.form = NOISE_ERODED,
                                     .octaves = NOISE_MAX_OCTAVES,
                                     .wavelength_m = wave_m,
                                     .mountain_m = wave_m,
                                     .gully_m = wave_m / DETAIL_WAVES_TO_GULLY,
                                     .lacunarity = 2,
                                     .hurst = DETAIL_HURST,
                                     .smallest_m = fmin(d->smallest_m, wave_m),
                                     .level_roughness = DETAIL_LEVEL_ROUGHNESS,
                                     .full_height_m =
                                         s->counts[SURFACE_WATER] > 0 ? DETAIL_FULL_HEIGHT_M : 0,
                                     .albedo_variation = d->albedo_variation};
    struct noise_map map;
    const trl_result result = roughness_make(s->ctx, &roughness, &map);
    s->rock = d->rock;
    return result == TRL_OK ? noise_init(s->gpu, &noise, &map, &s->noise) : result;
}

// The texels that a cell's spline sees, one after another: those of the cell and one beside it. It
// stays between them.
struct window {
    const struct noise_map *map;
    int first_x, first_y, columns, rows;
};

static struct window open_window(const struct surface *s, int column, int row)
{
    const struct noise_map *map = &s->noise.map;
    const int width = (int)map->width / SURFACE_BOUNDS_COLUMNS;
    const int height = (int)map->height / SURFACE_BOUNDS_ROWS;
    return (struct window){map, column * width - 1, row * height - 1, width + 2, height + 2};
}

static const struct noise_texel *window_texel(const struct window *w, int i)
{
    const int height = (int)w->map->height, width = (int)w->map->width;
    int x = w->first_x + i % w->columns, y = w->first_y + i / w->columns;
    if (y < 0 || y >= height) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    return &w->map->texels[y * width + (x + width) % width];
}

struct surface_bounds make_bound_ground(const struct surface *s, int column, int row)
{
    const struct window w = open_window(s, column, row);
    struct surface_bounds b = {INFINITY, -INFINITY};
    for (int i = 0; i < w.columns * w.rows; i++) {
        b.min = fminf(b.min, window_texel(&w, i)->height_m);
        b.max = fmaxf(b.max, window_texel(&w, i)->height_m);
    }
    return b;
}

struct noise_reach make_bound_octaves(const struct surface *s, int column, int row)
{
    const struct window w = open_window(s, column, row);
    double amplitude = 0, least = 1, most = 0;
    for (int i = 0; i < w.columns * w.rows; i++) {
        const struct noise_texel *t = window_texel(&w, i);
        amplitude = fmax(amplitude, (double)t->amplitude_m);
        least = fmin(least, (double)t->ridged);
        most = fmax(most, (double)t->ridged);
    }
    return (struct noise_reach){noise_find_reach(&s->noise, amplitude, most).down_m,
                                noise_find_reach(&s->noise, amplitude, least).up_m};
}
