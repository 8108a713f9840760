// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Places of the sea's grid. The C side is src/ocean/sea_mesh.c.
#include "shared/sea_grid.glsl"

uniform vec4 u_sea_grid; // inner, growth, begin, step of SeaGrid
uniform vec4
    u_sea_eye; // reach of SeaGrid; height of the eye above level water, m; where the middle
               // of the rings lies from below the eye, m

SeaGrid sea_grid()
{
    return SeaGrid(u_sea_grid.x, u_sea_grid.y, u_sea_grid.z, u_sea_grid.w, u_sea_eye.x);
}

// Of level water `radius` m away along the ground, less the place below the eye; axes of the
// anchor. Series, since a float of a planet's radius holds half a metre: within 1 mm at 100 km.
vec3 sea_grid_local(float radius, float azimuth, float planet_m)
{
    float angle = radius / planet_m;
    float a2 = angle * angle;
    float flat_m = radius * (1.0 - a2 * (1.0 / 6.0 - a2 * (1.0 / 120.0)));
    float down_m = 0.5 * radius * angle * (1.0 - a2 * (1.0 / 12.0));
    return vec3(flat_m * sin(azimuth) + u_sea_eye.z, flat_m * cos(azimuth) + u_sea_eye.w, -down_m);
}
