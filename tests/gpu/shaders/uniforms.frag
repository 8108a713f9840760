// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Folds one uniform of each kind into a colour that the test calculates too.
#include "test_block.glsl"

uniform float u_float;
uniform int u_int;
uniform vec2 u_vec2;
uniform vec3 u_vec3;
uniform vec4 u_vec4;
uniform mat3 u_mat3;
uniform mat4 u_mat4;
uniform float u_floats[3];
uniform vec4 u_vec4s[2];

layout(location = 0) out vec4 o_color;

void main()
{
    o_color =
        vec4(u_float + float(u_int) + u_vec2.y, u_vec3.z + u_vec4.w, u_floats[2] + u_vec4s[1].x,
             (u_mat3 * vec3(0.0, 1.0, 0.0)).z + (u_mat4 * vec4(1.0, 0.0, 0.0, 0.0)).w);
    o_color += block_matrix * block_vector + block_array[1] * float(SCALE);
}
