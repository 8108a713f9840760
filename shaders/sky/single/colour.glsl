// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From bands to the picture's colours.
#ifndef SKY_SINGLE_COLOUR_GLSL
#define SKY_SINGLE_COLOUR_GLSL

uniform vec4 u_rgb_from_bands[3]; // rows, of light that ground or star send

vec4 join_light(vec4 sent, vec3 added)
{
    return vec4(dot(u_rgb_from_bands[0], sent) + added.r, dot(u_rgb_from_bands[1], sent) + added.g,
                dot(u_rgb_from_bands[2], sent) + added.b, 1.0);
}

#endif // SKY_SINGLE_COLOUR_GLSL
