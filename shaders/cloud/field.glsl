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
uniform vec4 u_cloud_volume;     // texels a side, its last level, border in texels, whether
                                 // there is a map
uniform float u_cloud_spread[8]; // by level
uniform sampler3D u_cloud_noise;
uniform sampler2D u_cloud_map; // cover, equirectangular, row 0 north, left edge 180 W

// Height above the sphere of a place, without a difference of large numbers.
float cloud_altitude(vec3 place)
{
    float ground = u_planet.x;
    float rise = u_eye.y * (2.0 * ground + u_eye.y) + 2.0 * u_eye.x * dot(u_eye_up, place) +
                 dot(place, place);
    return rise / (sqrt(max(ground * ground + rise, 0.0)) + ground);
}

// In [0, 1] within a layer.
float cloud_height(int layer, vec3 place)
{
    vec4 shell = u_cloud_shell[layer];
    return (cloud_altitude(place) - shell.x) / (shell.y - shell.x);
}

// The part of the sky that a layer may cover at a place. `width` is that of a pixel there, m.
float cloud_cover(int layer, vec3 place, float width)
{
    vec3 up = normalize(u_eye_up * u_eye.x + place);
    vec2 at = vec2(atan(up.y, up.x) * (0.5 / SHARED_PI) + 0.5,
                   0.5 - asin(clamp(up.z, -1.0, 1.0)) * (1.0 / SHARED_PI));
    float texel = 2.0 * SHARED_PI * u_planet.x / float(textureSize(u_cloud_map, 0).x);
    float map = textureLod(u_cloud_map, at, log2(max(width / texel, 1.0))).x;
    float cover = u_cloud_shell[layer].w * (u_cloud_volume.w > 0.5 ? map : 1.0);
    return cloud_level_cover(cover, u_cloud_grain[layer].w);
}

float cloud_spread(float level)
{
    float at = clamp(level, 0.0, u_cloud_volume.y);
    int low = int(min(at, u_cloud_volume.y - 1.0));
    return mix(u_cloud_spread[low], u_cloud_spread[low + 1], at - float(low));
}

float cloud_texel(int layer)
{
    return 1.0 / (u_cloud_grain[layer].x * u_cloud_volume.x);
}

float cloud_level(int layer, float width)
{
    return log2(max(width / cloud_texel(layer), 1.0));
}

// The cover of a level there, with clouds gathered into fields. `level` is of the noise.
float cloud_gathered(int layer, vec3 place, float cover, float level)
{
    vec3 at =
        u_cloud_field_anchor[layer].xyz + place * (u_cloud_grain[layer].x / CLOUD_FIELD_TILES);
    float noise = textureLod(u_cloud_noise, at, max(level - log2(CLOUD_FIELD_TILES), 0.0)).x;
    return cloud_gathered_cover(cover, noise);
}

// Through clouds and gaps of a box.
float cloud_way(int layer, float level)
{
    return cloud_clump(u_cloud_shell[layer].y - u_cloud_shell[layer].x,
                       1.0 / u_cloud_grain[layer].x, cloud_texel(layer) * exp2(level));
}

// Whether there may be cloud in the border around a place, or along a ray from it that is as long
// and rises by `rise` heights of the layer. By one look.
bool cloud_may_be_near(int layer, vec3 place, float cover, float level, float rise)
{
    vec4 shell = u_cloud_shell[layer];
    vec4 grain = u_cloud_grain[layer];
    // The height that has most of the cover.
    float height = cloud_height(layer, place);
    float best = clamp(shell.z, min(height, height + rise), max(height, height + rise));
    float around = textureLod(u_cloud_noise, u_cloud_anchor[layer].xyz + place * grain.x, level).y;
    float most = cloud_joint_noise(around, 1.0, grain.z) + cloud_spread(level);
    return most > cloud_threshold(cover, cloud_height_signal(best, shell.z));
}

// Extinction, per m.
float cloud_point(int layer, vec3 place, float cover, float level)
{
    vec4 shell = u_cloud_shell[layer];
    vec4 grain = u_cloud_grain[layer];
    float signal = cloud_height_signal(cloud_height(layer, place), shell.z);
    float detail_level = level + log2(CLOUD_DETAIL_TILES);
    float noise = textureLod(u_cloud_noise, u_cloud_anchor[layer].xyz + place * grain.x, level).x;
    float finer =
        textureLod(u_cloud_noise,
                   u_cloud_detail_anchor[layer].xyz + place * (grain.x * CLOUD_DETAIL_TILES),
                   detail_level)
            .x;
    float joint = cloud_joint_noise(noise, finer, grain.z);
    float spread =
        cloud_joint_spread(cloud_spread(level), grain.z * cloud_spread(detail_level), joint);
    float x = joint - cloud_threshold(cover, signal);
    float density = cloud_density(x, spread);
    return cloud_extinction(density, cloud_part(x, spread), grain.y, cloud_way(layer, level));
}

// The same by one look, for boxes so wide that the finer noise is the same in each. x: mean
// extinction; y: where there is cloud in the box.
vec2 cloud_coarse(int layer, vec3 place, float cover, float level)
{
    vec4 shell = u_cloud_shell[layer];
    vec4 grain = u_cloud_grain[layer];
    float noise = textureLod(u_cloud_noise, u_cloud_anchor[layer].xyz + place * grain.x, level).x;
    float spread =
        cloud_joint_spread(cloud_spread(level), grain.z * cloud_spread(u_cloud_volume.y), noise);
    float x =
        noise - cloud_threshold(cover, cloud_height_signal(cloud_height(layer, place), shell.z));
    float density = cloud_density(x, spread);
    float part = cloud_part(x, spread);
    return vec2(cloud_extinction(density, part, grain.y, cloud_way(layer, level)),
                grain.y * density / max(part, 1.0e-4));
}

// Optical depth from a place toward the star, by six places at growing distances (Michelic 2019,
// Section 5), each of which stands for the clouds as far as to the next.
const int CLOUD_SUN_PLACES = 6;
const int CLOUD_SUN_FINE_PLACES = 2;
const float CLOUD_SUN_REACH_M = 6000.0;

// `width` is that of a pixel there.
float cloud_sun_depth(int layer, vec3 place, float cover, float sun_mu, float height, float width)
{
    float thick = u_cloud_shell[layer].y - u_cloud_shell[layer].x;
    float reach = min((1.0 - height) * thick / max(sun_mu, 0.05), CLOUD_SUN_REACH_M);
    float sum = 0.0;
    float from = 0.0;
    for (int i = 1; i <= CLOUD_SUN_FINE_PLACES; i++) {
        float part = float(i) / float(CLOUD_SUN_PLACES);
        float to = reach * part * part;
        vec3 there = place + u_sun * (0.5 * (from + to));
        float level = cloud_level(layer, max(0.5 * (to - from), width));
        sum += cloud_point(layer, there, cover, level) * (to - from);
        from = to;
    }
    for (int i = CLOUD_SUN_FINE_PLACES + 1; i <= CLOUD_SUN_PLACES; i++) {
        float part = float(i) / float(CLOUD_SUN_PLACES);
        float to = reach * part * part;
        vec3 there = place + u_sun * (0.5 * (from + to));
        float level = cloud_level(layer, max(0.5 * (to - from), width));
        sum += cloud_coarse(layer, there, cover, level).x * (to - from);
        from = to;
    }
    return sum;
}

#endif // CLOUD_FIELD_GLSL
