// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How the star lights the ground that a place sees around it, in the azimuths of
// sky_view_horizon.frag: the root of the mean, 1 where all of the light falls straight on.
#include "terrain/sky_view_ways.glsl"

const int STEPS = 12;

layout(location = 0) out vec4 o_first;
layout(location = 1) out vec4 o_second;

// Each step counts by what it rises above those before it; a little all of them, where none does.
float light_along(Way way, vec2 along)
{
    float distance_m = way.first;
    vec2 sum = vec2(0.0);
    float horizon = -1.0;
    for (int i = 0; i < STEPS; i++) {
        vec2 there = look_along(way, along, distance_m);
        float sine = there.x * inversesqrt(1.0 + there.x * there.x);
        float rises = i == 0 ? 0.0 : max(sine - horizon, 0.0);
        sum += (rises + 1.0e-3) * vec2(there.y, 1.0);
        horizon = i == 0 ? sine : max(horizon, sine);
        distance_m *= way.ratio;
    }
    return sum.x / sum.y;
}

void main()
{
    Way way = way_from_pixel(STEPS);
    float d = sqrt(0.5);
    o_first = sqrt(vec4(light_along(way, vec2(1.0, 0.0)), light_along(way, vec2(d, d)),
                        light_along(way, vec2(0.0, 1.0)), light_along(way, vec2(-d, d))));
    o_second = sqrt(vec4(light_along(way, vec2(-1.0, 0.0)), light_along(way, vec2(-d, -d)),
                         light_along(way, vec2(0.0, -1.0)), light_along(way, vec2(d, -d))));
}
