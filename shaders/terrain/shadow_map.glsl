// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The shadow map's texels as places.
#include "shared/hemisphere.glsl"

uniform vec3 u_map; // texels to a side, power, extent

// Texel centres run from border to border of the grid.
vec2 map_grid(vec2 pixel)
{
    return 2.0 * (pixel - 0.5) / (u_map.x - 1.0) - 1.0;
}

vec3 map_direction(vec2 g)
{
    LocalDirection d = shadow_map_direction(g.x, g.y, u_map.y, u_map.z);
    return vec3(d.x, d.y, d.z);
}

// Angle from one ring to the next.
float map_cell(vec2 g)
{
    float ring = max(max(abs(g.x), abs(g.y)), 1.0 / u_map.x);
    return length(map_direction(g * (1.0 + 2.0 / (u_map.x * ring))) - map_direction(g));
}
