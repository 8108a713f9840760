// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The light of clouds toward the eye: what falls on them, and which share of it they send on.
#ifndef CLOUD_LIGHT_GLSL
#define CLOUD_LIGHT_GLSL

#include "cloud/field.glsl"
#include "sky/deck.glsl"
#include "sky/spectral/air.glsl"

uniform vec4 u_ground_light; // as in sky/spectral/ground.frag
uniform vec2 u_light_texel;
uniform sampler2D u_sunlight;
uniform sampler2D u_skylight;
uniform sampler2D u_rising;
uniform sampler2D u_evenness;
uniform sampler2D u_slope;

// Of what lights clouds around a place, in the bands.
struct Lights {
    vec4 sun, above, below;
    vec4 slope;   // see cloud_turn
    vec4 horizon; // see cloud_horizon
};

// The layer's diffuse depth, at its cover.
float whole_depth(CloudLayer layer, float cover)
{
    return CLOUD_DIFFUSE_DEPTH * layer.grain.y * (layer.shell.y - layer.shell.x) * cover;
}

Lights lights_at(vec3 place)
{
    float altitude_m = cloud_altitude(place);
    vec3 up = normalize(u_eye_up * u_eye.x + place);
    float altitude = centre(
        clamp((altitude_m - u_ground_light.x) / (u_ground_light.y - u_ground_light.x), 0.0, 1.0),
        u_ground_light.w);
    Lights lights;
    float sun_mu = dot(up, u_sun);
    float lowest = sky_map_lowest_sun(u_planet.x, altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(sun_mu, lowest, u_ground_light.z);
    vec2 day = vec2(centre(sun_coordinate(sun_mu), u_light_texel.y), altitude);
    lights.sun = textureLod(u_sunlight, vec2(centre(sun, u_light_texel.x), altitude), 0.0);
    lights.above = exp(textureLod(u_skylight, day, 0.0)) * (1.0 / SHARED_PI);
    lights.below = exp(textureLod(u_rising, day, 0.0)) * (1.0 / SHARED_PI);
    lights.slope = lights.above * textureLod(u_slope, day, 0.0);
    vec4 even = exp(textureLod(u_evenness, day, 0.0));
    lights.horizon = 0.5 * (lights.above + lights.below) * (even - 1.0);
    return lights;
}

// What the light toward the eye is per unit of the star's irradiance and of radiance from above and
// below.
struct Shares {
    float sun, above, below;
    float turned; // of the slope
    float horizon;
};

// Of one slice of a ray, for what is lit in it.
struct Lighting {
    vec2 phases; // of light that was scattered once, and a few times
    vec3 up;
    float sun_mu, view_mu;
    float toward; // see cloud_turn
    float width;  // of a pixel, m
    float rest;   // see cloud_whole_box
};

// Optical depth toward the star beyond what cloud_sun_depth looks at: the map's.
float far_depth(CloudLayer layer, vec3 place, float sun_mu, float height)
{
    vec3 there = place + u_sun * cloud_sun_reach(layer, sun_mu, height).y;
    float altitude = cloud_altitude(there);
    vec3 crossing = there + u_sun * deck_way(there, altitude, u_deck_map.x);
    vec4 texel = textureLod(u_deck, deck_uv(crossing), 0.0);
    // Layers are densest below their middle, so tops have less over them than their height says.
    float below = deck_below(texel.y, altitude);
    return texel.x * below * sqrt(below);
}

// `at` is where the noise is for the place, which may lie beyond the line that has said so: there
// heights on it are too far off.
Shares shares_at(CloudLayer layer, vec3 place, CloudPlaces at, float cover, Lighting lighting)
{
    at.height = clamp(cloud_height(layer, place), 0.0, 1.0);
    vec2 depths =
        cloud_sun_depth(layer, place, at, cover, lighting.sun_mu, lighting.width, lighting.rest);
    float depth = depths.x;
    float far = depths.y + far_depth(layer, place, lighting.sun_mu, at.height);
    // How dense it is above and below, each by one look.
    float thick_m = layer.shell.y - layer.shell.x;
    float side_m = cloud_side(thick_m, 1.0 / layer.grain.x);
    CloudBox box = cloud_whole_box(layer, cloud_level(layer, max(side_m, lighting.width)), 0.5);
    CloudLine line = cloud_line(layer, at, place + lighting.up * side_m);
    CloudAround around;
    around.side = CLOUD_DIFFUSE_DEPTH * layer.grain.y * side_m;
    around.whole = whole_depth(layer, cover);
    around.cover = cover;
    around.above = cloud_coarse_density(layer, cloud_on_line(line, 1.0), cover, box);
    around.below = cloud_coarse_density(layer, cloud_on_line(line, -1.0), cover, box);
    Shares shares;
    shares.sun = lighting.phases.x * exp(-depth - far) +
                 cloud_several(around, lighting.phases.y, lighting.sun_mu, depth, far);
    shares.above = cloud_from_above(around, at.height, lighting.view_mu);
    shares.below = 1.0 - shares.above;
    shares.horizon = cloud_horizon(lighting.view_mu, around.whole, depth);
    shares.turned = cloud_turn(lighting.toward, around.whole, depth);
    return shares;
}

#endif // CLOUD_LIGHT_GLSL
