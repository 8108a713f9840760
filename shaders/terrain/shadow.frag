// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Altitude of the terrain's shadow, and the height of half its penumbra: marched toward the sun
// over the elevations with growing steps.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
#include "shared/hemisphere.glsl"
#include "terrain/layers.glsl"

uniform vec4 u_map;   // texels to a side, power, extent of the map; the sun's angular radius
uniform vec4 u_march; // steps, highest and lowest altitude, halvings of the last step
uniform vec3 u_sun;   // local frame

out vec2 o_shadow;

vec3 map_direction(vec2 g)
{
    LocalDirection d = shadow_map_direction(g.x, g.y, u_map.y, u_map.z);
    return vec3(d.x, d.y, d.z);
}

struct March {
    vec3 from, up, along; // local frame; `from` less the anchor's direction
    float slope;          // tangent of the sun's elevation
};

// Altitude above `from` of the ray to the sun that touches the ground at a distance s along the
// sphere. r cos(elevation + angle) is constant along a ray, so it is
// (radius + h) cos(e + angle) / cos(e) - radius.
float touch_altitude(March m, float s, float log2_footprint)
{
    float angle = s / u_anchor.w;
    float versine = 2.0 * sin(0.5 * angle) * sin(0.5 * angle);
    vec3 p = m.from + m.along * sin(angle) - m.up * versine;
    float h = terrain_altitude_linear(geo_from_local(p, 1.0), log2_footprint);
    return h - (u_anchor.w + h) * (versine + sin(angle) * m.slope);
}

void main()
{
    // Texel centres from border to border.
    vec2 g = 2.0 * (gl_FragCoord.xy - 0.5) / (u_map.x - 1.0) - 1.0;
    March m;
    m.from = map_direction(g);
    m.up = m.from + vec3(0.0, 0.0, 1.0);
    float radius = u_anchor.w;
    float ring = max(max(abs(g.x), abs(g.y)), 1.0 / u_map.x);
    float cell = length(map_direction(g * (1.0 + 2.0 / (u_map.x * ring))) - m.from) * radius;
    float sine = clamp(dot(u_sun, m.up), -0.3, 0.9999);
    m.along = normalize(u_sun - m.up * dot(u_sun, m.up) + vec3(1e-7, 0.0, 0.0));
    m.slope = sine / sqrt(1.0 - sine * sine);
    // Beyond this distance the ray is above all peaks: s slope + s^2 / 2 R = the range of heights.
    float range = max(u_march.y - u_march.z, 1.0);
    float end = radius * (sqrt(m.slope * m.slope + 2.0 * range / radius) - m.slope);
    float start = min(0.5 * cell, 0.5 * end);
    float growth = pow(end / start, 1.0 / u_march.x);
    float s = start;
    float best = start;
    float highest = -1e5;
    int steps = int(u_march.x);
    for (int i = 0; i < steps; i++) {
        float shade = touch_altitude(m, s, log2(0.5 * s * (growth - 1.0)));
        best = shade > highest ? s : best;
        highest = max(highest, shade);
        s *= growth;
    }
    // The crest lies within a step of the best one: halve the bracket.
    float around = 0.5 * best * (growth - 1.0);
    int halvings = int(u_march.w);
    for (int i = 0; i < halvings; i++) {
        float log2_footprint = log2(around);
        float nearer = touch_altitude(m, best - around, log2_footprint);
        float farther = touch_altitude(m, best + around, log2_footprint);
        best += max(nearer, farther) > highest ? (nearer > farther ? -around : around) : 0.0;
        highest = max(highest, max(nearer, farther));
        around *= 0.5;
    }
    // The sun's disc crosses the crest over its radius; what the map cannot resolve stays unsharp.
    float penumbra = best * u_map.w * (1.0 + m.slope * m.slope);
    o_shadow = vec2(highest, penumbra + 0.01 * cell);
}
