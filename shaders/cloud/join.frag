// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds of every second pixel over a whole picture, in three passes. FILTER joins each four, whose
// rays begin their steps at different places, into one between them; SHARPEN gives those back what
// that took of their edges; without either each pixel takes of the four around it. All take those
// whose rays end about where their own does, so that no cloud behind a ridge hangs before it.
// Where pixels are so wide that nothing is left to be spread, the last takes what was marched.
// validate: SURFACE
// validate: SURFACE; FILTER
// validate: SHARPEN

#include "cloud/ends.glsl"

in vec2 v_uv;

#ifdef SHARPEN
uniform sampler2D u_joined;
uniform sampler2D u_ends; // of each, y: logarithm of ray_end
#else
uniform sampler2D u_clouds;
uniform sampler2D u_clouds_ends;
#ifndef FILTER
uniform sampler2D u_hidden; // of squares of pixels, see cloud/hidden.frag
const int SQUARE = 4;       // GPU_HIDE_SQUARE
uniform sampler2D u_joined; // sharpened
uniform sampler2D u_ends;
uniform float u_sharp; // share of what was marched
#endif
#endif

layout(location = 0) out vec4 out_clouds;
#ifdef FILTER
layout(location = 1) out vec2 out_ends; // cloud/rays.h
#endif

#ifdef SHARPEN
const float ALIKE = 0.9;   // of which all five are at least, to be sharpened
const float SHARPER = 1.0; // of what one has over those around it, how much is added

// Means of fours are taken over four pixels, which takes the sharpness of edges; what each has over
// those around it gives some of it back. They have no spread of rays, so none comes back, and what
// stays between the least and the most of them makes no fringes.
void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    ivec2 last = textureSize(u_joined, 0) - 1;
    vec4 joined = texelFetch(u_joined, texel, 0);
    float own = texelFetch(u_ends, texel, 0).y;
    vec4 least = joined;
    vec4 most = joined;
    vec4 around = vec4(0.0);
    float alike = 1.0;
    for (int n = 0; n < 4; n++) {
        ivec2 way = ivec2(n & 1, 1 - (n & 1)) * ((n & 2) - 1);
        ivec2 at = clamp(texel + way, ivec2(0), last);
        vec4 there = texelFetch(u_joined, at, 0);
        least = min(least, there);
        most = max(most, there);
        around += 0.25 * there;
        alike = min(alike, cloud_alike(texelFetch(u_ends, at, 0).y, own));
    }
    vec4 sharpened = clamp(joined + SHARPER * (joined - around), least, most);
    out_clouds = alike < ALIKE ? joined : sharpened;
}
#else
// Of four from the first on, by how near they are: `part` of the way to the next.
vec4 join_four(sampler2D clouds, sampler2D ends, ivec2 first, vec2 part, float own)
{
    ivec2 last = textureSize(clouds, 0) - 1;
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int n = 0; n < 4; n++) {
        ivec2 corner = ivec2(n & 1, n >> 1);
        ivec2 at = clamp(first + corner, ivec2(0), last);
        vec2 near = mix(1.0 - part, part, vec2(corner));
        float weight = (near.x * near.y + 1.0e-4) * cloud_alike(texelFetch(ends, at, 0).y, own);
        sum += texelFetch(clouds, at, 0) * weight;
        weights += weight;
    }
    return sum / weights;
}

#ifdef FILTER
void main()
{
    ivec2 texel = ivec2(gl_FragCoord.xy);
    float own = find_end(2 * texel + 1);
    out_ends = vec2(0.0, own);
    out_clouds = join_four(u_clouds, u_clouds_ends, texel, vec2(0.5), own);
}
#else
void main()
{
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    float own = find_end(pixel);
    out_clouds = vec4(0.0);
    bool is_cloudy = texelFetch(u_hidden, pixel / SQUARE, 0).x > 0.0;
    if (is_cloudy && u_sharp < 1.0) {
        ivec2 first = (pixel + 1) / 2 - 1;
        vec2 part = 0.5 * vec2(pixel - 2 * first - 1);
        out_clouds += (1.0 - u_sharp) * join_four(u_joined, u_ends, first, part, own);
    }
    if (is_cloudy && u_sharp > 0.0) {
        ivec2 first = pixel / 2;
        vec2 part = 0.5 * vec2(pixel - 2 * first);
        out_clouds += u_sharp * join_four(u_clouds, u_clouds_ends, first, part, own);
    }
}
#endif
#endif
