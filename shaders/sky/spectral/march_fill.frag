// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The shares after four steps. Where a ray of the grid ended before a step, at ground that is
// nearer, stands the mean of the rays around it that went on: what is beyond a ridge is not mixed
// with what is before it.

uniform highp sampler3D u_shares; // XYZ; alpha: how far the ray was looked at, m from where its air
                                  // begins
uniform int u_first;              // layer of the first of the steps
uniform vec4 u_distances;         // from which each goes, m from there

layout(location = 0) out vec4 out_shares[4];

vec4 fill(int layer, float distance_m)
{
    ivec2 here = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_shares, 0).xy - 1;
    vec4 own = texelFetch(u_shares, ivec3(here, layer), 0);
    vec4 sum = vec4(0.0);
    int i = 0;
    do {
        ivec2 at = clamp(here + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        vec4 there = texelFetch(u_shares, ivec3(at, layer), 0);
        sum += vec4(there.xyz, 1.0) * (there.w >= distance_m ? 1.0 : 0.0);
        i++;
    } while (i < 9 && own.w < distance_m);
    bool is_own = own.w >= distance_m || sum.w < 0.5;
    return vec4(is_own ? own.xyz : sum.xyz / max(sum.w, 1.0), 1.0);
}

void main()
{
    out_shares[0] = fill(u_first, u_distances.x);
    out_shares[1] = fill(u_first + 1, u_distances.y);
    out_shares[2] = fill(u_first + 2, u_distances.z);
    out_shares[3] = fill(u_first + 3, u_distances.w);
}
