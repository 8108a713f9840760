// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What a pixel of open water shows of the waves: the mean normal of those that it resolves (planet
// axes, of the length 1 + part under fresh foam), and the mean square slope of all that it does
// not, along and across together.
#include "ocean/waves.glsl"
#include "shared/sea.glsl"

uniform sampler2D u_position; // relative to the camera, m
uniform sampler2D u_level;    // of displaced sea: see join.frag
uniform float u_has_level;    // 1: there is such
uniform sampler2D u_albedo;   // a: part that is open water
uniform sampler2D u_lights;   // a: code of the water's depth
uniform float u_pixel_rad;
uniform vec4 u_foam[SEA_SURF_STEPS + 1]; // where it begins and how wide: sea_foam, sea_surf_step
uniform float u_broken;                  // depth where all waves have broken, m

layout(location = 0) out vec4 o_facet;

// `level`: the place that waves have moved to `position`, and the cosine between view and normal
// there; w 0: water that lies level.
vec4 facet(vec3 position, vec4 level, float depth)
{
    GerstnerPlace p = waves_place(level.w > 0.0 ? level.xyz : position);
    vec3 up = vec3(p.vx, p.vy, p.vz);
    vec3 way = u_wave_local_from_planet * position;
    float side = length(way) * u_pixel_rad;
    float mu = clamp(-dot(up, way) / max(length(way), 1.0e-6), 1.0e-3, 1.0);
    // Where a wave turns away no pixel is longer on it than on level water: crests are round.
    mu = max(mu, level.w);
    // A pixel on the ground: its own width across, longer by 1 / mu along the view.
    vec2 flat_way = way.xy / max(length(way.xy), 1.0e-6);
    vec2 along = flat_way * (side / mu);
    vec2 across = vec2(-flat_way.y, flat_way.x) * side;
    GerstnerSum sum = waves_sum(p, WavesWindow(along, across, side, depth));
    GerstnerNormal n = gerstner_normal(sum);
    GerstnerNormal turned = gerstner_to_anchor(p, n.x, n.y, n.z);
    // A row times a matrix: the transpose turns local axes back into the planet's.
    vec3 normal = normalize(vec3(turned.x, turned.y, turned.z)) * u_wave_local_from_planet;
    float all = max(sum.press_square, 1.0e-12);
    float lost = sqrt(sum.press_lost / all);
    float surf = sea_surf_step(depth, u_broken);
    int deeper = int(min(surf, SEA_SURF_LAST - 1.0));
    vec2 ramp = mix(u_foam[deeper].xy, u_foam[deeper + 1].xy, surf - float(deeper));
    float foam = sea_foam(sum.press * inversesqrt(all), lost, ramp.x, ramp.y);
    return vec4(normal * (1.0 + foam), sum.lost_square);
}

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    o_facet = vec4(0.0);
    if (texelFetch(u_albedo, pixel, 0).a > 0.0) {
        float code = texelFetch(u_lights, pixel, 0).a;
        float depth = code > 0.0 ? sea_code_depth(code) : 1.0e6;
        vec4 level = u_has_level * texelFetch(u_level, pixel, 0);
        o_facet = facet(texelFetch(u_position, pixel, 0).xyz, level, depth);
    }
}
