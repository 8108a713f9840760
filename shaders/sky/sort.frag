// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What a pixel shows, as depth, so that each kind is drawn by a program of its own: 0 air in front
// of space, 1/2 nothing but space, 1 ground. With SURFACE the ground is where the position buffer
// has some, else where rays meet the reference sphere. With SEA ground is 7/8, and 1 where there is
// water in it.
// validate: SURFACE
// validate: SURFACE; SEA

#include "sky/ray.glsl"

in vec2 v_uv;

#ifdef SURFACE
uniform sampler2D u_position; // w: altitude, m, or below -1e8
#endif
#ifdef SEA
uniform sampler2D u_albedo; // a: part that is open water
#endif

void main()
{
    Ray ray = make_pixel_ray(v_uv);
#ifdef SURFACE
    bool is_ground = texelFetch(u_position, ivec2(gl_FragCoord.xy), 0).w > -1.0e8;
#else
    bool is_ground = ray.meets_ground;
#endif
    float ground = 1.0;
#ifdef SEA
    ground = texelFetch(u_albedo, ivec2(gl_FragCoord.xy), 0).a > 0.0 ? 1.0 : 0.875;
#endif
    gl_FragDepth = is_ground ? ground : (ray.chord_m > 0.0 ? 0.0 : 0.5);
}
