// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How much of the sky a layer may cover over a place: its own cover, map or weather systems, and
// belt, and cyclones over them. C has the same in src/cloud/weather.c and sets the uniforms
// (cloud_march_set_field).
#ifndef CLOUD_WEATHER_GLSL
#define CLOUD_WEATHER_GLSL

#include "cloud/field.glsl"
#include "shared/cyclone.glsl"

const int CLOUD_MAX_CYCLONES = 4;

// Cover, of all layers or a channel for each; equirectangular, row 0 north, left edge 180 W.
uniform sampler2D u_cloud_map;
uniform int u_cyclones;
uniform vec4 u_cyclone_at[CLOUD_MAX_CYCLONES];   // unit, to its eye; spheres' radii over its own
uniform vec4 u_cyclone_east[CLOUD_MAX_CYCLONES]; // unit; radius of its eye over its own
uniform vec4 u_cyclone_turn[CLOUD_MAX_CYCLONES]; // unit, to where it turns from the east

// x: share of a cyclone's own cover; y: what is left of that around. `up` is unit, in the planet
// frame, `width` that of a pixel, m.
vec2 cyclone_at(int index, vec3 up, float width)
{
    vec3 from = up - u_cyclone_at[index].xyz;
    float scale = u_cyclone_at[index].w;
    float eye = u_cyclone_east[index].w;
    float x = length(from) * scale;
    float phase = cyclone_phase(
        x, atan(dot(from, u_cyclone_turn[index].xyz), dot(from, u_cyclone_east[index].xyz)));
    vec3 place = vec3(phase * (CYCLONE_NOISE_TURNS / (2.0 * SHARED_PI)),
                      log(max(x, 1.0e-4)) * CYCLONE_NOISE_TILES, 0.5);
    float texels = width / u_planet.x * scale / max(x, 1.0e-4) * u_cloud_volume.x *
                   (CYCLONE_NOISE_TURNS * CYCLONE_COTANGENT / (2.0 * SHARED_PI));
    float noise = textureLod(u_cloud_noise, place, log2(max(texels, 1.0))).x;
    return vec2(cyclone_share(x, phase, eye, noise), cyclone_rest(x, eye));
}

// `unturned` is unit.
float gather_systems(float cover, vec3 unturned, float width)
{
    vec3 tiles = u_cloud_volume.z * vec3(1.0, 1.0, CLOUD_SYSTEM_STRETCH);
    float texels = width / u_planet.x * tiles.z * u_cloud_volume.x;
    float noise = textureLod(u_cloud_noise, unturned * tiles, log2(max(texels, 1.0))).x;
    return cloud_gathered_cover(cover, noise, noise);
}

// `width` is that of a pixel there, m.
float cloud_cover(CloudLayer layer, vec3 place, float width)
{
    vec3 up = normalize(u_eye_up * u_eye.x + place);
    vec3 unturned = cloud_unturned(layer, up);
    float latitude = asin(clamp(unturned.z, -1.0, 1.0));
    vec2 at = vec2(atan(unturned.y, unturned.x) * (0.5 / SHARED_PI) + 0.5,
                   0.5 - latitude * (1.0 / SHARED_PI));
    float texel = 2.0 * SHARED_PI * u_planet.x / float(textureSize(u_cloud_map, 0).x);
    vec4 maps = textureLod(u_cloud_map, at, log2(max(width / texel, 1.0)));
    float map = dot(maps, layer.channel);
    vec4 belt = layer.belt;
    float inside = cyclone_step(belt.x - belt.z, belt.x, latitude) *
                   (1.0 - cyclone_step(belt.y, belt.y + belt.z, latitude));
    float cover = layer.shell.w * (u_cloud_volume.w > 0.5 ? map : 1.0) * inside;
    if (u_cloud_volume.z > 0.0) {
        cover = gather_systems(cover, unturned, width);
    }
    for (int i = 0; i < u_cyclones; i++) {
        vec2 cyclone = cyclone_at(i, up, width);
        cover = mix(cover * cyclone.y, belt.w, cyclone.x);
    }
    return cloud_level_cover(cover, layer.grain.w);
}

#endif // CLOUD_WEATHER_GLSL
