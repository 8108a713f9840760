// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "lib/depth.glsl"
layout(location = 0) out vec4 o_color;

void main()
{
    o_color = depth_from_window(0.5) + no_such_name;
}
