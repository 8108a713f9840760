// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_GROUND_LIGHT_H
#define SKY_GROUND_LIGHT_H
// Tables of the light that falls on the ground, over the star's zenith angle and the ground's
// altitude (uniform from 0 to the highest), in four bands per unit irradiance of the star.

#include "scatter/atmosphere.h"

enum { GROUND_LIGHT_SUNS = 256, GROUND_LIGHT_ALTITUDES = 16 };

// Direct light, by the coordinate sky_map_sunlight: [altitude][GROUND_LIGHT_SUNS][BAND_COUNT].
void ground_light_of_star(const struct atmosphere *atmosphere, double highest_m, float *texels);

// Logarithm of the irradiance of level ground by the sky, by the sun grid of the moments:
// [altitude][suns][BAND_COUNT].
void ground_light_of_sky(const struct atmosphere *atmosphere, double highest_m, float *texels);

// The same of the light that rises there in the solved atmosphere, whose ground is the sphere.
void ground_light_from_below(const struct atmosphere *atmosphere, double highest_m, float *texels);

// Logarithm of the mean radiance of all directions but the star's, over the mean of what two even
// halves of the sky with both irradiances have: above 1 where light comes from the horizon.
void ground_light_evenness(const struct atmosphere *atmosphere, double highest_m, float *texels);

// How much brighter it is toward the star than across: with x the part of a direction that points
// horizontally toward the star, the first moment's s x of all directions, those from below too, in
// units of the mean radiance of the sky. Not a logarithm. Forward peaks that count as not scattered
// are not in it, but in the star's light.
void ground_light_slope(const struct atmosphere *atmosphere, double highest_m, float *texels);

#endif // SKY_GROUND_LIGHT_H
