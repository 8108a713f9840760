// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One texel a vertex of the projective mesh: xyz = position from the camera, planet axes, m; w =
// altitude, m.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_NOISE
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
#include "terrain/layers.glsl"
#include "terrain/projective.glsl"

uniform highp sampler2D u_rows; // gamma of each; projective_rows.frag
uniform mat3 u_planet_from_local;
uniform vec2 u_footprint;

out vec4 o_position;

// log2 of the width of a cell, one for 2 x 2 pixels: llvmpipe fetches at one level for all of them.
float find_footprint(ivec2 p)
{
    ivec2 first = p & ~1;
    vec2 a = texelFetch(u_columns, ivec2(first.x, 0), 0).xy;
    vec2 b = texelFetch(u_columns, ivec2(first.x + 1, 0), 0).xy;
    float near = texelFetch(u_rows, ivec2(first.y, 0), 0).x;
    float far = texelFetch(u_rows, ivec2(first.y + 1, 0), 0).x;
    float across = abs(a.x * b.y - a.y * b.x) * sin(0.5 * (near + far));
    float along = far - near;
    float cell = across * pow(max(along / across, 1.0), u_footprint.x) * u_footprint.y;
    return log2(max(cell, 1e-12) * u_eye.z);
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec2 azimuth = texelFetch(u_columns, ivec2(p.x, 0), 0).xy;
    float gamma = texelFetch(u_rows, ivec2(p.y, 0), 0).x;
    vec3 direction = profile_direction(gamma, azimuth);
    float h = terrain_altitude(geo_from_local(direction, 1.0), find_footprint(p));
    vec2 at = profile_point_above(gamma, u_datum, h);
    o_position = vec4(u_planet_from_local * vec3(at.x * azimuth, -at.y), u_datum + h);
}
