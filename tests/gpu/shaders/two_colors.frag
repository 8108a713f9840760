// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
layout(location = 0) out vec4 o_first;
layout(location = 1) out vec4 o_second;

void main()
{
    o_first = vec4(1.0, 2.0, 3.0, 4.0);
    o_second = vec4(5.0, 6.0, 7.0, 8.0);
}
