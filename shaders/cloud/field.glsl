// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Extinction of clouds at a place. Places are relative to the eye, m. C has the same in
// src/cloud/field.c; it sets the uniforms with cloud_march_set_field.
#ifndef CLOUD_FIELD_GLSL
#define CLOUD_FIELD_GLSL

#include "shared/cloud.glsl"
#include "sky/ray.glsl"

const int CLOUD_MAX_LAYERS = 4;

uniform int u_cloud_layers;
uniform vec4 u_cloud_shell[CLOUD_MAX_LAYERS]; // base, top above the sphere; widest at; cover
uniform vec4
    u_cloud_grain[CLOUD_MAX_LAYERS]; // tiles per m, extinction, weight of the finer noise, overlap
uniform vec4 u_cloud_anchor[CLOUD_MAX_LAYERS];        // the eye in tiles, without whole ones
uniform vec4 u_cloud_detail_anchor[CLOUD_MAX_LAYERS]; // the same of the finer noise
uniform vec4 u_cloud_field_anchor[CLOUD_MAX_LAYERS];  // and of the coarser
uniform vec4 u_cloud_wide_anchor[CLOUD_MAX_LAYERS];   // and of the coarsest, axes y, z, x
uniform vec4 u_cloud_turn[CLOUD_MAX_LAYERS]; // cosine and sine of how far the wind has turned it
uniform vec4 u_cloud_volume;     // texels a side, its last level, border in texels, whether
                                 // there is a map
uniform float u_cloud_spread[8]; // by level
uniform sampler3D u_cloud_noise;
uniform sampler2D u_cloud_map; // cover, equirectangular, row 0 north, left edge 180 W

// What is looked at often of a layer, since drivers look up arrays by an index slowly.
struct CloudLayer {
    vec4 shell, grain; // as the arrays
    vec3 anchor, detail_anchor, field_anchor, wide_anchor;
    vec2 turn;
};

CloudLayer cloud_layer(int index)
{
    return CloudLayer(u_cloud_shell[index], u_cloud_grain[index], u_cloud_anchor[index].xyz,
                      u_cloud_detail_anchor[index].xyz, u_cloud_field_anchor[index].xyz,
                      u_cloud_wide_anchor[index].xyz, u_cloud_turn[index].xy);
}

// A place, or a direction, as the layer had it before the wind turned it.
vec3 cloud_unturned(CloudLayer layer, vec3 place)
{
    vec2 turn = layer.turn;
    return vec3(turn.x * place.x + turn.y * place.y, turn.x * place.y - turn.y * place.x, place.z);
}

// Height above the sphere of a place, without a difference of large numbers.
float cloud_altitude(vec3 place)
{
    float ground = u_planet.x;
    float rise = u_eye.y * (2.0 * ground + u_eye.y) + 2.0 * u_eye.x * dot(u_eye_up, place) +
                 dot(place, place);
    return rise / (sqrt(max(ground * ground + rise, 0.0)) + ground);
}

// In [0, 1] within a layer.
float cloud_height(CloudLayer layer, vec3 place)
{
    return (cloud_altitude(place) - layer.shell.x) / (layer.shell.y - layer.shell.x);
}

// The part of the sky that a layer may cover at a place. `width` is that of a pixel there, m.
float cloud_cover(CloudLayer layer, vec3 place, float width)
{
    vec3 up = cloud_unturned(layer, normalize(u_eye_up * u_eye.x + place));
    vec2 at = vec2(atan(up.y, up.x) * (0.5 / SHARED_PI) + 0.5,
                   0.5 - asin(clamp(up.z, -1.0, 1.0)) * (1.0 / SHARED_PI));
    float texel = 2.0 * SHARED_PI * u_planet.x / float(textureSize(u_cloud_map, 0).x);
    float map = textureLod(u_cloud_map, at, log2(max(width / texel, 1.0))).x;
    float cover = layer.shell.w * (u_cloud_volume.w > 0.5 ? map : 1.0);
    return cloud_level_cover(cover, layer.grain.w);
}

float cloud_spread(float level)
{
    float at = clamp(level, 0.0, u_cloud_volume.y);
    int low = int(min(at, u_cloud_volume.y - 1.0));
    return mix(u_cloud_spread[low], u_cloud_spread[low + 1], at - float(low));
}

float cloud_texel(CloudLayer layer)
{
    return 1.0 / (layer.grain.x * u_cloud_volume.x);
}

// Below 0 where only the finer noise has more to show.
float cloud_level(CloudLayer layer, float width)
{
    return log2(max(width / cloud_texel(layer), 1.0 / CLOUD_DETAIL_TILES));
}

// What a box whose side is a texel of a level of the noise stands for.
struct CloudBox {
    float level, detail_level, field_level;
    float spread, detail_spread; // of the noise in it
    float way;                   // through clouds and gaps, m
};

CloudBox cloud_levels_box(CloudLayer layer, float level, float detail_level, float field_level)
{
    CloudBox box;
    box.level = level;
    box.detail_level = detail_level;
    box.field_level = max(field_level, 0.0);
    box.spread = cloud_spread(level);
    box.detail_spread = layer.grain.z * cloud_spread(detail_level);
    box.way = cloud_clump(layer.shell.y - layer.shell.x, 1.0 / layer.grain.x,
                          cloud_texel(layer) * exp2(level));
    return box;
}

CloudBox cloud_box(CloudLayer layer, float level)
{
    return cloud_levels_box(layer, level, level + log2(CLOUD_DETAIL_TILES),
                            level - log2(CLOUD_FIELD_TILES));
}

// The same with whole levels, of which a look takes half the time. They are rounded up as often as
// `rest`, in [0, 1], of near pixels is above what is missing.
CloudBox cloud_whole_box(CloudLayer layer, float level, float rest)
{
    float up = level + rest;
    return cloud_levels_box(layer, floor(up), floor(up + log2(CLOUD_DETAIL_TILES)),
                            floor(up - log2(CLOUD_FIELD_TILES)));
}

// The cover of a level there, with clouds gathered into fields.
float cloud_gathered(CloudLayer layer, vec3 place, float cover, CloudBox box)
{
    vec3 unturned = cloud_unturned(layer, place);
    vec3 at = layer.field_anchor + unturned * (layer.grain.x / CLOUD_FIELD_TILES);
    float noise = textureLod(u_cloud_noise, at, box.field_level).x;
    vec3 wide_at = layer.wide_anchor + unturned.yzx * (layer.grain.x / CLOUD_WIDE_TILES);
    float wide_level = max(box.level - floor(log2(CLOUD_WIDE_TILES)), 0.0);
    return cloud_gathered_cover(cover, noise, textureLod(u_cloud_noise, wide_at, wide_level).x);
}

// Whether there may be cloud in the border around a place, or along a ray from it that is as long
// and rises by `rise` heights of the layer. By one look.
bool cloud_may_be_near(CloudLayer layer, vec3 place, float cover, CloudBox box, float rise)
{
    // The height that has most of the cover.
    float height = cloud_height(layer, place);
    float best = clamp(layer.shell.z, min(height, height + rise), max(height, height + rise));
    float around =
        textureLod(u_cloud_noise, layer.anchor + cloud_unturned(layer, place) * layer.grain.x,
                   box.level)
            .y;
    float most = cloud_joint_noise(around, 1.0, layer.grain.z) + box.spread;
    return most > cloud_threshold(cover, cloud_height_signal(best, layer.shell.z));
}

// Extinction, per m.
float cloud_point(CloudLayer layer, vec3 place, float cover, CloudBox box)
{
    float signal = cloud_height_signal(cloud_height(layer, place), layer.shell.z);
    float noise = textureLod(u_cloud_noise,
                             layer.anchor + cloud_unturned(layer, place) * layer.grain.x, box.level)
                      .x;
    float finer = textureLod(u_cloud_noise,
                             layer.detail_anchor + cloud_unturned(layer, place) *
                                                       (layer.grain.x * CLOUD_DETAIL_TILES),
                             box.detail_level)
                      .x;
    float joint = cloud_joint_noise(noise, finer, layer.grain.z);
    float spread = cloud_joint_spread(box.spread, box.detail_spread, joint);
    float x = joint - cloud_threshold(cover, signal);
    float density = cloud_density(x, spread);
    return cloud_extinction(density, cloud_part(x, spread), layer.grain.y, box.way);
}

// The same by one look, for boxes so wide that the finer noise is the same in each. x: mean
// extinction; y: where there is cloud in the box.
vec2 cloud_coarse(CloudLayer layer, vec3 place, float cover, CloudBox box)
{
    float noise = textureLod(u_cloud_noise,
                             layer.anchor + cloud_unturned(layer, place) * layer.grain.x, box.level)
                      .x;
    float spread = cloud_joint_spread(box.spread, layer.grain.z * u_cloud_spread[7], noise);
    float x = noise - cloud_threshold(
                          cover, cloud_height_signal(cloud_height(layer, place), layer.shell.z));
    float density = cloud_density(x, spread);
    float part = cloud_part(x, spread);
    return vec2(cloud_extinction(density, part, layer.grain.y, box.way),
                layer.grain.y * density / max(part, 1.0e-4));
}

// Optical depth from a place toward the star, by six places at growing distances (Michelic 2019,
// Section 5), each of which stands for the clouds as far as to the next.
const int CLOUD_SUN_PLACES = 6;
const int CLOUD_SUN_FINE_PLACES = 2;
const float CLOUD_SUN_REACH_M = 6000.0;

// `width` is that of a pixel there.
float cloud_sun_depth(CloudLayer layer, vec3 place, float cover, float sun_mu, float height,
                      float width)
{
    float thick = layer.shell.y - layer.shell.x;
    float reach = min((1.0 - height) * thick / max(sun_mu, 0.05), CLOUD_SUN_REACH_M);
    float sum = 0.0;
    float from = 0.0;
    for (int i = 1; i <= CLOUD_SUN_FINE_PLACES; i++) {
        float part = float(i) / float(CLOUD_SUN_PLACES);
        float to = reach * part * part;
        vec3 there = place + u_sun * (0.5 * (from + to));
        CloudBox box = cloud_box(layer, cloud_level(layer, max(0.5 * (to - from), width)));
        sum += cloud_point(layer, there, cover, box) * (to - from);
        from = to;
    }
    for (int i = CLOUD_SUN_FINE_PLACES + 1; i <= CLOUD_SUN_PLACES; i++) {
        float part = float(i) / float(CLOUD_SUN_PLACES);
        float to = reach * part * part;
        vec3 there = place + u_sun * (0.5 * (from + to));
        CloudBox box = cloud_box(layer, cloud_level(layer, max(0.5 * (to - from), width)));
        sum += cloud_coarse(layer, there, cover, box).x * (to - from);
        from = to;
    }
    return sum;
}

#endif // CLOUD_FIELD_GLSL
