// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/surface.h"

#include "shared/blend.glsl"
#include "shared/shore.glsl"
#include "terrain/slope.h"
#include "terrain/stream.h"

#include <math.h>

typedef double (*sample_fn)(const struct terrain_layer *layer, double x, double y);

// Of the layers, over what lies below them.
static double lay_over(const struct surface *s, sample_fn sample, double below, double latitude,
                       double longitude)
{
    double altitude = below;
    for (size_t i = 0; i < s->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *layer = &s->layers[SURFACE_ELEVATION][i];
        if (layer_is_beyond(&layer->frame, latitude)) {
            continue;
        }
        const struct layer_place place = layer_locate(&layer->frame, latitude, longitude);
        if (place.weight > 0) {
            const double height =
                fmax(sample(layer, place.x, place.y), layer->heights.has_bed ? 0 : -INFINITY);
            altitude = blend_layers(layer->mode, altitude, height, place.weight);
        }
    }
    return altitude;
}

uint8_t surface_blend_mask(const struct terrain_layer *mask, uint8_t below, uint8_t value)
{
    const double whole = blend_whole(mask->mode, below / 255.0, value / 255.0);
    return mask->mode == BLEND_OVER ? value : (uint8_t)lrint(255 * fmin(whole, 1));
}

uint8_t surface_mask(const struct surface *s, double latitude, double longitude)
{
    uint8_t water = 0;
    for (size_t i = 0; i < s->counts[SURFACE_WATER]; i++) {
        const struct terrain_layer *mask = &s->layers[SURFACE_WATER][i];
        const struct layer_place p = layer_locate(&mask->frame, latitude, longitude);
        if (p.weight > 0 && s->masks[i]) {
            const size_t texel = layer_texel_index(&mask->frame, lrint(p.x), lrint(p.y));
            water = surface_blend_mask(mask, water, s->masks[i][texel]);
        }
    }
    return water;
}

double surface_lake(const struct surface *s, double latitude, double longitude)
{
    double water = 0;
    if (s->stream) {
        return 0;
    }
    for (size_t i = 0; i < s->counts[SURFACE_WATER]; i++) {
        const struct layer_frame *frame = &s->layers[SURFACE_WATER][i].frame;
        const struct layer_place p = layer_locate(frame, latitude, longitude);
        if (p.weight > 0 && s->depths[i]) {
            const double x = p.x - floor(p.x), y = p.y - floor(p.y);
            double value = 0;
            for (int k = 0; k < 4; k++) {
                const size_t index = layer_texel_index(frame, (int64_t)floor(p.x) + k % 2,
                                                       (int64_t)floor(p.y) + k / 2);
                const int lake = s->depths[i][index] == 0 ? s->masks[i][index] : 0;
                value += (k % 2 ? x : 1 - x) * (k / 2 ? y : 1 - y) * lake / 255;
            }
            water = blend_layers(s->layers[SURFACE_WATER][i].mode, water, value, p.weight);
        }
    }
    return water;
}

size_t surface_count_layers(const struct surface *surface)
{
    size_t count = 0;
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        count += surface->counts[k];
    }
    return count;
}

bool surface_has_layers(const struct surface *surface)
{
    return surface_count_layers(surface) > 0 || surface->is_invented;
}

static double altitude_of_data(const struct surface *s, sample_fn sample, struct vec3 direction)
{
    const double below =
        s->is_invented ? noise_ground_at(&s->noise, vec3_normalize(direction)).height_m : 0;
    return lay_over(s, sample, below, atan2(direction.z, hypot(direction.x, direction.y)),
                    atan2(direction.y, direction.x));
}

double surface_altitude_of_data(const struct surface *s, struct vec3 direction)
{
    return altitude_of_data(s, layer_sample, direction);
}

double surface_altitude_of_held(const struct surface *s, struct vec3 direction)
{
    return altitude_of_data(s, layer_sample_held, direction);
}

// What shore_dry changes by in a m, at most: across a texel of the finest mask from 1 to 0 in each
// direction, 1.5 times as fast in the middle of the part where it does, and thrice where masks
// blend as fast.
static double steepest_dry(const struct surface *s, double latitude)
{
    double finest_rad = INFINITY;
    for (size_t i = 0; i < s->counts[SURFACE_WATER]; i++) {
        const struct layer_frame *f = &s->layers[SURFACE_WATER][i].frame;
        const double wide = f->pole == 0 ? fmax(cos(latitude), 1e-2) : 1;
        finest_rad = fmin(finest_rad, f->texel_height * wide);
    }
    return 3 * 1.5 / (0.5 - SHORE_LAKE_MADE) / (finest_rad * s->radius_m);
}

void surface_find_place(const struct surface *s, struct vec3 direction, struct noise_place *place)
{
    const double latitude = atan2(direction.z, hypot(direction.x, direction.y));
    const double longitude = atan2(direction.y, direction.x);
    const struct vec3 up = vec3_normalize(direction);
    struct noise_ground ground = noise_ground_at(&s->noise, up);
    struct slope slope = {
        ground.slope, ground.height_m, SLOPE_NO_DATA, {SLOPE_NO_DATA, SLOPE_NO_DATA, 1}};
    for (size_t i = 0; i < s->counts[SURFACE_ELEVATION]; i++) {
        slope_lay_over(&s->layers[SURFACE_ELEVATION][i], up, s->radius_m, &slope);
    }
    ground.slope = slope.slope;
    ground.height_m =
        lay_over(s, layer_sample, s->is_invented ? ground.height_m : 0, latitude, longitude);
    ground.dry = shore_dry(surface_lake(s, latitude, longitude));
    ground.dry_per_m = steepest_dry(s, latitude);
    *place = (struct noise_place){up, ground, slope.data, NOISE_ALL, NOISE_MAX_OCTAVES};
}

Relief surface_relief(const struct surface *s, struct vec3 direction, struct noise_place *place)
{
    surface_find_place(s, direction, place);
    return noise_relief_at(&s->noise, place);
}

double surface_altitude(const struct surface *s, struct vec3 direction)
{
    if (!noise_is_there(&s->noise)) {
        return surface_altitude_of_data(s, direction);
    }
    struct noise_place place;
    const double altitude = surface_relief(s, direction, &place).height;
    return s->noise.desc.has_sea ? fmax(altitude, 0) : altitude;
}

double surface_min_altitude(const struct surface *surface)
{
    return surface->min_altitude_m;
}

double surface_max_altitude(const struct surface *surface)
{
    return surface->max_altitude_m;
}

// How large a layer is seen from a height above a place: angles, and pi where it is underfoot.
static double apparent_size(const struct layer_frame *f, const struct surface_eye *eye)
{
    const double away = acos(fmax(-1, fmin(1, vec3_dot(f->direction, eye->up)))) - f->reach_rad;
    if (f->reach_rad >= SHARED_PI) {
        return INFINITY;
    }
    const double distance = fmax(fmax(away, 0), eye->height_rad);
    return 2 * f->reach_rad / fmax(distance, 1e-9);
}

// How far from the eye ground as high as the highest of a layer may be seen.
static double find_reach(const struct surface *s, const struct layer_frame *f,
                         const struct surface_eye *eye)
{
    if (eye->solid_m <= 0 || f->reach_rad >= SHARED_PI) {
        return eye->reach_rad;
    }
    const struct surface_bounds b = surface_bounds_around(s, f->direction, f->reach_rad);
    const double peak_m = fmax(s->radius_m + (double)b.max, eye->solid_m);
    return fmin(eye->reach_rad, eye->horizon_rad + acos(eye->solid_m / peak_m));
}

static bool is_in_reach(const struct surface *s, const struct layer_frame *f,
                        const struct surface_eye *eye)
{
    const double away = acos(fmax(-1, fmin(1, vec3_dot(f->direction, eye->up)))) - f->reach_rad;
    return away <= eye->reach_rad && apparent_size(f, eye) > eye->least_rad &&
           away <= find_reach(s, f, eye);
}

static void drop_smallest(const struct surface *s, enum surface_kind kind,
                          const struct surface_eye *eye, struct surface_selection *selection)
{
    size_t smallest = 0;
    uint8_t *indices = selection->indices[kind];
    for (size_t i = 1; i < selection->counts[kind]; i++) {
        const double size = apparent_size(&s->layers[kind][indices[i]].frame, eye);
        if (size < apparent_size(&s->layers[kind][indices[smallest]].frame, eye)) {
            smallest = i;
        }
    }
    if (is_in_reach(s, &s->layers[kind][indices[smallest]].frame, eye)) {
        selection->left_out[kind]++;
    }
    selection->counts[kind]--;
    for (size_t i = smallest; i < selection->counts[kind]; i++) {
        indices[i] = indices[i + 1];
    }
}

struct surface_selection surface_select(const struct surface *s, const struct surface_eye *eye)
{
    struct surface_selection selection = {0};
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        const enum surface_kind kind = (enum surface_kind)k;
        const size_t seen = surface_count_seen(s, kind);
        for (size_t i = 0; i < s->counts[kind]; i++) {
            // Only of heights does a program look at fewer where fewer are in reach.
            if (kind == SURFACE_ELEVATION && !is_in_reach(s, &s->layers[kind][i].frame, eye)) {
                continue;
            }
            selection.indices[kind][selection.counts[kind]++] = (uint8_t)i;
            if (selection.counts[kind] > seen) {
                drop_smallest(s, kind, eye, &selection);
            }
        }
    }
    return selection;
}

size_t surface_count_seen(const struct surface *surface, enum surface_kind kind)
{
    static const size_t MOST[SURFACE_KIND_COUNT] = {SURFACE_SEEN_LAYERS, SURFACE_SEEN_LAYERS, 2, 2,
                                                    1};
    // The table of pages takes the place of one picture of lights.
    const size_t most = MOST[kind] - (kind == SURFACE_LIGHTS && surface->stream ? 1 : 0);
    return surface->counts[kind] < most ? surface->counts[kind] : most;
}

trl_result surface_update(struct surface *surface, const struct camera *camera, double pixel_rad)
{
    const struct stream_view view = {camera, pixel_rad};
    return surface->stream ? stream_update(surface->stream, surface, &view) : TRL_OK;
}

uint64_t surface_revision(const struct surface *surface)
{
    return surface->stream ? surface->stream->revision : 0;
}

bool surface_has_changed(const struct surface *surface, uint64_t since, struct vec3 direction,
                         double angle_rad)
{
    return surface->stream && stream_has_changed(surface->stream, since, direction, angle_rad);
}

bool surface_is_settled(const struct surface *surface)
{
    return !surface->stream || surface->stream->missing == 0;
}
