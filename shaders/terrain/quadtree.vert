// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Vertices of the quadtree's squares, an instance each. A vertex lies between three grids: that of
// its square, of the parent, and of the parent's parent. Where a coarser square is next to the
// border, every second vertex of it gives way to the one before.
#include "terrain/depth.glsl"

layout(location = 0) in vec3 a_place;  // column and row; of a curtain: 1 its upper end, 2 its foot
layout(location = 1) in vec3 a_origin; // of positions, relative to the camera, planet axes, m
layout(location = 2) in vec3 a_down;
layout(location = 3) in vec4 a_lod; // at the corners, 2: its own grid
layout(location = 4) in vec2 a_slot;
layout(location = 5) in vec4 a_coarser; // 1 beyond the west, east, south, north border

uniform highp sampler2D u_vertices;
uniform mat3 u_view; // rows right / tan, up / tan, forward

out vec4 v_position; // relative to the camera; altitude

const float CELLS = 16.0;
// Behind all ground, and just before what was cleared.
const float CURTAIN_DEPTH = TRL_CLIP_CONTROL == 1 ? 1e-20 : -1.0 + 1e-6;

void main()
{
    vec2 place = a_place.xy;
    vec2 low = 1.0 - step(0.5, place);
    vec2 high = step(CELLS - 0.5, place);
    vec2 is_at_coarser = low.yx * a_coarser.zx + high.yx * a_coarser.wy; // borders along x, y
    place -= mod(place, 2.0) * is_at_coarser;

    vec2 t = place / CELLS;
    vec2 sides = mix(a_lod.xz, a_lod.yw, t.x);
    float lod = mix(sides.x, sides.y, t.y);
    ivec2 texel = ivec2(a_slot + place + 0.5);
    vec4 own = texelFetch(u_vertices, texel, 0);
    vec4 parents = texelFetch(u_vertices, texel + ivec2(17, 0), 0);
    vec4 next = texelFetch(u_vertices, texel + ivec2(34, 0), 0);
    vec4 p = mix(mix(next, parents, min(lod, 1.0)), own, max(lod - 1.0, 0.0));

    v_position = vec4(p.xyz + a_origin + max(a_place.z - 1.0, 0.0) * a_down, p.w);
    gl_Position = depth_clip(u_view * v_position.xyz);
    if (a_place.z > 0.5) {
        gl_Position.z = CURTAIN_DEPTH * gl_Position.w;
    }
}
