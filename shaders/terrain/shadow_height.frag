// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where the shadow map starts from: the ground's altitude, a distance of 0, and the altitude again,
// which stays.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 3; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_POLAR; HAS_MODES
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_NOISE
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_PAGES
#include "terrain/layers.glsl"
#include "terrain/shadow_map.glsl"

out vec4 o_shadow;

void main()
{
    vec3 o = map_direction(map_grid(gl_FragCoord.xy));
    // Finer than a cell, since a filter cuts crests. One level of detail for 2 x 2 pixels, as
    // llvmpipe fetches it.
    vec2 quad = 2.0 * floor(0.5 * gl_FragCoord.xy) + 1.0;
    float cell = map_cell(map_grid(quad)) * u_anchor.w;
    float altitude = terrain_altitude_linear(geo_from_local(o, 1.0), log2(0.25 * cell));
    o_shadow = vec4(altitude, 0.0, altitude, 0.0);
}
