// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Which pixels stand at an edge, as depth: 1 there, else 0.
// validate:
// validate: SURFACE

#include "frame/edges.glsl"

void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float own = nearness(pixel);
    float right = nearness(pixel + ivec2(1, 0));
    float left = nearness(pixel - ivec2(1, 0));
    float above = nearness(pixel + ivec2(0, 1));
    float below = nearness(pixel - ivec2(0, 1));
    bool marked = is_edge(left, own, right, nearness(pixel + ivec2(2, 0))) ||
                  is_edge(right, own, left, nearness(pixel - ivec2(2, 0))) ||
                  is_edge(below, own, above, nearness(pixel + ivec2(0, 2))) ||
                  is_edge(above, own, below, nearness(pixel - ivec2(0, 2)));
    gl_FragDepth = marked ? 1.0 : 0.0;
}
