// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The shares after one step. Where a ray of the grid ended before the step, at ground that is
// nearer, stands the mean of the rays around it that went on: what is beyond a ridge is not mixed
// with what is before it.

uniform sampler2D u_steps; // XYZ; alpha: how far the ray was looked at, m from where its air begins
uniform float u_distance;  // from which the step goes, m from there

out vec4 out_share;

void main()
{
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_steps, 0) - 1;
    vec4 own = texelFetch(u_steps, here, 0);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 9; i++) {
        ivec2 at = clamp(here + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        vec4 there = texelFetch(u_steps, at, 0);
        sum += vec4(there.xyz, 1.0) * (there.w >= u_distance ? 1.0 : 0.0);
    }
    bool is_own = own.w >= u_distance || sum.w < 0.5;
    out_share = vec4(is_own ? own.xyz : sum.xyz / max(sum.w, 1.0), 1.0);
}
