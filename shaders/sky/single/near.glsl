// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The air before terrain: two look-ups, or where they nearly cancel, three samples of the integral.
#ifndef SKY_SINGLE_NEAR_GLSL
#define SKY_SINGLE_NEAR_GLSL

#include "sky/single/air.glsl"
#include "sky/single/colour.glsl"

uniform sampler2D u_light;        // direct light of the star: suns x heights
uniform sampler2D u_medium;       // altitudes x rows: extinction, scattering of each channel, per m
uniform vec4 u_light_texels;      // suns, heights; altitudes and rows of the medium
uniform vec4 u_added_from_rgb[3]; // columns
uniform float u_light_soft;       // of sky_map_sunlight

// Gauss-Legendre on [0, 1], three points: nodes, weights, and the weights up to each node.
const vec3 NODES = vec3(0.112701665, 0.5, 0.887298335);
const vec3 WEIGHTS = vec3(0.277777778, 0.444444444, 0.277777778);
const vec3 UP_TO_0 = vec3(0.138888889, -0.035976668, 0.009789444);
const vec3 UP_TO_1 = vec3(0.300263195, 0.222222222, -0.022485417);
const vec3 UP_TO_2 = vec3(0.267988333, 0.480421112, 0.138888889);

// The air's part in the picture.
struct Air {
    vec3 scattered;     // linear sRGB
    vec4 transmittance; // in the bands
};

// Below the first of these parts of the way's whole optical depth samples are taken, above the
// second look-ups, between them both.
const vec2 CROSSING = vec2(0.15, 0.4);

// Direct light of the star at a point, averaged over its disc.
vec4 star_light(Point p)
{
    float lowest = sky_map_lowest_sun(u_planet.x, p.altitude_m, u_disc.x, u_disc.y);
    float sun = sky_map_sunlight(p.sun_mu, lowest, u_light_soft);
    float height = single_height(single_horizon(p.altitude_m, u_planet.x), u_planet.z);
    return textureLod(u_light,
                      vec2(centre(sun, u_light_texels.x), centre(height, u_light_texels.y)), 0.0);
}

vec4 medium_at(float altitude_m, int row)
{
    float height = single_height(single_horizon(altitude_m, u_planet.x), u_planet.z);
    return textureLod(u_medium,
                      vec2(centre(height, u_light_texels.z), (float(row) + 0.5) / u_light_texels.w),
                      0.0);
}

vec4 scattering_at(float altitude_m, vec4 phase)
{
    vec4 sum = vec4(0.0);
    for (int c = 0; c < CHANNEL_COUNT; c++) {
        sum += medium_at(altitude_m, 1 + c) * phase[c];
    }
    return sum;
}

// The point `distance_m` after another, by the law of cosines without cancellation.
Point advance(Ray ray, Point from, float distance_m)
{
    float radius = u_planet.x + from.altitude_m;
    float rise = distance_m * (2.0 * from.place_m + distance_m);
    float there = sqrt(max(radius * radius + rise, 1.0));
    Point p;
    p.altitude_m = clamp(from.altitude_m + rise / (there + radius), 0.0, u_planet.y);
    p.place_m = from.place_m + distance_m;
    p.sun_mu = clamp((radius * from.sun_mu + distance_m * ray.nu) / there, -1.0, 1.0);
    return p;
}

Air sample_air(Ray ray, Point from, float way_m, vec4 phase)
{
    vec4 extinction[3];
    vec4 source[3];
    for (int k = 0; k < 3; k++) {
        Point p = advance(ray, from, way_m * NODES[k]);
        extinction[k] = medium_at(p.altitude_m, 0) * way_m;
        source[k] = star_light(p) * scattering_at(p.altitude_m, phase) * (way_m * WEIGHTS[k]);
    }
    vec4 light = source[0] * exp(-extinction[0] * UP_TO_0.x - extinction[1] * UP_TO_0.y -
                                 extinction[2] * UP_TO_0.z) +
                 source[1] * exp(-extinction[0] * UP_TO_1.x - extinction[1] * UP_TO_1.y -
                                 extinction[2] * UP_TO_1.z) +
                 source[2] * exp(-extinction[0] * UP_TO_2.x - extinction[1] * UP_TO_2.y -
                                 extinction[2] * UP_TO_2.z);
    Air air;
    air.scattered = added_colour(light);
    air.transmittance =
        exp(-extinction[0] * WEIGHTS.x - extinction[1] * WEIGHTS.y - extinction[2] * WEIGHTS.z);
    return air;
}

// Between where the ray enters the air and the ground, which is `altitude_m` high and `distance_m`
// from the eye: S(P_v) - T(P_v, P_g) S(P_g), Eq. 8 with its erratum. Nothing is beyond the bare
// sphere, and means over the way are exact for short ones.
Air air_before(Ray ray, float distance_m, float altitude_m)
{
    vec4 phase = phase_of(ray.nu);
    Point eye = begin_of(ray);
    float way_m = max(distance_m - ray.begin_m, 0.0);
    Point ground = advance(ray, eye, way_m);
    ground.altitude_m = clamp(altitude_m, 0.0, u_planet.y);
    vec4 whole;
    vec4 depth = depth_between(ray, eye, ground, whole);
    vec4 part = depth / max(whole, vec4(1.0e-9));
    float looked_up =
        smoothstep(CROSSING.x, CROSSING.y, max(max(part.x, part.y), max(part.z, part.w)));
    Air sampled = sample_air(ray, eye, way_m, phase);
    Air air;
    air.transmittance = mix(sampled.transmittance, exp(-depth), looked_up);
    air.scattered = scattered_beyond(ray, eye, phase);
#ifdef SURFACE
    // S_g is a colour: its likeliest bands are attenuated, and what they lose is taken away.
    vec3 beyond = scattered_beyond(ray, ground, phase);
    vec4 bands = u_added_from_rgb[0] * beyond.r + u_added_from_rgb[1] * beyond.g +
                 u_added_from_rgb[2] * beyond.b;
    air.scattered += added_colour((1.0 - exp(-depth)) * bands) - beyond;
    air.scattered = mix(sampled.scattered, air.scattered, looked_up);
#endif
    return air;
}

#endif // SKY_SINGLE_NEAR_GLSL
