// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What sphere.vert has integrated, between its vertices.
#ifndef SKY_SINGLE_VERTEX_LIGHT_GLSL
#define SKY_SINGLE_VERTEX_LIGHT_GLSL

#include "sky/single/colour.glsl"

in vec4 v_transmittance;
#if CHANNEL_COUNT > 0
in vec4 v_added[CHANNEL_COUNT];
#endif

vec3 vertex_light(vec4 phase)
{
    vec4 sum = vec4(0.0);
#if CHANNEL_COUNT > 0
    for (int c = 0; c < CHANNEL_COUNT; c++) {
        sum += v_added[c] * phase[c];
    }
#endif
    return added_colour(sum);
}

#endif // SKY_SINGLE_VERTEX_LIGHT_GLSL
