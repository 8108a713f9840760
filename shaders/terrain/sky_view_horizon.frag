// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The terrain's horizon at each place of a map around the camera: its sine in eight azimuths, from
// the map's x axis toward y in steps of 45 degrees.
#include "terrain/sky_view_ways.glsl"

const int STEPS = 20;

layout(location = 0) out vec4 o_first;
layout(location = 1) out vec4 o_second;

// Tangent of the largest elevation along a direction of the plane.
float highest(Way way, vec2 along)
{
    float tangent = 0.0;
    float distance_m = way.first;
    for (int i = 0; i < STEPS; i++) {
        tangent = max(tangent, look_along(way, along, distance_m).x);
        distance_m *= way.ratio;
    }
    return tangent;
}

void main()
{
    Way way = way_from_pixel(STEPS);
    float d = sqrt(0.5);
    vec4 a = vec4(highest(way, vec2(1.0, 0.0)), highest(way, vec2(d, d)),
                  highest(way, vec2(0.0, 1.0)), highest(way, vec2(-d, d)));
    vec4 b = vec4(highest(way, vec2(-1.0, 0.0)), highest(way, vec2(-d, -d)),
                  highest(way, vec2(0.0, -1.0)), highest(way, vec2(d, -d)));
    o_first = a * inversesqrt(1.0 + a * a);
    o_second = b * inversesqrt(1.0 + b * b);
}
