// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Over all columns of probes, for each ring (x): mean length in view, fourth root of the mean
// squared departure from chords (the number of chords that are needed goes with the square root of
// that), lowest altitude in the picture.
uniform highp sampler2D u_seen; // projective_seen.frag

layout(location = 0) out vec4 o_weights;

void main()
{
    int ring = int(gl_FragCoord.x);
    int columns = textureSize(u_seen, 0).x;
    vec3 sum = vec3(0.0, 0.0, 1e9);
    for (int i = 0; i < columns; i++) {
        vec3 seen = texelFetch(u_seen, ivec2(i, ring), 0).xyz;
        sum = vec3(sum.xy + seen.xy, min(sum.z, seen.z));
    }
    o_weights = vec4(sum.x / float(columns), sqrt(sqrt(sum.y / float(columns))), sum.z, 0.0);
}
