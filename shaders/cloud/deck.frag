// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The map of sky/deck.glsl: clouds along rays toward the star, and how they close over a place, as
// one sees them from below.

#include "cloud/weather.glsl"
#include "sky/deck.glsl"

in vec2 v_uv;

uniform float u_texels; // a side of the map

layout(location = 0) out vec4 out_deck;

const int STAR_PLACES = 8;
const int COLUMN_PLACES = 4;

// The place on the sphere that a texel stands for; w: its width, m.
vec4 find_crossing()
{
    vec2 at = 2.0 * v_uv - 1.0;
    float grown = min(length(at), 1.0) * u_deck_map.z;
    float far = u_deck_map.y * 0.5 * (exp(grown) - exp(-grown));
    vec2 flat_place = at / max(length(at), 1.0e-6) * far;
    float radius = u_planet.x + u_deck_map.x;
    // Without a difference of large numbers.
    float sunk = far * far / (radius + sqrt(max(radius * radius - far * far, 0.0)));
    vec3 place = deck_axes() * vec3(flat_place, u_deck_map.x - u_eye.y - sunk);
    return vec4(place,
                sqrt(far * far + u_deck_map.y * u_deck_map.y) * u_deck_map.z * 2.0 / u_texels);
}

float find_star_depth(CloudLayer layer, vec3 crossing, float width)
{
    float base = deck_way(crossing, u_deck_map.x, layer.shell.x);
    float step_m = (deck_way(crossing, u_deck_map.x, layer.shell.y) - base) / float(STAR_PLACES);
    vec3 middle = crossing + u_sun * (base + 0.5 * float(STAR_PLACES) * step_m);
    CloudBox box = cloud_whole_box(layer, cloud_level(layer, max(width, 0.5 * step_m)), 0.5);
    float cover = cloud_gathered(layer, middle, cloud_cover(layer, middle, width), box);
    float depth = 0.0;
    int i = 0;
    do {
        vec3 there = crossing + u_sun * (base + (float(i) + 0.5) * step_m);
        depth += cloud_coarse(layer, there, cover, box).x * step_m;
        i++;
    } while (i < STAR_PLACES && cover > CLOUD_LEAST_COVER);
    return depth;
}

// x: cover of the sky; y: what its clouds let through, without absorption.
vec2 find_column(CloudLayer layer, vec3 crossing, float width)
{
    float thick_m = layer.shell.y - layer.shell.x;
    vec3 up = normalize(u_eye_up * u_eye.x + crossing);
    vec3 middle = crossing + up * (layer.shell.x + 0.5 * thick_m - u_deck_map.x);
    CloudBox box = cloud_whole_box(layer, cloud_level(layer, width), 0.5);
    float cover = cloud_gathered(layer, middle, cloud_cover(layer, middle, width), box);
    float most = 0.0;
    float depth = 0.0;
    int i = 0;
    do {
        float high = (float(i) + 0.5) / float(COLUMN_PLACES) - 0.5;
        vec2 coarse = cloud_coarse(layer, middle + up * (high * thick_m), cover, box);
        // The part of the box that is cloud, from what cloud_extinction made of it.
        float part = (1.0 - exp(-coarse.x * box.way)) / max(1.0 - exp(-coarse.y * box.way), 1.0e-6);
        part = clamp(part, 0.0, 1.0);
        most = max(most, part);
        depth += coarse.y * part * thick_m / float(COLUMN_PLACES);
        i++;
    } while (i < COLUMN_PLACES && cover > CLOUD_LEAST_COVER);
    float closed = 1.0 - pow(max(1.0 - most, 1.0e-6), 1.0 / layer.grain.w);
    float inside = depth / max(closed, 1.0e-3);
    float flat_layer = 1.0 / (1.0 + CLOUD_DIFFUSE_DEPTH * inside);
    return vec2(closed, cloud_through(flat_layer, closed, layer.grain.w));
}

void main()
{
    vec4 found = find_crossing();
    vec3 crossing = found.xyz;
    float wide = max(found.w, 2.0 * u_deck_map.x);
    float depth = 0.0;
    float clear = 1.0;
    float left = 1.0;
    float heights = 0.0; // altitudes, by how much the clouds take
    float taken = 0.0;
    int index = 0;
    do {
        CloudLayer layer = cloud_layer(index);
        depth += find_star_depth(layer, crossing, found.w);
        vec2 column = find_column(layer, crossing, wide);
        float takes = column.x * (1.0 - column.y) + 1.0e-6;
        clear *= 1.0 - column.x;
        left *= 1.0 - column.x * (1.0 - column.y);
        heights += takes * 0.5 * (layer.shell.x + layer.shell.y);
        taken += takes;
        index++;
    } while (index < u_cloud_layers);
    float cover = 1.0 - clear;
    out_deck = vec4(depth, heights / taken, cover, 1.0 - (1.0 - left) / max(cover, 1.0e-6));
}
