// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds of every second pixel over a whole picture, in two passes. FILTER joins each four, whose
// rays begin their steps at different places, into one between them; without it each pixel takes of
// the four around it. Both take those whose rays end about where their own does, so that no cloud
// behind a ridge hangs before it.
// Where pixels are so wide that nothing is left to be spread, it takes what was marched.
// validate: SURFACE
// validate: SURFACE; FILTER

#include "sky/ray.glsl"

in vec2 v_uv;

uniform sampler2D u_clouds;
#ifndef FILTER
uniform sampler2D u_hidden; // of squares of pixels, see cloud/hidden.frag
const int SQUARE = 4;       // GPU_HIDE_SQUARE
uniform sampler2D u_joined;
uniform float u_sharp; // share of what was marched
#endif
#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
#endif

layout(location = 0) out vec4 out_clouds;

const float SKY_M = 1.0e8;

float find_end(ivec2 pixel)
{
#ifdef SURFACE
    vec4 position = texelFetch(u_position, pixel, 0);
    return position.w > -1.0e8 ? length(position.xyz) : SKY_M;
#else
    return 1.0;
#endif
}

// Of four from the first on; those of `offset` 0 stand at even pixels, of 1 at odd ones. Alike
// within some per cent counts as one surface; `alike` is the part of them that are.
vec4 join_four(sampler2D clouds, ivec2 pixel, int offset, bool is_mean, out float alike)
{
    ivec2 last = textureSize(clouds, 0) - 1;
#ifdef SURFACE
    ivec2 edge = textureSize(u_position, 0) - 1;
#else
    ivec2 edge = pixel;
#endif
    ivec2 first = (pixel + offset) / 2 - offset;
    vec2 part = is_mean ? vec2(0.5) : vec2(pixel - 2 * first - offset) * 0.5;
    float own = log(find_end(min(pixel, edge)));
    vec4 sum = vec4(0.0);
    float weights = 0.0;
    for (int n = 0; n < 4; n++) {
        ivec2 corner = ivec2(n & 1, n >> 1);
        ivec2 at = clamp(first + corner, ivec2(0), last);
        vec2 near = mix(1.0 - part, part, vec2(corner));
        float apart = abs(log(find_end(min(2 * at + offset, edge))) - own);
        float weight = (near.x * near.y + 1.0e-4) / (1.0 + 4.0e3 * apart * apart * apart);
        sum += texelFetch(clouds, at, 0) * weight;
        weights += weight;
    }
    alike = weights;
    return sum / weights;
}

#ifndef FILTER
// Of what a mean of four has over those around it, how much is added.
const float SHARPER = 1.0;

// The mean of fours at a pixel, between theirs.
vec4 find_joined(vec2 pixel)
{
    return textureLod(u_joined, 0.5 * pixel / vec2(textureSize(u_joined, 0)), 0.0);
}

// Means of fours are taken over four pixels, which takes the sharpness of edges; what each has over
// those around it gives some of it back. They have no spread of rays, so none comes back, and what
// stays between the least and the most of them makes no fringes.
vec4 sharpen(vec4 joined, vec2 pixel)
{
    vec4 west = find_joined(pixel - vec2(2.0, 0.0));
    vec4 east = find_joined(pixel + vec2(2.0, 0.0));
    vec4 south = find_joined(pixel - vec2(0.0, 2.0));
    vec4 north = find_joined(pixel + vec2(0.0, 2.0));
    vec4 least = min(min(min(west, east), min(south, north)), joined);
    vec4 most = max(max(max(west, east), max(south, north)), joined);
    vec4 over = joined - 0.25 * (west + east + south + north);
    return clamp(joined + SHARPER * over, least, most);
}
#endif

void main()
{
#ifdef FILTER
    float alike;
    out_clouds = join_four(u_clouds, 2 * ivec2(gl_FragCoord.xy) + 1, 0, true, alike);
#else
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    out_clouds = vec4(0.0);
    // Loops, since branches save nothing.
    bool is_cloudy = texelFetch(u_hidden, pixel / SQUARE, 0).x > 0.0;
    for (int once = 0; once < (is_cloudy && u_sharp < 1.0 ? 1 : 0); once++) {
        float alike;
        vec4 joined = join_four(u_joined, pixel, 1, false, alike);
        joined = alike < 0.9 ? joined : sharpen(joined, vec2(pixel));
        out_clouds += (1.0 - u_sharp) * joined;
    }
    for (int once = 0; once < (is_cloudy && u_sharp > 0.0 ? 1 : 0); once++) {
        float alike;
        out_clouds += u_sharp * join_four(u_clouds, pixel, 0, false, alike);
    }
#endif
}
