// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
in vec3 v_uv; // of another type than lib/fullscreen.vert writes
layout(location = 0) out vec4 o_color;

void main()
{
    o_color = vec4(v_uv, 1.0);
}
