// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Vertices of the hemisphere and projective meshes, read from the texture that grid.frag or
// projective_grid.frag drew.
#include "terrain/depth.glsl"

uniform highp sampler2D u_positions;
uniform vec3 u_camera_offset; // anchor at the base altitude - camera, planet axes, m
uniform mat3 u_view;          // rows right / tan, up / tan, forward

out vec4 v_position; // relative to the camera; altitude

void main()
{
    int side = textureSize(u_positions, 0).x;
    int row = gl_VertexID / side;
    vec4 p = texelFetch(u_positions, ivec2(gl_VertexID - row * side, row), 0);
    v_position = vec4(p.xyz + u_camera_offset, p.w);
    gl_Position = depth_clip(u_view * v_position.xyz);
}
