// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Of each square of pixels: 1 where all of it is level sea far from any shore, of which neither
// relief nor the mask's borders have anything to tell.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 4; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 2; LIGHTS_COUNT 0; HAS_POLAR; HAS_PAGES
#include "terrain/layers.glsl"
#include "terrain/water.glsl"

uniform highp sampler2D u_position;
uniform mat3 u_local_from_planet; // as in terrain/surface.frag
uniform vec4 u_view;
uniform float u_shores; // log2 of how far from a shore heights and masks have something of it, m

layout(location = 0) out float out_open;

const int SQUARE = 4;                // pixels a side; GPU_HIDE_SQUARE
const float LEVEL_M = 0.1;           // shore_water has water where ground is no higher
const float ALL = 1.0 - 0.5 / 255.0; // of a mask

// The part of the mask that is water, around a place that is seen in a square.
float find_water(vec3 position)
{
    vec3 local = u_local_from_planet * position;
    vec3 up = normalize(vec3(local.xy, u_view.x + local.z));
    float distance_m = max(length(local), 1.0e-3);
    float slant = max(abs(dot(local, up)) / distance_m, 0.02);
    float side_m = float(SQUARE) * distance_m * u_view.y / slant;
    vec2 geo = geo_from_local(local, u_view.x);
    return terrain_water(ground_at(geo), max(log2(side_m), u_shores)).x;
}

void main()
{
    ivec2 last = textureSize(u_position, 0) - 1;
    ivec2 first = SQUARE * ivec2(gl_FragCoord.xy);
    float farthest_m = 0.0; // from sea level
    int n = 0;
    do {
        ivec2 at = min(first + ivec2(n % SQUARE, n / SQUARE), last);
        farthest_m = max(farthest_m, abs(texelFetch(u_position, at, 0).w));
        n++;
    } while (n < SQUARE * SQUARE);
    float water = 1.0;
    int corner = 0;
    do {
        ivec2 at = min(first + (SQUARE - 1) * ivec2(corner % 2, corner / 2), last);
        water = min(water, find_water(texelFetch(u_position, at, 0).xyz));
        corner++;
    } while (corner < 4 && farthest_m < LEVEL_M);
    out_open = farthest_m < LEVEL_M && water > ALL ? 1.0 : 0.0;
}
