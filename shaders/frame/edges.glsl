// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Edges between what is near and what is far behind it. With SURFACE the ground comes from the
// surface buffers, else it is the bare reference sphere.
#ifndef FRAME_EDGES_GLSL
#define FRAME_EDGES_GLSL

#ifndef SURFACE
#include "sky/ray.glsl"
#endif

uniform vec2 u_size; // of the picture

ivec2 inside(ivec2 pixel)
{
    return clamp(pixel, ivec2(0), ivec2(u_size) - 1);
}

// Of a pixel, 1 over the distance to the ground; 0 is sky. The bare sphere has no edge but the
// horizon: there it is 1.
#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8

float nearness(ivec2 pixel)
{
    vec4 position = texelFetch(u_position, inside(pixel), 0);
    return position.w > -1.0e8 ? inversesqrt(max(dot(position.xyz, position.xyz), 1.0e-8)) : 0.0;
}
#else
Ray ray_of(ivec2 pixel)
{
    return make_pixel_ray((vec2(pixel) + 0.5) / u_size);
}

float nearness(ivec2 pixel)
{
    return ray_of(inside(pixel)).meets_ground ? 1.0 : 0.0;
}
#endif

// Between the middle two of four pixels in a row. Along a plane nearness is linear, however fast it
// changes: an edge is where it jumps.
bool is_edge(float a, float b, float c, float d)
{
#ifdef SURFACE
    float jump = abs(b - c);
    float least = min(b, c);
    bool leaps = jump > 0.1 * least && jump > 2.0 * max(abs(a - b), abs(c - d));
    return jump > 0.0 && (least <= 0.0 || leaps);
#else
    return b != c;
#endif
}

bool is_edge_between(ivec2 pixel, ivec2 step)
{
    return is_edge(nearness(pixel - step), nearness(pixel), nearness(pixel + step),
                   nearness(pixel + 2 * step));
}

#endif // FRAME_EDGES_GLSL
