// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Over what clouds hide: sets its depth to one that no later pass draws at.

uniform sampler2D u_hidden; // of squares of pixels

const int SQUARE = 4; // pixels a side of them

void main()
{
    if (texelFetch(u_hidden, ivec2(gl_FragCoord.xy) / SQUARE, 0).x < 1.0) {
        discard;
    }
}
