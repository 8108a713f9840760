// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_BIOME_GLSL
#define SHARED_BIOME_GLSL
// Which biome a place belongs to, from its altitude, slope, latitude, temperature and moisture.
#include "shared/shared.glsl"

// Part of a biome: 1 between the ends of its range, 0 outside, smooth over `feather` around both.
SHARED_FN Number biome_within(Number x, Number low, Number high, Number feather)
{
    Number a = shared_clamp((x - low) / feather + 0.5, 0.0, 1.0);
    Number b = shared_clamp((high - x) / feather + 0.5, 0.0, 1.0);
    return a * a * (3.0 - 2.0 * a) * b * b * (3.0 - 2.0 * b);
}

// Mean over the year in degrees Celsius: as the squared sine of the latitude falls off the light,
// and by a lapse rate in degrees per m.
SHARED_FN Number biome_temperature(Number equator, Number pole, Number sin_latitude)
{
    return equator + (pole - equator) * sin_latitude * sin_latitude;
}

// Borders are frayed by the relief's tone, by a part of the feather.
SHARED_FN Number biome_fray(Number x, Number feather, Number tone)
{
    return x + 0.5 * feather * tone;
}

#endif // SHARED_BIOME_GLSL
