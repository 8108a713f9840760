// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One triangle that covers the viewport; needs no vertex data. Depth 0: infinitely far in reversed
// depth.

out vec2 v_uv; // (0, 0) lower left, (1, 1) upper right

void main()
{
    v_uv = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(v_uv * 2.0 - 1.0, 0.0, 1.0);
}
