// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Heights of the ground for the quadtree's grids, m. One draw for each square, whose middle is the
// anchor.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_NOISE
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
#include "terrain/layers.glsl"

uniform highp sampler2D u_places; // longitude, latitude from the anchor; log2 of the footprint, m

out float o_height;

void main()
{
    vec3 place = texelFetch(u_places, ivec2(gl_FragCoord.xy), 0).xyz;
    o_height = terrain_altitude(place.xy, place.z);
}
