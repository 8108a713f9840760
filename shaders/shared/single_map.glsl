// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Where a point, a ray and a star lie in the tables of the model `single` (Schafhitzel 2007,
// Section 4.1, with coordinates that put the texels where the light changes). C fills the tables,
// the sky pass looks them up. Coordinates are in [0, 1], lengths in m. Views are those of
// sky_map.glsl: sky_map_view for rays that miss the ground, sky_map_ground_row for those that meet
// it.
#ifndef SHARED_SINGLE_MAP_GLSL
#define SHARED_SINGLE_MAP_GLSL

#include "shared/shared.glsl"

// Distance to the horizon from an altitude: sqrt(r^2 - R^2) without cancellation.
SHARED_FN Length single_horizon(Length altitude, Length ground_radius)
{
    return sqrt(shared_max(altitude, 0.0) * (2.0 * ground_radius + altitude));
}

// The altitude coordinate: the distance to the horizon over that from the top, which is fine near
// the ground.
SHARED_FN Number single_height(Length horizon, Length longest)
{
    return shared_clamp(horizon / longest, 0.0, 1.0);
}

// Its inverse, without cancellation: h = x^2 L^2 / (r + R).
SHARED_FN Length single_altitude(Number height, Length ground_radius, Length longest)
{
    Length horizon = height * longest;
    Length radius = sqrt(ground_radius * ground_radius + horizon * horizon);
    return horizon * horizon / (radius + ground_radius);
}

#endif // SHARED_SINGLE_MAP_GLSL
