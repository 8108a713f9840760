// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
in vec4 v_position;
out vec4 o_position;

void main()
{
    o_position = v_position;
}
