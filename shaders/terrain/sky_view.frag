// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Of each pixel's ground, added to what is 0 so far: how the star lights the ground that it sees
// around it, as a root, and its sky view factor.
#include "shared/hemisphere.glsl"
#include "shared/sky_view.glsl"

uniform highp sampler2D u_position;
uniform sampler2D u_normal;
uniform sampler2D u_albedo;
uniform sampler2D u_horizon0; // sky_view_horizon.frag
uniform sampler2D u_horizon1;
uniform sampler2D u_light0; // sky_view_light.frag
uniform sampler2D u_light1;
uniform vec4 u_view; // scale of grid to texture coordinates, power, extent, sphere's radius
uniform mat3 u_view_from_planet;
uniform float u_light_scale; // as u_view.x, of u_light0
uniform vec3 u_view_offset;  // camera - the map's anchor on the sphere, local frame, m

layout(location = 0) out vec4 o_light;
layout(location = 1) out vec4 o_view;

vec4 pow2(vec4 x)
{
    return x * x;
}

// Two azimuths opposite to one another.
float view_of_two(float rise, float lean, float ahead, float behind)
{
    return sky_view_azimuth(rise, lean, ahead) + sky_view_azimuth(rise, -lean, behind);
}

// What is seen of ground in an azimuth, nearly: between the surface's own plane and the horizon,
// and below the level where the surface leans that way.
vec4 seen_ground(float rise, vec4 lean, vec4 horizon)
{
    vec4 own2 = pow2(min(lean, 0.0)) / max(rise * rise + lean * lean, 1.0e-6);
    return rise * max(horizon * horizon - own2, 0.0) + pow2(max(lean, 0.0)) + 1.0e-4;
}

// Light is held in steps of 1 / 255, and dark slopes would show them: Jimenez 2014's noise.
float dither(vec2 pixel)
{
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 position = texelFetch(u_position, pixel, 0);
    vec3 p = (u_view_from_planet * position.xyz + u_view_offset) / u_view.w;
    vec2 g = p.xy * shadow_map_scale(LocalDirection(p.x, p.y, p.z), u_view.y, u_view.z);
    vec2 uv = 0.5 + 0.5 * g * u_view.x;
    vec4 first = textureLod(u_horizon0, uv, 0.0);
    vec4 second = textureLod(u_horizon1, uv, 0.0);
    float inside = max(abs(g.x), abs(g.y)) < 1.0 && position.w > -1.0e8 ? 1.0 : 0.0;
    first *= inside;
    second *= inside;

    // The map's axes at the place v: a vector e of its plane turned to e - (e v)/(1 + v_z) (v + a).
    vec3 v = normalize(vec3(p.xy, 1.0 + p.z));
    vec3 n = u_view_from_planet * texelFetch(u_normal, pixel, 0).xyz;
    float rise = dot(n, v);
    float share = (rise + n.z) / (1.0 + v.z);
    vec2 lean = n.xy - v.xy * share;
    vec2 between = sqrt(0.5) * vec2(lean.x + lean.y, lean.y - lean.x);
    float tilted = view_of_two(rise, lean.x, first.x, second.x) +
                   view_of_two(rise, between.x, first.y, second.y) +
                   view_of_two(rise, lean.y, first.z, second.z) +
                   view_of_two(rise, between.y, first.w, second.w);
    o_view = vec4(0.0, 0.0, 0.0, clamp(0.125 * tilted, 0.0, 1.0));

    uv = 0.5 + 0.5 * g * u_light_scale;
    vec4 light0 = textureLod(u_light0, uv, 0.0);
    vec4 light1 = textureLod(u_light1, uv, 0.0);
    vec4 leans = vec4(lean.x, between.x, lean.y, between.y);
    vec4 seen0 = seen_ground(rise, leans, first);
    vec4 seen1 = seen_ground(rise, -leans, second);
    float light = (dot(seen0, light0 * light0) + dot(seen1, light1 * light1)) /
                  (dot(seen0, vec4(1.0)) + dot(seen1, vec4(1.0)));
    // Alpha is the depth of water, where that is.
    float land = texelFetch(u_albedo, pixel, 0).a > 0.0 ? 0.0 : 1.0;
    float root = clamp(sqrt(light) + dither(gl_FragCoord.xy) / 255.0, 0.0, 1.0);
    o_light = vec4(0.0, 0.0, 0.0, land * root);
}
