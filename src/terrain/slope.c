// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/slope.h"

#include "shared/blend.glsl"

#include <math.h>

// Linear between the finest texels, at a place given in those.
static double sample_linear(const struct terrain_layer *layer, double x, double y)
{
    const struct layer_frame *f = layer_finest_frame(layer);
    return layer_sample_linear(layer, (x + 0.5) * layer->frame.width / f->width - 0.5,
                               (y + 0.5) * layer->frame.height / f->height - 0.5);
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
    const struct layer_frame *f = layer_finest_frame(layer);
    double steps[2];
    find_steps(f, up, steps);
    struct vec3 slope = {0, 0, 0};
    for (int i = 0; i < 2; i++) {
        const double dx = i == 0 ? steps[0] : 0, dy = i == 1 ? steps[1] : 0;
        const struct vec3 chord = find_way(f, place, dx, dy);
        const struct vec3 way = vec3_sub(chord, vec3_scale(up, vec3_dot(chord, up)));
        const double length = vec3_length(way);
        // The angle along the parallel, not its chord.
        const double angle = i == 0 && f->pole == 0
                                 ? 2 * steps[0] * f->texel_width * fmax(hypot(up.x, up.y), 1e-5)
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
    const struct layer_frame *f = layer_finest_frame(layer);
    const double latitude = atan2(up.z, hypot(up.x, up.y));
    if (layer_is_beyond(f, latitude)) {
        return;
    }
    const struct layer_place place = layer_locate(f, latitude, atan2(up.y, up.x));
    if (!(place.weight > 0)) {
        return;
    }
    const struct vec3 tilt = vec3_scale(find_slope(layer, &place, up), 1 / radius_m);
    const double height = sample_linear(layer, place.x, place.y);
    const double mode = layer->mode;
    const struct vec3 whole = {blend_slope(mode, s->height_m, height, s->slope.x, tilt.x),
                               blend_slope(mode, s->height_m, height, s->slope.y, tilt.y),
                               blend_slope(mode, s->height_m, height, s->slope.z, tilt.z)};
    s->slope = vec3_add(s->slope, vec3_scale(vec3_sub(whole, s->slope), place.weight));
    s->height_m = blend_layers(mode, s->height_m, height, place.weight);
    // In a gap it is known more coarsely, but not more than what is below.
    const double own = log2(f->texel_height * radius_m);
    const double texel =
        fmin(own + layer_coarser(layer, place.x, place.y), fmax(s->log2_texel, own));
    s->data = (ReliefData){texel, s->log2_texel, place.weight};
    s->log2_texel += place.weight * (texel - s->log2_texel);
}
