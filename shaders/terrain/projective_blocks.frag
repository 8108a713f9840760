// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The highest direction among each 16 probes of a column.
uniform highp sampler2D u_probes;

layout(location = 0) out float o_highest;

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    float highest = 0.0;
    for (int i = 0; i < 16; i++) {
        highest = max(highest, texelFetch(u_probes, ivec2(p.x, 16 * p.y + i), 0).x);
    }
    o_highest = highest;
}
