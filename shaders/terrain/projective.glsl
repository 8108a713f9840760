// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the passes of the projective mesher share. The C side is src/terrain/projective.c. Places
// are in the viewer's local frame: x east, y north, z up.
#include "shared/projective.glsl"

// The viewer's altitude above the reference sphere as the sum of x and y, m; z that sphere's
// radius, m; w the reach, rad.
uniform vec4 u_eye;
uniform highp sampler2D u_rings;   // gamma of each ring of probes, from 0 to the reach
uniform highp sampler2D u_columns; // cosine and sine of the azimuth; range of omega in view

// Of a point of the half plane of a column: distance from the vertical, depth below the viewer.
// The altitude is the sum of a datum and what is above it.
vec2 profile_point_above(float gamma, float datum, float above)
{
    float r = u_eye.z + (datum + above);
    float s = sin(0.5 * gamma);
    return vec2(r * sin(gamma), (((u_eye.x - datum) - above) + u_eye.y) + 2.0 * r * s * s);
}

vec2 profile_point(float gamma, float altitude)
{
    return profile_point_above(gamma, altitude, 0.0);
}

// Direction from the planet's centre, less (0, 0, 1).
vec3 profile_direction(float gamma, vec2 azimuth)
{
    float s = sin(0.5 * gamma);
    return vec3(sin(gamma) * azimuth, -2.0 * s * s);
}

int ring_count()
{
    return textureSize(u_rings, 0).x;
}

float ring_angle(int ring)
{
    return texelFetch(u_rings, ivec2(min(ring, ring_count() - 1), 0), 0).x;
}
