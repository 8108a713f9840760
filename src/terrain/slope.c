// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/slope.h"

#include "shared/blend.glsl"

#include <math.h>

// Linear between texels.
static double sample_linear(const struct terrain_layer *layer, double x, double y)
{
    const int64_t column = (int64_t)floor(x), row = (int64_t)floor(y);
    const double fx = x - (double)column, fy = y - (double)row;
    const double north =
        (1 - fx) * layer_texel(layer, column, row) + fx * layer_texel(layer, column + 1, row);
    const double south = (1 - fx) * layer_texel(layer, column, row + 1) +
                         fx * layer_texel(layer, column + 1, row + 1);
    return (1 - fy) * north + fy * south;
}

// Columns and rows of half a step: texels are narrower than high toward the poles of
// equirectangular maps, and steps are alike in metres.
static void find_steps(const struct layer_frame *f, struct vec3 up, double steps[2])
{
    const double cosine = fmax(hypot(up.x, up.y), 1e-5);
    const double right = fmin(0.5 * f->texel_height / cosine, SHARED_PI / 2);
    steps[0] = f->pole == 0 ? right / f->texel_width : 0.5;
    steps[1] = 0.5;
}

// The way from one side of a place to the other on the map, as a vector of the unit sphere.
static struct vec3 find_way(const struct layer_frame *f, const struct layer_place *place, double dx,
                            double dy)
{
    const struct layer_geo a = layer_geo_of(f, place->x - dx, place->y - dy);
    const struct layer_geo b = layer_geo_of(f, place->x + dx, place->y + dy);
    return vec3_sub(vec3_from_lat_lon(b.latitude, b.longitude),
                    vec3_from_lat_lon(a.latitude, a.longitude));
}

// Both maps are conformal or have their axes along meridians and parallels: the parts of the slope
// along the two ways add up.
static struct vec3 find_slope(const struct terrain_layer *layer, const struct layer_place *place,
                              struct vec3 up)
{
    double steps[2];
    find_steps(&layer->frame, up, steps);
    struct vec3 slope = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        const double dx = i == 0 ? steps[0] : 0, dy = i == 1 ? steps[1] : 0;
        const struct vec3 chord = find_way(&layer->frame, place, dx, dy);
        const struct vec3 way = vec3_sub(chord, vec3_scale(up, vec3_dot(chord, up)));
        const double length = vec3_length(way);
        // The angle along the parallel, not its chord.
        const double angle =
            i == 0 && layer->frame.pole == 0
                ? 2 * steps[0] * layer->frame.texel_width * fmax(hypot(up.x, up.y), 1e-5)
                : 2 * asin(fmin(1, length / 2));
        const double rise = sample_linear(layer, place->x + dx, place->y + dy) -
                            sample_linear(layer, place->x - dx, place->y - dy);
        slope = vec3_add(slope, vec3_scale(way, rise / (angle * fmax(length, 1e-30))));
    }
    return slope;
}

void slope_lay_over(const struct terrain_layer *layer, struct vec3 up, double radius_m,
                    struct slope *s)
{
    const struct layer_place place =
        layer_locate(&layer->frame, atan2(up.z, hypot(up.x, up.y)), atan2(up.y, up.x));
    if (!(place.weight > 0)) {
        return;
    }
    const struct vec3 own = vec3_scale(find_slope(layer, &place, up), 1 / radius_m);
    const double height = sample_linear(layer, place.x, place.y);
    const double mode = layer->mode;
    const struct vec3 whole = {blend_slope(mode, s->height_m, height, s->slope.x, own.x),
                               blend_slope(mode, s->height_m, height, s->slope.y, own.y),
                               blend_slope(mode, s->height_m, height, s->slope.z, own.z)};
    s->slope = vec3_add(s->slope, vec3_scale(vec3_sub(whole, s->slope), place.weight));
    s->height_m = blend_layers(mode, s->height_m, height, place.weight);
    s->log2_texel += place.weight * (log2(layer->frame.texel_height * radius_m) - s->log2_texel);
}
