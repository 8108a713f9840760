// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
flat in float v_weight;
layout(location = 0) out vec4 o_color;

void main()
{
    o_color = vec4(v_weight, v_weight, v_weight, 0.5);
}
