// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What of each probe is in the picture, in lengths of the image plane at distance 1: x between what
// hides it and itself; y squared, by how much it departs from the chord of its neighbours; z its
// altitude, 1e9 where it is hidden.
#include "terrain/projective.glsl"

uniform highp sampler2D u_probes;  // projective_probe.frag
uniform highp sampler2D u_highest; // projective_blocks.frag
uniform float u_probe_step;        // columns of the grid for one of probes
uniform vec3 u_forward;            // in the local frame

layout(location = 0) out vec4 o_seen;

// What heights are uncertain by, as floats of kilometres: seen from nearby it would look like
// relief.
const float ROUNDING_M = 0.001;

vec2 find_probe(ivec2 p)
{
    float h = texelFetch(u_probes, p, 0).y;
    return profile_point(ring_angle(p.y), h);
}

float find_hidden_below(ivec2 p)
{
    int block = p.y / 16;
    float highest = 0.0;
    for (int i = 0; i < block; i++) {
        highest = max(highest, texelFetch(u_highest, ivec2(p.x, i), 0).x);
    }
    for (int i = 16 * block; i < p.y; i++) {
        highest = max(highest, texelFetch(u_probes, ivec2(p.x, i), 0).x);
    }
    return highest;
}

void main()
{
    ivec2 p = ivec2(gl_FragCoord.xy);
    vec4 column = texelFetch(u_columns, ivec2((float(p.x) + 0.5) * u_probe_step, 0), 0);
    vec2 probe = texelFetch(u_probes, p, 0).xy;
    float hidden = find_hidden_below(p);
    float seen = max(min(probe.x, column.w) - max(hidden, column.z), 0.0);
    float ahead = dot(u_forward, vec3(sin(probe.x) * column.xy, -cos(probe.x)));
    float scale = 1.0 / (max(ahead, 0.2) * max(ahead, 0.2));

    int last = ring_count() - 1;
    vec2 at = find_probe(p);
    vec2 before = find_probe(ivec2(p.x, max(p.y - 1, 0)));
    vec2 after = find_probe(ivec2(p.x, min(p.y + 1, last)));
    float t = clamp((at.x - before.x) / max(after.x - before.x, 1e-6), 0.0, 1.0);
    float sag_m = max(abs(mix(before.y, after.y, t) - at.y) - ROUNDING_M, 0.0);
    float sag = sag_m * sin(probe.x) / max(length(at), 1e-3);
    bool is_seen = probe.x >= hidden && probe.x > column.z - 0.01 && probe.x < column.w + 0.01;
    o_seen = vec4(scale * seen, is_seen ? scale * scale * sag * sag : 0.0,
                  seen > 0.0 ? probe.y : 1e9, 0.0);
}
