// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One texel a vertex of the hemisphere mesh: xyz = position less the anchor's at u_datum, planet
// axes, m; w = altitude, m. Drawn once for each projection camera.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 3; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_POLAR; HAS_MODES
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_NOISE
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_PAGES
#include "shared/hemisphere.glsl"
#include "terrain/layers.glsl"

uniform vec2 u_grid;  // cells to a side, lift (z_s)
uniform vec2 u_rings; // inner part and power of the warp
uniform mat3 u_planet_from_local;

out vec4 o_position;

vec3 grid_direction(vec2 g)
{
    LocalDirection d =
        hemisphere_direction(g.x, g.y, HemisphereRings(u_rings.x, u_rings.y), u_grid.y);
    return vec3(d.x, d.y, d.z);
}

void main()
{
    vec2 g = 2.0 * floor(gl_FragCoord.xy) / u_grid.x - 1.0;
    vec3 o = grid_direction(g);
    // The level of detail is that of the 2 x 2 pixels together: llvmpipe fetches one level for all
    // of them. Half of a cell's longer side, toward the next ring: what a whole one filters away
    // is missing in silhouettes and pops up when the camera comes near (terrain-error: 1.33 for
    // 0.83 px, 0.20 for 0.16 px).
    vec2 quad = 4.0 * floor(0.5 * gl_FragCoord.xy) / u_grid.x - 1.0;
    vec2 next =
        quad * (1.0 + 2.0 / (u_grid.x * max(max(abs(quad.x), abs(quad.y)), 1.0 / u_grid.x)));
    float cell = length(grid_direction(next) - grid_direction(quad)) * u_anchor.w;
    float h = terrain_altitude(geo_from_local(o, 1.0), log2(cell) - 1.0);
    // Near the anchor both terms are small, and keep their digits.
    vec3 offset = o * (u_anchor.w + (h + u_datum)) + vec3(0.0, 0.0, h);
    o_position = vec4(u_planet_from_local * offset, h + u_datum);
}
