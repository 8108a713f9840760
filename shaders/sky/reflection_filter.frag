// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Mirrored terrain, where facets spread the image over pixels: the mean of as many texels as have
// followed different facets (reflection.frag), of those that show water.

uniform sampler2D u_reflection; // of sky/reflection.frag
uniform sampler2D u_weight;
uniform vec3 u_disc;        // as in sky/ray.glsl
uniform sampler2D u_facets; // as in sky/sea.glsl

layout(location = 0) out vec4 out_reflection; // as there

void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_reflection, 0) - 1;
    float mss = texelFetch(u_facets, min(2 * texel, textureSize(u_facets, 0) - 1), 0).w;
    // Of the square's width of eight pixels.
    float spread = clamp(sqrt(mss) / (4.0 * u_disc.z) - 0.25, 0.0, 1.0);
    vec4 own = texelFetch(u_reflection, texel, 0);
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    int n = 0;
    do {
        ivec2 apart = ivec2(n % 5, n / 5) - 2;
        ivec2 place = clamp(texel + apart, ivec2(0), last);
        vec4 near = texelFetch(u_reflection, place, 0);
        // Four wide: of the outer ones halves.
        float weight = (abs(apart.x) == 2 ? 0.5 : 1.0) * (abs(apart.y) == 2 ? 0.5 : 1.0);
        weight *= near.a < 0.0 ? 0.0 : texelFetch(u_weight, place, 0).x;
        sum += weight * near;
        weights += weight;
        n++;
    } while (n < 25 && own.a >= 0.0 && spread > 0.0);
    out_reflection = own.a < 0.0 ? own : mix(own, sum / max(weights, 1.0e-9), spread);
}
