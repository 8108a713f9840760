// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One triangle that covers the viewport, as fullscreen.vert, at a depth between the kinds of
// sort.frag.

uniform float u_depth; // of the window, in (0, 1)

out vec2 v_uv; // (0, 0) lower left, (1, 1) upper right

void main()
{
    v_uv = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
#if TRL_CLIP_CONTROL
    float z = u_depth;
#else
    float z = 2.0 * u_depth - 1.0;
#endif
    gl_Position = vec4(v_uv * 2.0 - 1.0, z, 1.0);
}
