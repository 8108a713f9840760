// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Begins the march along the rays of a coarse grid over the picture: nothing is summed yet, and
// alpha is how far the ray is looked at, m: to the farthest ground of the pixels around it, or
// SKY where one of them is sky.
// validate: SURFACE

#include "sky/ray.glsl"

in vec2 v_uv;

#ifdef SURFACE
uniform sampler2D u_position; // xyz relative to the camera, m; w altitude, m, or below -1e8
uniform vec2 u_grid;          // cells of the grid
#endif

layout(location = 0) out vec4 out_lit;
layout(location = 1) out vec4 out_all;
layout(location = 2) out vec4 out_first; // of steps that are still to come
layout(location = 3) out vec4 out_second;

const float SKY = 1.0e30;

float find_reach()
{
#ifdef SURFACE
    ivec2 size = textureSize(u_position, 0);
    ivec2 first = ivec2(floor(gl_FragCoord.xy - 0.5) * vec2(size) / u_grid);
    ivec2 last = min(ivec2(ceil((gl_FragCoord.xy + 0.5) * vec2(size) / u_grid)), size);
    float reach = 0.0;
    for (int y = first.y; y < last.y; y++) {
        for (int x = first.x; x < last.x; x++) {
            vec4 position = texelFetch(u_position, ivec2(x, y), 0);
            reach = max(reach, position.w > -1.0e8 ? length(position.xyz) : SKY);
        }
    }
    return reach;
#else
    return SKY; // the sphere ends rays by itself
#endif
}

void main()
{
    out_lit = vec4(0.0, 0.0, 0.0, find_reach());
    out_all = vec4(0.0);
    out_first = vec4(0.0);
    out_second = vec4(0.0);
}
