// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Open water at every second vertex of the sea's grid: x = part of the surface, y = depth, m.
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0
// validate: ELEVATION_COUNT 4; COLOUR_COUNT 4; WATER_COUNT 4; LIGHTS_COUNT 4; HAS_DEPTH
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 1; WATER_COUNT 2; LIGHTS_COUNT 0; HAS_POLAR; HAS_MODES
// validate: ELEVATION_COUNT 2; COLOUR_COUNT 2; WATER_COUNT 1; LIGHTS_COUNT 1; HAS_PAGES; HAS_DEPTH
// validate: ELEVATION_COUNT 1; COLOUR_COUNT 0; WATER_COUNT 1; LIGHTS_COUNT 0; HAS_NOISE; HAS_DEPTH
// validate: ELEVATION_COUNT 0; COLOUR_COUNT 0; WATER_COUNT 0; LIGHTS_COUNT 0; HAS_GROUND
#include "ocean/grid.glsl"
#include "shared/sea.glsl"
#include "terrain/layers.glsl"
#include "terrain/water.glsl"

#ifdef HAS_DEPTH
uniform float u_sea_depth; // code of the depth everywhere; below 0: there is none
#endif

layout(location = 0) out vec4 o_shore;

// Where no depth is told.
const float SHORE_DEEP_M = 1.0e4;

float shore_depth(float code)
{
    return code > 0.0 ? sea_code_depth(code) : SHORE_DEEP_M;
}

void main()
{
    vec2 vertex = 2.0 * floor(gl_FragCoord.xy);
    SeaGrid grid = sea_grid();
    float radius = sea_grid_radius(grid, vertex.y);
    vec3 local = sea_grid_local(radius, sea_grid_azimuth(grid, vertex.x), u_anchor.w);
    vec2 geo = geo_from_local(local, u_anchor.w);
    float footprint = log2(2.0 * max(sea_grid_long(grid, radius), sea_grid_wide(grid, radius)));
    vec2 water = terrain_water(ground_at(geo), footprint).xy;
    float depth = SHORE_DEEP_M;
#ifdef HAS_DEPTH
    depth = shore_depth(u_sea_depth < 0.0 ? water.y : u_sea_depth);
#endif
#ifdef HAS_GROUND
    vec3 at = ground_local(geo);
    Tangent t = tangent_at(at, geo, footprint);
    NoiseBase base = ground_base(t, footprint, 0.0);
    float below = u_noise_form.w - noise_compose(base, at * u_anchor.w, t.up).height;
    depth = below > 0.0 && water.x < 0.5 ? min(below, depth) : depth;
    water.x = max(water.x, step(0.0, below));
#endif
    o_shore = vec4(water.x, depth, 0.0, 0.0);
}
