// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A square of pixels around a star, at a depth in front of air and space and behind ground (see
// sort.frag).

#include "sky/star.glsl"

uniform vec2 u_size; // of the picture, pixels

layout(location = 0) in vec2 a_corner; // of the square, -1 to 1
layout(location = 1) in vec2 a_centre; // pixels from the lower left corner
layout(location = 2) in vec4 a_light;  // cd m^-2 in linear sRGB; a: share in the halo

flat out vec2 v_centre;
flat out vec4 v_light;

void main()
{
    float half_width = a_light.a > 0.0 ? STAR_HALF_WIDTH * STAR_HALO : STAR_HALF_WIDTH;
    vec2 place = (a_centre + half_width * a_corner) / u_size;
    float depth = 0.75;
#if TRL_CLIP_CONTROL
    float z = depth;
#else
    float z = 2.0 * depth - 1.0;
#endif
    v_centre = a_centre;
    v_light = a_light;
    gl_Position = vec4(2.0 * place - 1.0, z, 1.0);
}
