// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/ceiling.h"

#include "shared/blend.glsl"
#include "shared/cubic.glsl"

#include <math.h>

// Texels of a block of the lowest level, in each direction.
enum { BLOCK = 4 };
// Nearer to a pole than this times the neighbourhood's size, longitude says little.
static const double POLE_FACTOR = 4;

static uint32_t divide_up(uint32_t a, uint32_t b)
{
    return (a + b - 1) / b;
}

// The cubic reaches two texels beyond a block on each side, and overshoots by part of its range.
static double bound_block(const struct terrain_layer *layer, uint32_t column, uint32_t row)
{
    const int64_t x = (int64_t)column * BLOCK, y = (int64_t)row * BLOCK;
    double low = INFINITY, high = -INFINITY;
    for (int64_t j = y - 2; j < y + BLOCK + 2; j++) {
        for (int64_t i = x - 2; i < x + BLOCK + 2; i++) {
            const double height = layer_texel(layer, i, j);
            low = fmin(low, height);
            high = fmax(high, height);
        }
    }
    // Of a layer in tiles only a coarse level is looked at: see bounds.c for what may rise above.
    return high + (CUBIC_OVERSHOOT + (layer->tiles ? 1 : 0)) * (high - low);
}

static void fill_lowest(struct ceiling_pyramid *pyramid)
{
#pragma omp parallel for schedule(dynamic, 8)
    for (uint32_t y = 0; y < pyramid->height[0]; y++) {
        for (uint32_t x = 0; x < pyramid->width[0]; x++) {
            // Rounded up: a float's half unit is 1e-7 of it.
            const double bound = bound_block(pyramid->layer, x, y);
            pyramid->highest[0][(size_t)y * pyramid->width[0] + x] =
                (float)(bound + 1e-6 * fabs(bound));
        }
    }
}

static float block_at(const struct ceiling_pyramid *pyramid, int level, uint32_t x, uint32_t y)
{
    return pyramid->highest[level][(size_t)y * pyramid->width[level] + x];
}

static void fill_level(struct ceiling_pyramid *pyramid, int level)
{
    const uint32_t width = pyramid->width[level - 1], height = pyramid->height[level - 1];
    for (uint32_t y = 0; y < pyramid->height[level]; y++) {
        for (uint32_t x = 0; x < pyramid->width[level]; x++) {
            const uint32_t right = 2 * x + 1 < width ? 2 * x + 1 : 2 * x;
            const uint32_t below = 2 * y + 1 < height ? 2 * y + 1 : 2 * y;
            const float upper = fmaxf(block_at(pyramid, level - 1, 2 * x, 2 * y),
                                      block_at(pyramid, level - 1, right, 2 * y));
            const float lower = fmaxf(block_at(pyramid, level - 1, 2 * x, below),
                                      block_at(pyramid, level - 1, right, below));
            pyramid->highest[level][(size_t)y * pyramid->width[level] + x] = fmaxf(upper, lower);
        }
    }
}

static trl_result pyramid_init(const trl_context *ctx, const struct terrain_layer *layer,
                               struct ceiling_pyramid *out)
{
    *out = (struct ceiling_pyramid){.layer = layer};
    uint32_t width = divide_up(layer->frame.width, BLOCK);
    uint32_t height = divide_up(layer->frame.height, BLOCK);
    size_t count = 0;
    for (bool is_last = false; !is_last; out->level_count++) {
        out->width[out->level_count] = width;
        out->height[out->level_count] = height;
        count += (size_t)width * height;
        is_last = width == 1 && height == 1;
        width = divide_up(width, 2);
        height = divide_up(height, 2);
    }
    out->highest[0] = mem_alloc(ctx, count, sizeof(float));
    if (!out->highest[0]) {
        return TRL_ERROR_MEMORY;
    }
    fill_lowest(out);
    for (int level = 1; level < out->level_count; level++) {
        out->highest[level] =
            out->highest[level - 1] + (size_t)out->width[level - 1] * out->height[level - 1];
        fill_level(out, level);
    }
    out->all = (double)out->highest[out->level_count - 1][0];
    return TRL_OK;
}

// Of the steepest difference of neighbours, the cubic's slope is at most 3/2. Columns toward the
// poles are narrow; there the ground is level enough.
static double find_steepest(const struct terrain_layer *layer, double radius_m)
{
    const struct layer_frame *f = &layer->frame;
    double steepest = 0;
#pragma omp parallel for reduction(max : steepest)
    for (uint32_t y = 0; y < f->height - 1; y++) {
        const struct layer_geo geo = layer_geo_of(f, 0, y);
        const double shrink = f->pole == 0 ? fmax(cos(geo.latitude), 0.05) : 0.5;
        for (uint32_t x = 0; x + 1 < f->width; x++) {
            const double here = layer_texel(layer, x, y);
            const double across = fabs(layer_texel(layer, x + 1, y) - here);
            const double along = fabs(layer_texel(layer, x, y + 1) - here);
            steepest = fmax(steepest, across / (f->texel_width * shrink));
            steepest = fmax(steepest, along / (f->texel_height * (f->pole == 0 ? 1 : 0.5)));
        }
    }
    return 1.5 * steepest / radius_m;
}

static void find_slopes(struct terrain_ceiling *ceiling)
{
    const struct surface *s = ceiling->surface;
    ceiling->steepest_map = s->is_invented ? noise_find_steepest(&s->noise) : 0;
    for (size_t i = 0; i < ceiling->count; i++) {
        ceiling->pyramids[i].steepest = find_steepest(ceiling->pyramids[i].layer, s->radius_m);
    }
}

trl_result terrain_ceiling_init(const struct surface *surface, struct terrain_ceiling *out)
{
    *out = (struct terrain_ceiling){.surface = surface};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < surface->counts[SURFACE_ELEVATION] && result == TRL_OK; i++) {
        result = pyramid_init(surface->ctx, &surface->layers[SURFACE_ELEVATION][i],
                              &out->pyramids[out->count]);
        out->count += result == TRL_OK;
    }
    if (result == TRL_OK && noise_is_there(&surface->noise)) {
        find_slopes(out);
    }
    if (result != TRL_OK) {
        terrain_ceiling_finish(out);
    }
    return result;
}

void terrain_ceiling_finish(struct terrain_ceiling *ceiling)
{
    for (size_t i = 0; i < ceiling->count; i++) {
        mem_free(ceiling->surface->ctx, ceiling->pyramids[i].highest[0]);
    }
    *ceiling = (struct terrain_ceiling){0};
}

// A neighbourhood: a place, and how far it reaches from there.
struct reach {
    double latitude, longitude;
    double north, east; // half extents; north < 0: everything
};

static struct reach find_reach(struct vec3 direction, double angle_rad)
{
    const double axis_distance = hypot(direction.x, direction.y);
    const double cosine = axis_distance / vec3_length(direction);
    struct reach reach = {atan2(direction.z, axis_distance), atan2(direction.y, direction.x),
                          angle_rad, -1};
    if (angle_rad < 0.5 && cosine > POLE_FACTOR * angle_rad) {
        // The meridians that touch a circle: sin(east) = sin(angle) / cos(latitude).
        reach.east = asin(fmin(1, sin(angle_rad) / cosine));
    } else {
        reach.north = -1;
    }
    return reach;
}

// The highest of the blocks of a level that the reach touches; columns wrap where the layer does.
static double highest_of(const struct ceiling_pyramid *pyramid, const struct layer_place *place,
                         const double reach[2])
{
    const double size = 2 * fmax(reach[0], reach[1]) / BLOCK;
    const int level = size > 1 ? (int)ceil(log2(size)) : 0;
    if (level >= pyramid->level_count) {
        return pyramid->all;
    }
    const double texels = ldexp(BLOCK, level);
    const struct layer_frame *frame = &pyramid->layer->frame;
    const double width = frame->width;
    double highest = -INFINITY;
    // At most two blocks in each direction, so the corners see all of them.
    for (int k = 0; k < 4; k++) {
        double x = place->x + (k % 2 ? reach[0] : -reach[0]);
        const double y = place->y + (k / 2 ? reach[1] : -reach[1]);
        if (frame->is_whole_circle) {
            x -= width * floor(x / width);
            // The first and the last block of a row may be parts: where the circle closes, look at
            // both.
            if (x < reach[0] * 2 + BLOCK || x > width - reach[0] * 2 - BLOCK) {
                return pyramid->all;
            }
        }
        const double last_x = pyramid->width[level] - 1.0, last_y = pyramid->height[level] - 1.0;
        const uint32_t column = (uint32_t)fmin(fmax(floor(x / texels), 0), last_x);
        const uint32_t row = (uint32_t)fmin(fmax(floor(y / texels), 0), last_y);
        highest = fmax(highest, (double)block_at(pyramid, level, column, row));
    }
    return highest;
}

static bool reaches_layer(const struct layer_frame *frame, const struct reach *reach)
{
    double east = reach->longitude - frame->centre_x;
    east -= 2 * SHARED_PI * floor(east / (2 * SHARED_PI) + 0.5);
    const double north = reach->latitude - frame->centre_y;
    return (frame->is_whole_circle || fabs(east) <= frame->half_width + reach->east) &&
           fabs(north) <= frame->half_height + reach->north + frame->texel_height;
}

// The highest that a layer about a pole has within an angle of a direction.
static double highest_about_pole(const struct ceiling_pyramid *pyramid, struct vec3 direction,
                                 double angle_rad)
{
    const struct layer_frame *frame = &pyramid->layer->frame;
    const struct vec3 up = vec3_normalize(direction);
    const double away = acos(fmax(-1, fmin(1, vec3_dot(up, frame->direction))));
    if (away > angle_rad + frame->reach_rad + frame->texel_height) {
        return -INFINITY;
    }
    // The farther from the pole, the larger the map: 1 / cos^2 of half the angle, and 1 % for what
    // an ellipsoid adds.
    const double from_pole = acos(fmax(-1, fmin(1, frame->pole * up.z))) + angle_rad;
    if (from_pole > 2) {
        return pyramid->all;
    }
    const double half = cos(from_pole / 2);
    const double reach = 1.01 * angle_rad / (half * half);
    const struct layer_place place =
        layer_locate(frame, asin(fmax(-1, fmin(1, up.z))), atan2(up.y, up.x));
    const double texels[2] = {reach / frame->texel_width + 1, reach / frame->texel_height + 1};
    return highest_of(pyramid, &place, texels);
}

static double highest_around(const struct ceiling_pyramid *pyramid, const struct reach *reach)
{
    const struct layer_frame *frame = &pyramid->layer->frame;
    const bool is_nearly_round = !frame->is_whole_circle && frame->half_width + reach->east > 3;
    if (reach->north < 0 || is_nearly_round) {
        return pyramid->all;
    }
    if (!reaches_layer(frame, reach)) {
        return -INFINITY;
    }
    const struct layer_place place = layer_locate(frame, reach->latitude, reach->longitude);
    // A texel more: places are texels' middles.
    const double texels[2] = {reach->east / frame->texel_width + 1,
                              reach->north / frame->texel_height + 1};
    return highest_of(pyramid, &place, texels);
}

// The least weight of a layer within an angle of a direction, by its middle and four sides.
static double least_weight(const struct layer_frame *f, struct vec3 up, double angle_rad)
{
    const struct anchor a = anchor_below(up);
    double least = 1;
    for (int k = 0; k < 5; k++) {
        const struct vec3 way = k < 3 ? vec3_scale(a.east, k - 1) : vec3_scale(a.north, 2 * k - 7);
        const struct vec3 p = vec3_add(up, vec3_scale(way, 1.5 * angle_rad));
        least = fmin(least, layer_locate(f, atan2(p.z, hypot(p.x, p.y)), atan2(p.y, p.x)).weight);
    }
    return least;
}

// Of the ground without octaves: of all layers in reach, and of the feathers in which they give way
// to each other. What covers all hides what is below.
static double find_slope_around(const struct terrain_ceiling *ceiling, struct vec3 up,
                                double angle_rad, double range_m)
{
    const double radius_m = ceiling->surface->radius_m;
    double steepest = ceiling->steepest_map;
    for (size_t i = 0; i < ceiling->count; i++) {
        const struct terrain_layer *layer = ceiling->pyramids[i].layer;
        const struct layer_frame *f = &layer->frame;
        const double away = acos(fmax(-1, fmin(1, vec3_dot(up, f->direction))));
        if (f->reach_rad < SHARED_PI && away > angle_rad + f->reach_rad) {
            continue;
        }
        const double feather = fmax(f->feather, f->texel_height) * radius_m;
        const bool covers = least_weight(f, up, angle_rad) >= 1;
        const double slope = ceiling->pyramids[i].steepest;
        steepest = covers && layer->mode == BLEND_OVER ? slope : steepest + slope;
        steepest += covers ? 0 : 1.5 * range_m / feather;
    }
    return steepest;
}

// With noise: the surface's table of bounds, whose cells are large, or what the ground at the place
// and its slopes allow.
static double bound_noise(const struct terrain_ceiling *ceiling, struct vec3 up, double angle_rad)
{
    const struct surface *s = ceiling->surface;
    const double widest = 0.2; // more cells than that are not worth looking at
    if (angle_rad > widest) {
        return surface_max_altitude(s);
    }
    const struct surface_bounds cells = surface_bounds_around(s, up, angle_rad);
    const double table = (double)cells.max;
    const double reach = angle_rad * s->radius_m;
    const double slope = find_slope_around(ceiling, up, angle_rad, table - (double)cells.min);
    if (slope * reach > table - (double)cells.min) {
        return table;
    }
    struct noise_place place;
    surface_find_place(s, up, &place);
    const struct noise_rise rise = noise_find_rise(&s->noise, &place.ground, reach);
    // Near the sea roughness changes within metres of altitude.
    const double full = s->noise.desc.full_height_m;
    if (full > 0 && fabs(place.ground.height_m) < full + slope * reach) {
        return table;
    }
    place.octaves = rise.octaves;
    const double here = noise_relief_at(&s->noise, &place).height;
    const double slopes = here + slope * reach + rise.rise_m;
    return fmin(table, s->noise.desc.has_sea ? fmax(slopes, 0) : slopes);
}

double terrain_ceiling_m(const struct terrain_ceiling *ceiling, struct vec3 direction,
                         double angle_rad)
{
    if (noise_is_there(&ceiling->surface->noise)) {
        return bound_noise(ceiling, vec3_normalize(direction), angle_rad);
    }
    const struct reach reach = find_reach(direction, angle_rad);
    double highest = 0; // where no layer is; layers are laid over it
    for (size_t i = 0; i < ceiling->count; i++) {
        const struct ceiling_pyramid *pyramid = &ceiling->pyramids[i];
        const struct terrain_layer *layer = pyramid->layer;
        const double high = layer->frame.pole == 0
                                ? highest_around(pyramid, &reach)
                                : highest_about_pole(pyramid, direction, angle_rad);
        if (isfinite(high)) {
            highest = fmax(highest, blend_whole(layer->mode, highest, high));
        }
    }
    return highest;
}
