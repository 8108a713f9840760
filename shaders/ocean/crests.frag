// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// One texel a vertex of the sea's mesh, a column a spoke, a row a ring: where the waves that its
// cells resolve have moved it.
#include "ocean/grid.glsl"
#include "ocean/waves.glsl"

uniform sampler2D u_shore; // of shore.frag

layout(location = 0) out vec4 o_place;  // relative to the eye, axes of the anchor, m; altitude
layout(location = 1) out vec4 o_normal; // of these waves, axes of the anchor; part that is sea

void main()
{
    vec2 vertex = floor(gl_FragCoord.xy);
    SeaGrid grid = sea_grid();
    float radius = sea_grid_radius(grid, vertex.y);
    float azimuth = sea_grid_azimuth(grid, vertex.x);
    vec3 local = sea_grid_local(radius, azimuth, u_wave_range.x);
    GerstnerPlace p = gerstner_place(local.x, local.y, u_wave_range.x + local.z);

    vec2 shore = textureLod(u_shore, (0.5 * vertex + 0.5) / vec2(textureSize(u_shore, 0)), 0.0).xy;
    float open = smoothstep(0.5, 1.0, shore.x);
    float shown = open * sea_grid_shown(grid, length(vec2(radius, u_sea_eye.y)));

    vec2 outward = vec2(sin(azimuth), cos(azimuth));
    float along = SEA_GRID_WINDOW * sea_grid_long(grid, radius);
    float across = SEA_GRID_WINDOW * sea_grid_wide(grid, radius);
    WavesWindow window = WavesWindow(outward * along, vec2(outward.y, -outward.x) * across,
                                     min(along, across), shore.y);
    GerstnerSum sum = waves_sum(p, window);
    sum.x *= shown;
    sum.y *= shown;
    sum.z = sea_grid_bowl(sum.z * shown, radius, u_sea_eye.y);
    sum.gx *= shown;
    sum.gy *= shown;
    sum.xx *= shown;
    sum.xy *= shown;
    sum.yy *= shown;

    GerstnerNormal moved = gerstner_to_anchor(p, sum.x, sum.y, sum.z);
    GerstnerNormal n = gerstner_normal(sum);
    GerstnerNormal turned = gerstner_to_anchor(p, n.x, n.y, n.z);
    o_place = vec4(local + vec3(moved.x, moved.y, moved.z) - vec3(0.0, 0.0, u_sea_eye.y), sum.z);
    o_normal = vec4(normalize(vec3(turned.x, turned.y, turned.z)), open);
}
