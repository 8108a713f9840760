// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Light meter, second step, one texel: the exposure value that the cells ask for, and how far the
// eye has followed. In: cells (RG32F of meter.frag), the exposure so far (RG32F, 1 x 1). Out:
// RG32F, EV100 and what luminance is multiplied with.

#include "shared/meter.glsl"

uniform sampler2D u_cells;
uniform sampler2D u_before;
uniform float u_follow;  // share of the way to the new exposure, 1: at once
uniform float u_bias_ev; // brightness asked for, in stops

layout(location = 0) out vec2 out_exposure;

float find_target(float before_ev)
{
    ivec2 size = textureSize(u_cells, 0);
    vec2 sums = vec2(0.0);
    for (int y = 0; y < size.y; y++) {
        for (int x = 0; x < size.x; x++) {
            sums += texelFetch(u_cells, ivec2(x, y), 0).rg;
        }
    }
    if (sums.x <= 0.0) {
        return u_follow < 1.0 ? before_ev : METER_EV_UNLIT;
    }
    return meter_exposure(sums.x, sums.y);
}

void main()
{
    float before_ev = texelFetch(u_before, ivec2(0), 0).r;
    float target_ev = find_target(before_ev);
    float ev = u_follow < 1.0 ? mix(before_ev, target_ev, u_follow) : target_ev;
    out_exposure = vec2(ev, exp2(u_bias_ev - ev) / TONE_SATURATION_PER_EV0);
}
