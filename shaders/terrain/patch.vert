// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Corners of the patches of the tessellated hemisphere, by texels of what grid.frag drew.

uniform highp sampler2D u_positions;
uniform vec3 u_camera_offset; // as in mesh.vert

out vec2 v_texel;
out vec3 v_at; // from the camera, planet axes, m

void main()
{
    int side = textureSize(u_positions, 0).x;
    int row = gl_VertexID / side;
    ivec2 texel = ivec2(gl_VertexID - row * side, row);
    v_texel = vec2(texel);
    v_at = texelFetch(u_positions, texel, 0).xyz + u_camera_offset;
    gl_Position = vec4(0.0);
}
