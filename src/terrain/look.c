// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/look.h"

#include "shared/blend.glsl"
#include "shared/sea.glsl"
#include "shared/shore.glsl"

#include <math.h>

// Of a half texel, the distance of the two heights whose difference is the slope: within it the
// cubic is nearly a parabola.
static const double SLOPE_STEP = 0.25;
static const double BARE_STEP = 0.01;
// Of made-up relief.
static const double LEAST_STEP_M = 2;

struct place {
    double latitude, longitude;
};

static struct place find_place(struct vec3 direction)
{
    return (struct place){atan2(direction.z, hypot(direction.x, direction.y)),
                          atan2(direction.y, direction.x)};
}

bool surface_picture(const struct surface *surface, enum surface_kind kind, struct vec3 direction,
                     double rgb[3])
{
    const struct place at = find_place(direction);
    bool is_covered = false;
    double root[3] = {sqrt(rgb[0]), sqrt(rgb[1]), sqrt(rgb[2])};
    for (size_t i = 0; i < surface->counts[kind]; i++) {
        const struct terrain_layer *layer = &surface->layers[kind][i];
        if (layer_is_beyond(&layer->frame, at.latitude)) {
            continue;
        }
        const struct layer_place place = layer_locate(&layer->frame, at.latitude, at.longitude);
        if (!(place.weight > 0) || !(layer->roots || layer->tiles)) {
            continue;
        }
        double rgba[4];
        layer_sample_roots(layer, place.x, place.y, rgba);
        const double cover = rgba[3] * place.weight;
        for (int c = 0; c < 3; c++) {
            // Light is added, not its roots.
            const double value = layer->mode == BLEND_ADD
                                     ? hypot(root[c], rgba[c])
                                     : blend_whole(layer->mode, root[c], rgba[c]);
            root[c] += cover * (value - root[c]);
        }
        is_covered = is_covered || cover > 0;
    }
    for (int c = 0; c < 3; c++) {
        rgb[c] = root[c] * root[c];
    }
    return is_covered;
}

// What the masks say: part that is water, between texels; its depth as a code; a texel's height.
struct mask_look {
    double water, code, texel_rad;
};

static struct mask_look find_mask(const struct surface *surface, struct place at)
{
    struct mask_look look = {0};
    for (size_t i = 0; i < surface->counts[SURFACE_WATER] && surface->depth.is_told; i++) {
        const struct layer_frame *frame = &surface->layers[SURFACE_WATER][i].frame;
        const struct layer_place p = layer_locate(frame, at.latitude, at.longitude);
        if (!(p.weight > 0) || !surface->masks[i]) {
            continue;
        }
        const double part_x = p.x - floor(p.x), part_y = p.y - floor(p.y);
        double water = 0, code = 0;
        for (int k = 0; k < 4; k++) {
            const double weight = (k % 2 ? part_x : 1 - part_x) * (k / 2 ? part_y : 1 - part_y);
            const size_t index =
                layer_texel_index(frame, (int64_t)floor(p.x) + k % 2, (int64_t)floor(p.y) + k / 2);
            water += weight * surface->masks[i][index] / 255;
            code += surface->depths[i] ? weight * surface->depths[i][index] / 255 : 0;
        }
        // What two masks make together is as deep as the deeper says.
        const double mode = surface->layers[SURFACE_WATER][i].mode;
        code = mode == BLEND_OVER ? code : fmax(code, look.code);
        look.water = fmin(blend_layers(mode, look.water, water, p.weight), 1);
        look.code += p.weight * (code - look.code);
        look.texel_rad = frame->texel_height;
    }
    return look;
}

// Within so much of sea level a place of invented ground is part water, m.
static const double SHORE_M = 20;

double surface_open_water(const struct surface *surface, struct vec3 direction)
{
    double water = find_mask(surface, find_place(direction)).water;
    if (surface->is_invented && surface->noise.desc.has_sea) {
        const double altitude_m =
            noise_ground_at(&surface->noise, vec3_normalize(direction)).height_m;
        water = fmax(water, fmax(0, fmin(1, 0.5 - altitude_m / SHORE_M)));
    }
    return water;
}

double surface_mask_texel_rad(const struct surface *surface)
{
    double finest_rad = INFINITY;
    for (size_t i = 0; i < surface->counts[SURFACE_WATER] && surface->depth.is_told; i++) {
        finest_rad = fmin(finest_rad, surface->layers[SURFACE_WATER][i].frame.texel_height);
    }
    if (surface->is_invented && surface->noise.desc.has_sea) {
        finest_rad = fmin(finest_rad, SHARED_PI / surface->noise.map.height);
    }
    return isfinite(finest_rad) ? finest_rad : 0;
}

// Of the layers without octaves, linear between texels, as shaders look at it: with the sea's bed
// where they have one.
struct level {
    double altitude_m, texel_rad;
    double bed; // 1: the layer on top has it
};

static struct level find_level(const struct surface *surface, struct place at, double texel_rad)
{
    struct level level = {.texel_rad = texel_rad};
    for (size_t i = 0; i < surface->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *layer = &surface->layers[SURFACE_ELEVATION][i];
        const struct layer_place p = layer_locate(&layer->frame, at.latitude, at.longitude);
        if (p.weight > 0) {
            const double own_m = layer_sample_linear(layer, p.x, p.y);
            level.altitude_m = blend_layers(layer->mode, level.altitude_m, own_m, p.weight);
            level.bed += p.weight * ((layer->heights.has_bed ? 1 : 0) - level.bed);
            level.texel_rad = layer_finest_frame(layer)->texel_height;
        }
    }
    return level;
}

// Of that ground, over half a texel.
static double find_slope(const struct surface *surface, struct place at, double texel_rad)
{
    const double step = SLOPE_STEP * texel_rad;
    double rises[2] = {0};
    for (int k = 0; k < 2; k++) {
        const double north = k ? step : 0, east = k ? 0 : step / fmax(cos(at.latitude), 1e-3);
        const struct place ahead = {at.latitude + north, at.longitude + east};
        const struct place behind = {at.latitude - north, at.longitude - east};
        rises[k] = find_level(surface, ahead, texel_rad).altitude_m -
                   find_level(surface, behind, texel_rad).altitude_m;
    }
    return hypot(rises[0], rises[1]) / (2 * step * surface->radius_m);
}

// Mean of what is around: as the next level of detail.
static double find_around(const struct surface *surface, struct place at, double mask_rad,
                          double texel_rad)
{
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const struct place beside = {at.latitude + (k / 2 - 0.5) * mask_rad,
                                     at.longitude + (k % 2 - 0.5) * mask_rad / cos(at.latitude)};
        sum += find_level(surface, beside, texel_rad).altitude_m;
    }
    return sum / 4;
}

double surface_water(const struct surface *surface, struct vec3 direction, double *depth_code)
{
    const struct place at = find_place(direction);
    const struct mask_look mask = find_mask(surface, at);
    const double everywhere_m = surface->depth.everywhere_m;
    *depth_code = everywhere_m >= 0 ? sea_depth_code(everywhere_m) : mask.code;
    if (surface->counts[SURFACE_ELEVATION] == 0) {
        return mask.water;
    }
    const struct level level = find_level(surface, at, mask.texel_rad);
    if (!(mask.water > 0) && !(level.bed > 0)) {
        return 0;
    }
    struct noise_place place;
    const double texel_m = mask.texel_rad * surface->radius_m;
    const double shore_m = noise_is_there(&surface->noise)
                               ? surface_relief(surface, vec3_normalize(direction), &place).shore
                               : 0;
    const ShoreWater water =
        shore_water((Shore){.mask = mask.water,
                            .code = mask.code,
                            .altitude = level.altitude_m,
                            .bed = level.bed,
                            .around = find_around(surface, at, mask.texel_rad, level.texel_rad),
                            .fine = shore_fine(log2(mask.texel_rad / level.texel_rad)),
                            .slope = find_slope(surface, at, level.texel_rad),
                            .made = shore_made(shore_m / texel_m),
                            .texel = texel_m});
    *depth_code = everywhere_m >= 0 ? *depth_code : water.code;
    return water.part;
}

double surface_water_depth_m(const struct surface *surface, struct vec3 direction)
{
    double code = 0;
    if (!surface->depth.is_told || !(surface_water(surface, direction, &code) > 0.5)) {
        return 0;
    }
    return surface->depth.everywhere_m >= 0 ? surface->depth.everywhere_m : sea_code_depth(code);
}

static bool is_within(const struct layer_frame *frame, struct vec3 up, double reach_rad)
{
    return acos(fmax(-1, fmin(1, vec3_dot(up, frame->direction)))) <= reach_rad + frame->reach_rad;
}

double surface_half_texel_m(const struct surface *surface, struct vec3 direction, double reach_rad)
{
    const struct place at = find_place(direction);
    const struct vec3 up = vec3_normalize(direction);
    double finest = 2 * BARE_STEP;
    for (size_t i = 0; i < surface->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *layer = &surface->layers[SURFACE_ELEVATION][i];
        if (layer_locate(&layer->frame, at.latitude, at.longitude).weight > 0 ||
            (reach_rad > 0 && is_within(&layer->frame, up, reach_rad))) {
            finest = fmin(finest, layer_finest_frame(layer)->texel_height);
        }
    }
    finest *= surface->radius_m;
    if (noise_is_there(&surface->noise)) {
        finest = fmin(finest, fmax(noise_shortest_m(&surface->noise), LEAST_STEP_M));
    }
    return 0.5 * finest;
}

// The slope without that of soil.
static struct vec3 stand_of(const Relief *r, struct vec3 up)
{
    const struct vec3 gradient = {r->fall_x, r->fall_y, r->fall_z};
    return vec3_sub(gradient, vec3_scale(up, vec3_dot(gradient, up)));
}

// Of the relief with its octaves, by their gradients: what the GPU shades.
static struct vec3 find_made_normal(const struct surface *surface, struct vec3 up)
{
    struct noise_place place;
    const Relief r = surface_relief(surface, up, &place);
    if (surface->noise.desc.has_sea && r.height < 0) {
        return up;
    }
    const struct vec3 gradient = {r.x, r.y, r.z};
    const struct vec3 slope = vec3_sub(gradient, vec3_scale(up, vec3_dot(gradient, up)));
    const struct noise_stand stand = {r.height, vec3_length(stand_of(&r, up)),
                                      vec3_normalize(vec3_sub(up, slope))};
    return noise_rock_normal(&surface->noise, &place, &stand);
}

bool surface_biomes(const struct surface *surface, struct vec3 direction, double rgb[3])
{
    if (!surface->is_invented || surface->biomes.count == 0) {
        return false;
    }
    const struct vec3 up = vec3_normalize(direction);
    struct noise_place place;
    const Relief r = surface_relief(surface, up, &place);
    const struct biome_place at = {.altitude_m = r.height,
                                   .slope = vec3_length(stand_of(&r, up)),
                                   .latitude_rad = asin(fmax(-1, fmin(1, up.z))),
                                   .moisture = place.ground.climate,
                                   .tone = r.tone};
    biomes_colour(&surface->biomes, &at, rgb);
    return true;
}

struct vec3 surface_normal(const struct surface *surface, struct vec3 direction)
{
    const struct vec3 up = vec3_normalize(direction);
    if (noise_is_there(&surface->noise)) {
        return find_made_normal(surface, up);
    }
    const struct vec3 axis = fabs(up.z) < 0.9 ? (struct vec3){0, 0, 1} : (struct vec3){1, 0, 0};
    const struct vec3 along[2] = {vec3_normalize(vec3_cross(axis, up)),
                                  vec3_cross(up, vec3_normalize(vec3_cross(axis, up)))};
    const double step = SLOPE_STEP * surface_half_texel_m(surface, up, 0) / surface->radius_m;
    struct vec3 normal = up;
    for (int i = 0; i < 2; i++) {
        const struct vec3 aside = vec3_scale(along[i], step);
        const double rise = surface_altitude(surface, vec3_add(up, aside)) -
                            surface_altitude(surface, vec3_sub(up, aside));
        // Steeper the larger the radius is that an angle is taken on.
        const double slope =
            rise / (2 * step * (surface->radius_m + surface_altitude(surface, up)));
        normal = vec3_sub(normal, vec3_scale(along[i], slope));
    }
    return vec3_normalize(normal);
}
