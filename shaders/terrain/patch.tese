// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Vertices of the tessellated hemisphere: texels of what grid.frag drew.
layout(quads, equal_spacing, ccw) in;
#include "terrain/depth.glsl"

uniform highp sampler2D u_positions;
uniform vec3 u_camera_offset;
uniform mat3 u_view;

in vec2 c_texel[];
out vec4 v_position; // relative to the camera; altitude

void main()
{
    vec2 texel = c_texel[0] + gl_TessCoord.xy * (c_texel[2] - c_texel[0]);
    vec4 p = texelFetch(u_positions, ivec2(floor(texel + 0.5)), 0);
    v_position = vec4(p.xyz + u_camera_offset, p.w);
    gl_Position = depth_clip(u_view * v_position.xyz);
}
