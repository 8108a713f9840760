// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Passes where the grid has open water: whether the sea is drawn at all.
// validate:
uniform sampler2D u_shore; // of shore.frag

layout(location = 0) out vec4 o_open;

void main()
{
    if (texelFetch(u_shore, ivec2(gl_FragCoord.xy), 0).x <= 0.5) { // as in crests.frag
        discard;
    }
    o_open = vec4(1.0);
}
