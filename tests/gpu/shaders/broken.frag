// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
layout(location = 0) out vec4 o_color;
#include "broken_part.glsl"

void main()
{
    o_color = part();
}
