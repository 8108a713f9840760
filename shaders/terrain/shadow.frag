// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Altitude of the terrain's shadow, and the height of half its penumbra: marched toward the sun
// over the elevations with growing steps.
#include "shared/hemisphere.glsl"
#include "terrain/layers.glsl"

uniform vec4 u_map;   // texels to a side, power, extent of the map; the sun's angular radius
uniform vec4 u_march; // steps, highest and lowest altitude
uniform vec3 u_sun;   // local frame

out vec2 o_shadow;

vec3 map_direction(vec2 g)
{
    LocalDirection d = shadow_map_direction(g.x, g.y, u_map.y, u_map.z);
    return vec3(d.x, d.y, d.z);
}

void main()
{
    // Texel centres from border to border.
    vec2 g = 2.0 * (gl_FragCoord.xy - 0.5) / (u_map.x - 1.0) - 1.0;
    vec3 o = map_direction(g);
    vec3 up = o + vec3(0.0, 0.0, 1.0);
    float radius = u_anchor.w;
    float ring = max(max(abs(g.x), abs(g.y)), 1.0 / u_map.x);
    float cell = length(map_direction(g * (1.0 + 2.0 / (u_map.x * ring))) - o) * radius;
    float sine = clamp(dot(u_sun, up), -0.3, 0.9999);
    vec3 along = normalize(u_sun - up * dot(u_sun, up) + vec3(1e-7, 0.0, 0.0));
    float slope = sine / sqrt(1.0 - sine * sine);
    // Beyond this distance the ray is above all peaks: s slope + s^2 / 2 R = the range of heights.
    float range = max(u_march.y - u_march.z, 1.0);
    float end = radius * (sqrt(slope * slope + 2.0 * range / radius) - slope);
    float start = min(0.5 * cell, 0.5 * end);
    float growth = pow(end / start, 1.0 / u_march.x);
    float s = start;
    float highest = -1e5;
    float penumbra = 1.0;
    int steps = int(u_march.x);
    for (int i = 0; i < steps; i++) {
        float angle = s / radius;
        float sin_half = sin(0.5 * angle);
        vec3 p = o + along * sin(angle) - up * (2.0 * sin_half * sin_half);
        float h = terrain_altitude_linear(geo_from_local(p, 1.0), log2(0.5 * s * (growth - 1.0)));
        // A ray of this elevation that touches (radius + h) at `angle` has r cos(e) constant at the
        // start's end: (radius + h) cos(e + angle) / cos(e), less the radius.
        float fall = -2.0 * sin_half * sin_half - sin(angle) * slope;
        float shade = h + (radius + h) * fall;
        penumbra = shade > highest ? s * u_map.w * (1.0 + slope * slope) : penumbra;
        highest = max(highest, shade);
        s *= growth;
    }
    // What the map cannot resolve stays unsharp.
    o_shadow = vec2(highest, penumbra + 0.02 * cell);
}
