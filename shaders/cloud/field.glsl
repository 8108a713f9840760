// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Extinction of clouds at a place. Places are relative to the eye, m. C has the same in
// src/cloud/field.c; it sets the uniforms with cloud_march_set_field.
#ifndef CLOUD_FIELD_GLSL
#define CLOUD_FIELD_GLSL

#include "cloud/parts.glsl"
#include "shared/cloud.glsl"
#include "sky/ray.glsl"

const float CLOUD_LEAST_COVER = 1.0e-4; // with less there is no cloud

uniform vec4
    u_cloud_grain[CLOUD_MAX_LAYERS]; // tiles per m, extinction, weight of the finer noise, overlap
uniform vec4 u_cloud_anchor[CLOUD_MAX_LAYERS];        // the eye in tiles, without whole ones
uniform vec4 u_cloud_detail_anchor[CLOUD_MAX_LAYERS]; // the same of the finer noise
uniform vec4 u_cloud_field_anchor[CLOUD_MAX_LAYERS];  // and of the coarser
uniform vec4 u_cloud_wide_anchor[CLOUD_MAX_LAYERS];   // and of the coarsest, axes y, z, x
uniform vec4 u_cloud_bend[CLOUD_MAX_LAYERS];          // phase of what bends the noise, at the eye
uniform vec4 u_cloud_field_bend[CLOUD_MAX_LAYERS];    // the same of the coarser
uniform vec4 u_cloud_eye[CLOUD_MAX_LAYERS];           // the eye as the layer had it, m
uniform vec4 u_cloud_turn[CLOUD_MAX_LAYERS]; // cosine and sine of how far the wind has turned it
uniform vec4
    u_cloud_form[CLOUD_MAX_LAYERS]; // tiles of fibres per rad about the axis, 0: none; shear, m;
                                    // width of the edge in noise; border, m
uniform vec4 u_cloud_belt[CLOUD_MAX_LAYERS]; // south, north, feather, rad; cover in cyclones
uniform vec4 u_cloud_volume;     // texels a side, last level, tiles of systems a radius, maps
uniform float u_cloud_spread[8]; // by level
uniform sampler3D u_cloud_noise;

// What is looked at often of a layer, since drivers look up arrays by an index slowly.
struct CloudLayer {
    vec4 shell, grain, form, belt; // as the arrays
    vec3 anchor, detail_anchor, field_anchor, wide_anchor;
    vec3 bend, field_bend, eye;
    vec2 turn;
    vec4 channel; // of the map
};

CloudLayer cloud_layer(int index)
{
    int map = u_cloud_volume.w > 1.5 ? index : 0;
    return CloudLayer(u_cloud_shell[index], u_cloud_grain[index], u_cloud_form[index],
                      u_cloud_belt[index], u_cloud_anchor[index].xyz,
                      u_cloud_detail_anchor[index].xyz, u_cloud_field_anchor[index].xyz,
                      u_cloud_wide_anchor[index].xyz, u_cloud_bend[index].xyz,
                      u_cloud_field_bend[index].xyz, u_cloud_eye[index].xyz, u_cloud_turn[index].xy,
                      vec4(equal(ivec4(0, 1, 2, 3), ivec4(map))));
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

// `place` is unturned, relative to the eye; `scale` in tiles per m. As cloud_field_bent.
vec3 cloud_bent(vec3 place, vec3 phase, float scale)
{
    float wave = scale * (2.0 * SHARED_PI / CLOUD_BEND_WAVE);
    vec3 turned =
        vec3(0.8 * place.y + 0.6 * place.z, 0.6 * place.x - 0.48 * place.y + 0.64 * place.z,
             0.8 * place.x + 0.36 * place.y - 0.48 * place.z);
    return place + sin(phase + turned * wave) * (CLOUD_BEND / scale);
}

// Where the noise and the finer one are looked at for a place, in tiles, and its height. As
// cloud_field_place.
struct CloudPlaces {
    vec3 noise, finer;
    float height;
};

CloudPlaces cloud_places(CloudLayer layer, vec3 place)
{
    float height = cloud_height(layer, place);
    vec3 unturned = cloud_unturned(layer, place);
    if (layer.form.y != 0.0) {
        vec2 flat_place = layer.eye.xy + unturned.xy;
        vec2 east = vec2(-flat_place.y, flat_place.x) / max(length(flat_place), 1.0e-3);
        unturned.xy += east * cloud_lag(height, layer.form.y);
    }
    vec3 bent = cloud_bent(unturned, layer.bend, layer.grain.x);
    float finer = layer.grain.x * CLOUD_DETAIL_TILES;
    CloudPlaces places;
    places.height = height;
    places.noise = layer.anchor + bent * layer.grain.x;
    places.finer = layer.detail_anchor + bent * finer;
    if (layer.form.x > 0.0) {
        vec3 there = layer.eye + bent;
        float across = length(there.xy);
        float along = cloud_longitude(there.y, there.x) * layer.form.x;
        places.noise = vec3(across * layer.grain.x, there.z * layer.grain.x, along);
        places.finer = vec3(across * finer, there.z * finer, along * CLOUD_FIBRE_DETAIL_TURNS);
    }
    return places;
}

// The same along a straight line. Bends are so long that in a tile noise moves by a thirtieth of
// one from between those of both ends, and in a third of one by a third of a texel. Heights of
// the line are too high by up to the square of the length over 8 radii of the planet.
struct CloudLine {
    CloudPlaces first, way;
};

CloudLine cloud_line(CloudLayer layer, CloudPlaces first, vec3 end)
{
    CloudPlaces last = cloud_places(layer, end);
    CloudLine line;
    line.first = first;
    line.way.noise = last.noise - first.noise;
    line.way.finer = last.finer - first.finer;
    line.way.height = last.height - first.height;
    // Fibres go once around; whole tiles do not count.
    float around = 2.0 * SHARED_PI * layer.form.x;
    float turned = floor(line.way.noise.z / max(around, 1.0e-3) + 0.5) * around;
    line.way.noise.z -= turned;
    line.way.finer.z -= turned * CLOUD_FIBRE_DETAIL_TURNS;
    return line;
}

// `part` of the way from its first place.
CloudPlaces cloud_on_line(CloudLine line, float part)
{
    CloudPlaces places;
    places.noise = line.first.noise + line.way.noise * part;
    places.finer = line.first.finer + line.way.finer * part;
    places.height = line.first.height + line.way.height * part;
    return places;
}

float cloud_spread(float level)
{
    float at = clamp(level, 0.0, u_cloud_volume.y);
    vec4 low = max(1.0 - abs(at - vec4(0.0, 1.0, 2.0, 3.0)), 0.0);
    vec4 high = max(1.0 - abs(at - vec4(4.0, 5.0, 6.0, 7.0)), 0.0);
    return dot(low,
               vec4(u_cloud_spread[0], u_cloud_spread[1], u_cloud_spread[2], u_cloud_spread[3])) +
           dot(high,
               vec4(u_cloud_spread[4], u_cloud_spread[5], u_cloud_spread[6], u_cloud_spread[7]));
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
    float spread, detail_spread; // of the noises in it
    float way;                   // through clouds and gaps, m
};

CloudBox cloud_levels_box(CloudLayer layer, float level, float detail_level, float field_level)
{
    CloudBox box;
    box.level = level;
    box.detail_level = detail_level;
    box.field_level = max(field_level, 0.0);
    box.spread = cloud_spread(level);
    box.detail_spread = cloud_spread(detail_level);
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
    float scale = layer.grain.x / CLOUD_FIELD_TILES;
    vec3 at = layer.field_anchor + cloud_bent(unturned, layer.field_bend, scale) * scale;
    float noise = textureLod(u_cloud_noise, at, box.field_level).x;
    // A map knows the regions.
    float wide = 0.5;
    if (u_cloud_volume.w <= 0.5) {
        vec3 wide_at = layer.wide_anchor + unturned.yzx * (layer.grain.x / CLOUD_WIDE_TILES);
        float wide_level = max(box.level - floor(log2(CLOUD_WIDE_TILES)), 0.0);
        wide = textureLod(u_cloud_noise, wide_at, wide_level).x;
    }
    return cloud_gathered_cover(cover, noise, wide);
}

// The noise at a place, with the finer.
CloudNoise cloud_finer_noise(CloudLayer layer, CloudPlaces at, float noise, CloudBox box)
{
    float finer = textureLod(u_cloud_noise, at.finer, box.detail_level).x;
    return cloud_joint_noise(CloudNoise(noise, box.spread), CloudNoise(finer, box.detail_spread),
                             layer.grain.z);
}

// The same by one look, for boxes so wide that the finer noise is the same in each.
CloudNoise cloud_coarse_noise(CloudLayer layer, CloudPlaces at, CloudBox box)
{
    float noise = textureLod(u_cloud_noise, at.noise, box.level).x;
    return cloud_joint_noise(CloudNoise(noise, box.spread), CloudNoise(0.5, 0.5), layer.grain.z);
}

// What a place tells of itself and of what is around.
struct CloudLook {
    float extinction; // per m
    float missing; // how much noise lacks to be cloud, whatever the finer one is; below 0: nothing
    bool is_near;  // there may be cloud in the border around, or ahead on a ray
};

// `most` is the largest cover around; along the ray a border's length rises by `rise` heights of
// the layer.
CloudLook cloud_look(CloudLayer layer, CloudPlaces at, float cover, float most, float rise,
                     CloudBox box)
{
    float height = at.height;
    vec2 coarse = textureLod(u_cloud_noise, at.noise, box.level).xy;
    float threshold = cloud_threshold(cover, cloud_height_signal(height, layer.shell.z));
    CloudLook look;
    CloudNoise noise = cloud_finer_noise(layer, at, coarse.x, box);
    float x = noise.value - threshold;
    float density = cloud_density(x, noise.spread, layer.form.z);
    look.extinction =
        cloud_extinction(density, cloud_part(x, noise.spread), layer.grain.y, box.way);
    look.missing = threshold - cloud_most_noise(coarse.x, layer.grain.z) - box.spread;
    // The height that has most of the cover.
    float best = clamp(layer.shell.z, min(height, height + rise), max(height, height + rise));
    look.is_near = cloud_most_noise(coarse.y, layer.grain.z) + box.spread >
                   cloud_threshold(most, cloud_height_signal(best, layer.shell.z));
    return look;
}

// By one look. x: mean extinction; y: where there is cloud in the box.
vec2 cloud_coarse(CloudLayer layer, vec3 place, float cover, CloudBox box)
{
    CloudPlaces at = cloud_places(layer, place);
    CloudNoise noise = cloud_coarse_noise(layer, at, box);
    float x = noise.value - cloud_threshold(cover, cloud_height_signal(at.height, layer.shell.z));
    float density = cloud_density(x, noise.spread, layer.form.z);
    float part = cloud_part(x, noise.spread);
    return vec2(cloud_extinction(density, part, layer.grain.y, box.way),
                layer.grain.y * density / max(part, 1.0e-4));
}

// The mean density in a box, by one look.
float cloud_coarse_density(CloudLayer layer, CloudPlaces at, float cover, CloudBox box)
{
    CloudNoise noise = cloud_coarse_noise(layer, at, box);
    float x = noise.value - cloud_threshold(cover, cloud_height_signal(at.height, layer.shell.z));
    return cloud_density(x, noise.spread, layer.form.z);
}

// Extinction on a way that begins in cloud where noise above `first` is cloud, as that above `here`
// is here: as far as that cloud may reach, of which `kept` is left, there are no gaps, which a wide
// box has, but where the cloud ends above.
float cloud_from_inside(CloudLayer layer, CloudNoise noise, float here, float first, float kept,
                        CloudBox box)
{
    float x = noise.value - here;
    float density = cloud_density(x, noise.spread, layer.form.z);
    float part = cloud_part(x, noise.spread);
    float of_it = min(part / max(cloud_part(noise.value - first, noise.spread), 1.0e-4), 1.0);
    float met = mix(part, of_it, kept);
    return cloud_extinction(density / max(part, 1.0e-4) * met, met, layer.grain.y, box.way);
}

// Optical depth from a place toward the star, by six places at growing distances (Michelic 2019,
// Section 5), each of which stands for the clouds as far as to the next; and, where the layer goes
// on, as under low stars, by as many at equal ones.
const int CLOUD_SUN_PLACES = 6;
const int CLOUD_SUN_FINE_PLACES = 3;
const float CLOUD_SUN_REACH = 0.3125;  // at most, in tiles
const float CLOUD_SUN_FARTHER = 0.375; // from there
const float CLOUD_SUN_BOX = 0.25;      // side of what is looked at, of the way it stands for
const float CLOUD_SUN_LOWER = 0.15; // with what whole levels let as much through as those between
const float CLOUD_SUN_LEAST_STEP = 1.0; // m, of the farther places

// How far toward the star there are looks, m: those of the growing distances, and all.
vec2 cloud_sun_reach(CloudLayer layer, float sun_mu, float height)
{
    float thick = layer.shell.y - layer.shell.x;
    float whole = (1.0 - height) * thick / max(sun_mu, 0.02);
    float near = min(whole, CLOUD_SUN_REACH / layer.grain.x);
    return vec2(near, min(whole, near + CLOUD_SUN_FARTHER / layer.grain.x));
}

// x: of the growing distances; y: beyond. `at` is where the noise is for the place, `width` that of
// a pixel there, `rest` as in cloud_whole_box.
vec2 cloud_sun_depth(CloudLayer layer, vec3 place, CloudPlaces at, float cover, float sun_mu,
                     float width, float rest)
{
    vec2 reach = cloud_sun_reach(layer, sun_mu, at.height);
    float farther = (reach.y - reach.x) / float(CLOUD_SUN_PLACES);
    int places = farther > CLOUD_SUN_LEAST_STEP ? 2 * CLOUD_SUN_PLACES : CLOUD_SUN_PLACES;
    CloudLine line = cloud_line(layer, at, place + u_sun * reach.y);
    float first = cloud_threshold(cover, cloud_height_signal(at.height, layer.shell.z));
    vec2 sum = vec2(0.0);
    float from = 0.0;
    int i = 1;
    do {
        bool is_near = i <= CLOUD_SUN_PLACES;
        float part = float(i) / float(CLOUD_SUN_PLACES);
        float to = is_near ? reach.x * part * part : from + farther;
        float middle = 0.5 * (from + to);
        float level = cloud_level(layer, max(CLOUD_SUN_BOX * (to - from), width));
        CloudBox box = cloud_whole_box(layer, level, rest - CLOUD_SUN_LOWER);
        CloudPlaces there = cloud_on_line(line, middle / max(reach.y, 1.0e-3));
        CloudNoise noise = cloud_coarse_noise(layer, there, box);
        if (i <= CLOUD_SUN_FINE_PLACES) {
            noise = cloud_finer_noise(layer, there, noise.value, box);
        }
        float kept = exp(-middle / box.way);
        float here = cloud_threshold(cover, cloud_height_signal(there.height, layer.shell.z));
        float depth = cloud_from_inside(layer, noise, here, first, kept, box) * (to - from);
        sum += is_near ? vec2(depth, 0.0) : vec2(0.0, depth);
        from = to;
        i++;
    } while (i <= places);
    return sum;
}

#endif // CLOUD_FIELD_GLSL
