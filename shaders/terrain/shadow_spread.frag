// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One doubling of the shadow map's reach: a place is shaded as its own neighbourhood says, or as
// that of the place one step toward the sun does. After n passes with steps of 1, 2, 4, … every
// crest within 2^n has been looked at. The last pass leaves the place itself out.
#include "terrain/shadow_map.glsl"

uniform sampler2D u_previous; // altitude of the shadow; distance to what casts it; ground; m
uniform vec3 u_sun;           // local frame
uniform vec4 u_spread; // step, m (last pass: in cells); 1 in the last pass; sphere's radius, m

out vec4 o_shadow;

void main()
{
    vec2 g = map_grid(gl_FragCoord.xy);
    vec3 o = map_direction(g);
    vec3 up = o + vec3(0.0, 0.0, 1.0);
    float radius = u_spread.z;
    float sine = clamp(dot(u_sun, up), -0.3, 0.9999);
    vec3 along = normalize(u_sun - up * dot(u_sun, up) + vec3(1e-7, 0.0, 0.0));
    float slope = sine / sqrt(1.0 - sine * sine);
    float step_m = u_spread.y > 0.5 ? u_spread.x * map_cell(g) * radius : u_spread.x;
    float angle = step_m / radius;
    float versine = 2.0 * sin(0.5 * angle) * sin(0.5 * angle);
    vec3 p = o + along * sin(angle) - up * versine;
    LocalDirection d = LocalDirection(p.x, p.y, p.z);
    vec2 at = p.xy * shadow_map_scale(d, u_map.y, u_map.z);
    vec2 there = textureLod(u_previous, 0.5 + 0.5 * at * (1.0 - 1.0 / u_map.x), 0.0).xy;
    // r cos(elevation) is constant along a ray: one that passes there at (radius + h), passes here
    // at (radius + h) cos(e + angle) / cos(e).
    float shade = there.x - (radius + there.x) * (versine + sin(angle) * slope);
    vec4 here = texelFetch(u_previous, ivec2(gl_FragCoord.xy), 0);
    bool is_inside = max(abs(at.x), abs(at.y)) <= 1.0;
    here.x = u_spread.y > 0.5 ? -1e5 : here.x;
    o_shadow = is_inside && shade > here.x ? vec4(shade, there.y + step_m, here.zw) : here;
}
