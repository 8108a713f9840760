// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the passes of the projective mesher share. The C side is src/terrain/projective.c. Places
// are in the viewer's local frame: x east, y north, z up.
#include "shared/projective.glsl"

// The viewer's altitude above the reference sphere as the sum of x and y, m; z that sphere's
// radius, m; w the reach, rad.
uniform vec4 u_eye;
uniform vec3 u_rings;              // near and span of projective_ring, how many
uniform highp sampler2D u_columns; // cosine and sine of the azimuth; range of omega in view

// Of a point of the half plane of a column: distance from the vertical, depth below the viewer.
vec2 profile_point(float gamma, float altitude)
{
    float r = u_eye.z + altitude;
    float s = sin(0.5 * gamma);
    return vec2(r * sin(gamma), ((u_eye.x - altitude) + u_eye.y) + 2.0 * r * s * s);
}

// Direction from the planet's centre, less (0, 0, 1).
vec3 profile_direction(float gamma, vec2 azimuth)
{
    float s = sin(0.5 * gamma);
    return vec3(sin(gamma) * azimuth, -2.0 * s * s);
}

float ring_angle(int ring)
{
    float v = float(ring) / (u_rings.z - 1.0);
    return v < 1.0 ? projective_ring(v, u_rings.x, u_rings.y) : u_eye.w;
}
