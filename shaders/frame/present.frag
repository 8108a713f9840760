// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Copies the picture into a window, filtered where the sizes differ. In: picture (RGBA8). Out:
// colour of the window.

uniform sampler2D u_picture;

in vec2 v_uv;
layout(location = 0) out vec4 out_color;

void main()
{
    out_color = texture(u_picture, v_uv);
}
