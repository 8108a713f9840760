// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// gamma of each row of the grid (x).
// validate: ROWS_BY_SPHERES 0
// validate: ROWS_BY_SPHERES 1
#include "terrain/projective.glsl"

uniform highp sampler2D u_weights; // projective_weights.frag
uniform vec4 u_rows;               // how many; shares of chords and of pixels; zeta

layout(location = 0) out float o_gamma;

#if ROWS_BY_SPHERES
// As the paper has it: evenly spaced rays, up to the tangent of the primary sphere, whose radius is
// the least in the picture.
float find_gamma(float u)
{
    int rings = ring_count();
    float lowest = 1e9;
    for (int i = 0; i < rings; i++) {
        lowest = min(lowest, texelFetch(u_weights, ivec2(i, 0), 0).z);
    }
    float altitude = (u_eye.x - lowest) + u_eye.y;
    if (lowest > 1e8 || altitude < 0.01) { // nothing seen, or only what is higher than the viewer
        lowest = u_eye.x - 0.01;
        altitude = 0.01;
    }
    float excess = projective_excess(altitude, u_eye.z + lowest);
    float omega = u * projective_tangent(excess);
    return projective_blended_angle(omega, excess, u_eye.w, u_rows.w);
}
#else
vec3 find_weight(int ring)
{
    return texelFetch(u_weights, ivec2(ring, 0), 0).xyz;
}

float find_gamma(float u)
{
    int rings = ring_count();
    vec2 sum = vec2(0.0);
    for (int i = 0; i < rings; i++) {
        sum += find_weight(i).yx;
    }
    vec2 share = u_rows.yz / max(sum, vec2(1e-9));
    float even = max(1.0 - dot(share, sum), 0.0) / float(rings);
    float total = 0.0;
    for (int i = 1; i < rings; i++) {
        total += dot(share, 0.5 * (find_weight(i).yx + find_weight(i - 1).yx)) + even;
    }
    float wanted = u * total;
    float reached = 0.0;
    float v = 0.0;
    for (int i = 1; i < rings; i++) {
        float step = dot(share, 0.5 * (find_weight(i).yx + find_weight(i - 1).yx)) + even;
        v += clamp((wanted - reached) / step, 0.0, 1.0);
        reached += step;
    }
    int ring = int(floor(v));
    return mix(ring_angle(ring), ring_angle(ring + 1), v - floor(v));
}
#endif

void main()
{
    float u = floor(gl_FragCoord.x) / (u_rows.x - 1.0);
    o_gamma = u < 1.0 ? find_gamma(u) : u_eye.w;
}
