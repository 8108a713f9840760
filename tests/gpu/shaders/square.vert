// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A square over the whole view at a depth and with a weight of its own for each instance.
layout(location = 0) in vec2 a_corner;
layout(location = 1) in vec2 a_depth_weight;

flat out float v_weight;

void main()
{
    v_weight = a_depth_weight.y;
    gl_Position = vec4(a_corner, a_depth_weight.x, 1.0);
}
