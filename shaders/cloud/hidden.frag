// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Of each square of pixels, what clouds leave of what is behind them: 1 nothing, so that it need
// not be drawn, 0 all, so that nothing is to be joined, else 1/2. All rays count of which join.frag
// takes something for one of its pixels.

uniform sampler2D u_clouds; // of every second pixel; a: 1 - transmittance

layout(location = 0) out float out_hidden;

const int SQUARE = 2; // of those rays; GPU_HIDE_SQUARE is that of pixels
const int BEFORE = 2; // that are taken from before its first, and after its last
const int BEHIND = 3;

void main()
{
    ivec2 last = textureSize(u_clouds, 0) - 1;
    ivec2 first = SQUARE * ivec2(gl_FragCoord.xy) - BEFORE;
    int side = BEFORE + SQUARE + BEHIND;
    float least = 1.0;
    float most = 0.0;
    for (int n = 0; n < side * side; n++) {
        ivec2 at = clamp(first + ivec2(n % side, n / side), ivec2(0), last);
        float hidden = texelFetch(u_clouds, at, 0).a;
        least = min(least, hidden);
        most = max(most, hidden);
        if (least < 1.0 && most > 0.0) {
            break;
        }
    }
    out_hidden = least == 1.0 ? 1.0 : most > 0.0 ? 0.5 : 0.0;
}
