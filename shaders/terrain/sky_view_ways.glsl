// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Ways over the map of sky_view_heights.frag, to where the terrain's horizon is. They are straight
// on the map's stereographic plane, which keeps angles, and looked at in steps that grow with the
// distance, at means over some of it.
#include "terrain/shadow_map.glsl"

uniform sampler2D u_ground; // with all levels
uniform vec4
    u_reach; // first step in cells; where the last one ends, m; sphere's radius, m; log2 of
             // the means' width over the distance
uniform float u_ground_side; // texels

struct Way {
    vec2 from;    // on the plane
    float height; // m
    float first;  // step, m
    float ratio;  // of each step to the one before
    float per_m;  // units of the plane
};

// Altitude and light at a point of the plane; `width`: log2, in its units.
vec2 ground_at(vec2 t, float width)
{
    float size = max(max(abs(t.x), abs(t.y)), 1.0e-9);
    // The grid's rings are at extent m^power; cells are as wide as the mean of both ways.
    float ring_over_size = exp2(log2(size / u_map.z) / u_map.y) / size;
    float lod = width + log2(0.5 * u_ground_side * ring_over_size) - 0.5 * log2(u_map.y);
    vec2 uv = 0.5 + 0.5 * t * ring_over_size * (1.0 - 1.0 / u_ground_side);
    return textureLod(u_ground, uv, max(lod, 0.0)).rg;
}

// At this program's pixel, with a number of steps.
Way way_from_pixel(int steps)
{
    vec2 g = map_grid(gl_FragCoord.xy);
    Way way;
    way.from = g * shadow_map_warp(g.x, g.y, u_map.y) * u_map.z;
    way.height = textureLod(u_ground, 0.5 + 0.5 * g * (1.0 - 1.0 / u_ground_side), 0.0).r;
    way.first = u_reach.x * max(map_cell(g), 1.0e-9) * u_reach.z;
    way.ratio = exp2(log2(max(u_reach.y / way.first, 1.5)) / float(steps - 1));
    way.per_m = 0.5 * (1.0 + dot(way.from, way.from)) / u_reach.z;
    return way;
}

// Tangent of the elevation of the ground at a distance along a direction of the plane, and light.
vec2 look_along(Way way, vec2 along, float distance_m)
{
    float apart = distance_m * way.per_m;
    vec2 there = ground_at(way.from + along * apart, log2(apart) + u_reach.w);
    // Over the sphere's curve: R (1 - cos(angle)).
    float drop = 0.5 * distance_m * distance_m / u_reach.z * (1.0 + there.x / u_reach.z);
    float rise = there.x - way.height - drop;
    return vec2(rise / (distance_m * (1.0 + there.x / u_reach.z)), there.y);
}
