// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From bands to the picture's colours.
#ifndef SKY_SINGLE_COLOUR_GLSL
#define SKY_SINGLE_COLOUR_GLSL

uniform vec4 u_rgb_from_bands[3]; // rows, of light that ground or star send
uniform vec4 u_rgb_from_added[3]; // rows, of light that the air adds

vec3 added_colour(vec4 bands)
{
    return vec3(dot(u_rgb_from_added[0], bands), dot(u_rgb_from_added[1], bands),
                dot(u_rgb_from_added[2], bands));
}

vec4 join_light(vec4 sent, vec3 added)
{
    return vec4(dot(u_rgb_from_bands[0], sent) + added.r, dot(u_rgb_from_bands[1], sent) + added.g,
                dot(u_rgb_from_bands[2], sent) + added.b, 1.0);
}

#endif // SKY_SINGLE_COLOUR_GLSL
