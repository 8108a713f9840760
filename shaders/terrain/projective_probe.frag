// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The ground at coarse places: a column of probes for every few columns of the grid (x), rings
// around the nadir (y).
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 1; WATER_COUNT 1; LIGHTS_COUNT 1; NO_FLOAT_LINEAR
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_NOISE
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
#include "terrain/layers.glsl"
#include "terrain/projective.glsl"

uniform vec2 u_probe; // columns of the grid for one of probes; radians between columns of the grid

layout(location = 0) out vec2 o_probe; // omega under which it is seen, rad; altitude, m

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 column = texelFetch(u_columns, ivec2((float(p.x) + 0.5) * u_probe.x, 0), 0);
    float gamma = ring_angle(p.y);
    // One level of detail for 2 x 2 pixels: llvmpipe fetches at one for all of them.
    float far = ring_angle(p.y | 1);
    float footprint = u_eye.z * max(sin(far) * u_probe.y, 1e-9);
    float h =
        terrain_altitude(geo_from_local(profile_direction(gamma, column.xy), 1.0), log2(footprint));
    vec2 at = profile_point(gamma, h);
    o_probe = vec2(atan(at.x, at.y), h);
}
