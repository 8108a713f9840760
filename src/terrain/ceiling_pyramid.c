// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/ceiling_pyramid.h"

#include "shared/blend.glsl"
#include "shared/cubic.glsl"
#include "shared/shared.glsl"

#include <math.h>

// Texels of a block of the lowest level, in each direction; with what the cubic sees beside it.
enum { BLOCK = 4, SEEN = BLOCK + 4 };
// Nearer to a pole than this times the neighbourhood's size, longitude says little.
static const double POLE_FACTOR = 4;

static uint32_t divide_up(uint32_t a, uint32_t b)
{
    return (a + b - 1) / b;
}

// The texels that a block's cubic sees: two more on each side.
static void see_block(const struct terrain_layer *layer, uint32_t column, uint32_t row,
                      double seen[SEEN][SEEN])
{
    const struct layer_heights *h = &layer->heights;
    const int64_t width = layer->frame.width, height = layer->frame.height;
    const int64_t x = (int64_t)column * BLOCK - 2, y = (int64_t)row * BLOCK - 2;
    const bool is_inside = x >= 0 && y >= 0 && x + SEEN <= width && y + SEEN <= height;
    for (int64_t j = 0; j < SEEN; j++) {
        const size_t begin = is_inside ? (size_t)((y + j) * width + x) : 0;
        for (int64_t i = 0; i < SEEN; i++) {
            if (is_inside) {
                const double units =
                    h->shorts ? h->shorts[begin + (size_t)i] : (double)h->floats[begin + (size_t)i];
                seen[j][i] = h->offset_m + h->scale * units;
            } else {
                seen[j][i] = layer_texel(layer, x + i, y + j);
            }
        }
    }
}

// Rounded up: a float's half unit is 1e-7 of it.
static float round_up(double bound)
{
    return (float)(bound + 1e-6 * fabs(bound));
}

// The cubic overshoots by part of its range.
static float find_highest(const struct terrain_layer *layer, double seen[SEEN][SEEN])
{
    double low = INFINITY, high = -INFINITY;
    for (int i = 0; i < SEEN * SEEN; i++) {
        const double height = seen[i / SEEN][i % SEEN];
        low = height < low ? height : low;
        high = height > high ? height : high;
    }
    // Of a layer in tiles only a coarse level is looked at: see bounds.c for what may rise above.
    return round_up(high + (CUBIC_OVERSHOOT + (layer->tiles ? 1 : 0)) * (high - low));
}

// Of the steepest differences of neighbours, the cubic's slopes are at most 3/2. `texel`: width and
// height on the ground. Of a layer in tiles the finest are not looked at.
static float find_steepest(const struct terrain_layer *layer, double seen[SEEN][SEEN],
                           const double texel[2])
{
    double across = 0, along = 0;
    for (int j = 0; j < SEEN; j++) {
        for (int i = 0; i + 1 < SEEN; i++) {
            const double x = fabs(seen[j][i + 1] - seen[j][i]);
            const double y = fabs(seen[i + 1][j] - seen[i][j]);
            across = x > across ? x : across;
            along = y > along ? y : along;
        }
    }
    return layer->tiles ? INFINITY : round_up(1.5 * hypot(across / texel[0], along / texel[1]));
}

// Columns toward the poles are narrow; there the ground is level enough. About a pole the map grows
// outward as 1 / cos^2 of half the angle.
static void find_texel(const struct terrain_layer *layer, uint32_t row, double radius_m,
                       double texel[2])
{
    const struct layer_frame *f = &layer->frame;
    const double y = fmin((double)row * BLOCK + BLOCK / 2.0, f->height - 1.0);
    const double half = (SHARED_PI / 2 - f->least_latitude) / 2;
    const double outer = pow(cos(fmin(half, 1)), 2);
    const double farther = (BLOCK / 2.0 + 2) * f->texel_height;
    const double cosine =
        f->pole == 0 ? cos(fmin(fabs(layer_geo_of(f, 0, y).latitude) + farther, SHARED_PI / 2))
                     : outer;
    texel[0] = f->texel_width * radius_m * fmax(cosine, 0.05);
    texel[1] = f->texel_height * radius_m * (f->pole == 0 ? 1 : outer);
}

static void fill_lowest(struct ceiling_pyramid *pyramid, double radius_m)
{
#pragma omp parallel for schedule(dynamic, 8)
    for (uint32_t y = 0; y < pyramid->height[0]; y++) {
        double texel[2];
        find_texel(pyramid->layer, y, radius_m, texel);
        for (uint32_t x = 0; x < pyramid->width[0]; x++) {
            const size_t i = (size_t)y * pyramid->width[0] + x;
            double seen[SEEN][SEEN];
            see_block(pyramid->layer, x, y, seen);
            pyramid->values[CEILING_HIGHEST][0][i] = find_highest(pyramid->layer, seen);
            if (pyramid->values[CEILING_STEEPEST][0]) {
                pyramid->values[CEILING_STEEPEST][0][i] =
                    find_steepest(pyramid->layer, seen, texel);
            }
        }
    }
}

static float block_at(const struct ceiling_pyramid *pyramid, enum ceiling_value value, int level,
                      const uint32_t at[2])
{
    return pyramid->values[value][level][(size_t)at[1] * pyramid->width[level] + at[0]];
}

static void fill_level(struct ceiling_pyramid *pyramid, enum ceiling_value value, int level)
{
    const uint32_t width = pyramid->width[level - 1], height = pyramid->height[level - 1];
    for (uint32_t y = 0; y < pyramid->height[level]; y++) {
        for (uint32_t x = 0; x < pyramid->width[level]; x++) {
            float most = -INFINITY;
            for (uint32_t k = 0; k < 4; k++) {
                const uint32_t at[2] = {2 * x + k % 2 < width ? 2 * x + k % 2 : 2 * x,
                                        2 * y + k / 2 < height ? 2 * y + k / 2 : 2 * y};
                most = fmaxf(most, block_at(pyramid, value, level - 1, at));
            }
            pyramid->values[value][level][(size_t)y * pyramid->width[level] + x] = most;
        }
    }
}

static size_t place_levels(struct ceiling_pyramid *pyramid)
{
    uint32_t width = divide_up(pyramid->layer->frame.width, BLOCK);
    uint32_t height = divide_up(pyramid->layer->frame.height, BLOCK);
    size_t count = 0;
    for (bool is_last = false; !is_last; pyramid->level_count++) {
        pyramid->width[pyramid->level_count] = width;
        pyramid->height[pyramid->level_count] = height;
        count += (size_t)width * height;
        is_last = width == 1 && height == 1;
        width = divide_up(width, 2);
        height = divide_up(height, 2);
    }
    return count;
}

static void fill_levels(struct ceiling_pyramid *pyramid, enum ceiling_value value)
{
    float **levels = pyramid->values[value];
    for (int i = 1; i < pyramid->level_count; i++) {
        levels[i] = levels[i - 1] + (size_t)pyramid->width[i - 1] * pyramid->height[i - 1];
        fill_level(pyramid, value, i);
    }
    pyramid->all[value] = (double)levels[pyramid->level_count - 1][0];
}

// As find_highest, of all texels.
static double find_lowest(const struct terrain_layer *layer)
{
    double low = INFINITY, high = -INFINITY;
    for (int64_t y = 0; y < layer->frame.height; y++) {
        for (int64_t x = 0; x < layer->frame.width; x++) {
            const double value = layer_texel(layer, x, y);
            low = value < low ? value : low;
            high = value > high ? value : high;
        }
    }
    return low - (CUBIC_OVERSHOOT + (layer->tiles ? 1 : 0)) * (high - low);
}

trl_result ceiling_pyramid_init(const struct terrain_layer *layer, double radius_m, bool has_slopes,
                                struct ceiling_pyramid *out)
{
    *out = (struct ceiling_pyramid){.layer = layer};
    const int kinds = has_slopes ? CEILING_VALUE_COUNT : CEILING_STEEPEST;
    const size_t count = place_levels(out);
    for (int i = 0; i < kinds; i++) {
        out->values[i][0] = mem_alloc(layer->ctx, count, sizeof(float));
        if (!out->values[i][0]) {
            ceiling_pyramid_finish(out);
            return TRL_ERROR_MEMORY;
        }
    }
    fill_lowest(out, radius_m);
    for (int i = 0; i < kinds; i++) {
        fill_levels(out, (enum ceiling_value)i);
    }
    out->lowest = blend_is_factor(layer->mode) ? find_lowest(layer) : 0;
    return TRL_OK;
}

void ceiling_pyramid_finish(struct ceiling_pyramid *pyramid)
{
    for (int i = 0; i < CEILING_VALUE_COUNT && pyramid->layer; i++) {
        mem_free(pyramid->layer->ctx, pyramid->values[i][0]);
    }
    *pyramid = (struct ceiling_pyramid){.layer = NULL};
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

// What is asked for: on the map, a place and how far around it, in texels.
struct question {
    enum ceiling_value value;
    struct layer_place place;
    double reach[2];
};

// The most of the blocks of a level that the reach touches; columns wrap where the layer does.
static double most_of(const struct ceiling_pyramid *pyramid, const struct question *q)
{
    const double *reach = q->reach;
    const double size = 2 * fmax(reach[0], reach[1]) / BLOCK;
    const int level = size > 1 ? (int)ceil(log2(size)) : 0;
    if (level >= pyramid->level_count) {
        return pyramid->all[q->value];
    }
    const double texels = ldexp(BLOCK, level);
    const struct layer_frame *frame = &pyramid->layer->frame;
    const double width = frame->width;
    double most = -INFINITY;
    // At most two blocks in each direction, so the corners see all of them.
    for (int k = 0; k < 4; k++) {
        double x = q->place.x + (k % 2 ? reach[0] : -reach[0]);
        const double y = q->place.y + (k / 2 ? reach[1] : -reach[1]);
        if (frame->is_whole_circle) {
            x -= width * floor(x / width);
            // The first and the last block of a row may be parts: where the circle closes, look at
            // both.
            if (x < reach[0] * 2 + BLOCK || x > width - reach[0] * 2 - BLOCK) {
                return pyramid->all[q->value];
            }
        }
        const double last_x = pyramid->width[level] - 1.0, last_y = pyramid->height[level] - 1.0;
        const uint32_t at[2] = {(uint32_t)fmin(fmax(floor(x / texels), 0), last_x),
                                (uint32_t)fmin(fmax(floor(y / texels), 0), last_y)};
        most = fmax(most, (double)block_at(pyramid, q->value, level, at));
    }
    return most;
}

static bool reaches_layer(const struct layer_frame *frame, const struct reach *reach)
{
    double east = reach->longitude - frame->centre_x;
    east -= 2 * SHARED_PI * floor(east / (2 * SHARED_PI) + 0.5);
    const double north = reach->latitude - frame->centre_y;
    return (frame->is_whole_circle || fabs(east) <= frame->half_width + reach->east) &&
           fabs(north) <= frame->half_height + reach->north + frame->texel_height;
}

static double most_about_pole(const struct ceiling_pyramid *pyramid, enum ceiling_value value,
                              struct vec3 up, double angle_rad)
{
    const struct layer_frame *frame = &pyramid->layer->frame;
    const double away = acos(fmax(-1, fmin(1, vec3_dot(up, frame->direction))));
    if (away > angle_rad + frame->reach_rad + frame->texel_height) {
        return -INFINITY;
    }
    // The farther from the pole, the larger the map: 1 / cos^2 of half the angle, and 1 % for what
    // an ellipsoid adds.
    const double from_pole = acos(fmax(-1, fmin(1, frame->pole * up.z))) + angle_rad;
    if (from_pole > 2) {
        return pyramid->all[value];
    }
    const double half = cos(from_pole / 2);
    const double reach = 1.01 * angle_rad / (half * half);
    const struct question q = {
        value,
        layer_locate(frame, asin(fmax(-1, fmin(1, up.z))), atan2(up.y, up.x)),
        {reach / frame->texel_width + 1, reach / frame->texel_height + 1}};
    return most_of(pyramid, &q);
}

static double most_around(const struct ceiling_pyramid *pyramid, enum ceiling_value value,
                          const struct reach *reach)
{
    const struct layer_frame *frame = &pyramid->layer->frame;
    const bool is_nearly_round = !frame->is_whole_circle && frame->half_width + reach->east > 3;
    if (reach->north < 0 || is_nearly_round) {
        return pyramid->all[value];
    }
    if (!reaches_layer(frame, reach)) {
        return -INFINITY;
    }
    // A texel more: places are texels' middles.
    const struct question q = {
        value,
        layer_locate(frame, reach->latitude, reach->longitude),
        {reach->east / frame->texel_width + 1, reach->north / frame->texel_height + 1}};
    return most_of(pyramid, &q);
}

double ceiling_pyramid_most(const struct ceiling_pyramid *pyramid, enum ceiling_value value,
                            struct vec3 up, double angle_rad)
{
    if (pyramid->layer->frame.pole != 0) {
        return most_about_pole(pyramid, value, up, angle_rad);
    }
    const struct reach reach = find_reach(up, angle_rad);
    return most_around(pyramid, value, &reach);
}
