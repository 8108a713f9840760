// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// From bands and XYZ to the picture's colours.
#ifndef SKY_SPECTRAL_COLOUR_GLSL
#define SKY_SPECTRAL_COLOUR_GLSL

uniform vec4 u_rgb_from_bands[3]; // rows
uniform vec4 u_rgb_from_xyz[3];   // rows, w unused

// What is added to a picture leaves its alpha.
#ifdef MOON
const float ALPHA = 0.0;
#else
const float ALPHA = 1.0;
#endif

vec4 join_radiance(vec4 bands, vec3 xyz)
{
    return vec4(dot(u_rgb_from_bands[0], bands) + dot(u_rgb_from_xyz[0].xyz, xyz),
                dot(u_rgb_from_bands[1], bands) + dot(u_rgb_from_xyz[1].xyz, xyz),
                dot(u_rgb_from_bands[2], bands) + dot(u_rgb_from_xyz[2].xyz, xyz), ALPHA);
}

#endif // SKY_SPECTRAL_COLOUR_GLSL
