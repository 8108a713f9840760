// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
uniform vec4 u_color;

layout(location = 0) out vec4 o_color;

void main()
{
    o_color = u_color;
}
