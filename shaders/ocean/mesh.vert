// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Vertices of the sea's mesh, from the textures that crests.frag drew.
#include "ocean/grid.glsl"
#include "terrain/depth.glsl"

uniform highp sampler2D u_crests, u_normals;
uniform mat3 u_planet_from_local;
uniform mat3 u_view; // rows right / tan, up / tan, forward; planet axes
uniform float u_planet_radius;

out vec4 v_position; // relative to the eye, planet axes, m; altitude
out vec3 v_level;    // the place that was moved there
out vec4 v_normal;   // planet axes; part that is sea

void main()
{
    int side = textureSize(u_crests, 0).x;
    int ring = gl_VertexID / side;
    ivec2 vertex = ivec2(gl_VertexID - ring * side, ring);
    vec4 place = texelFetch(u_crests, vertex, 0);
    vec4 normal = texelFetch(u_normals, vertex, 0);
    SeaGrid grid = sea_grid();
    vec3 level = sea_grid_local(sea_grid_radius(grid, float(ring)),
                                sea_grid_azimuth(grid, float(vertex.x)), u_planet_radius);
    v_position = vec4(u_planet_from_local * place.xyz, place.w);
    v_level = u_planet_from_local * (level - vec3(0.0, 0.0, u_sea_eye.y));
    v_normal = vec4(u_planet_from_local * normal.xyz, normal.w);
    gl_Position = depth_clip(u_view * v_position.xyz);
}
