// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_DAYLIGHT_H
#define FRAME_DAYLIGHT_H
// What a scene's star does to white and to the bare ground, as an eye sees it.

#include "scatter/medium.h"

// Luminance, in cd m^-2, of a white Lambertian wall that faces the star above the atmosphere.
double daylight_wall_cd_m2(const struct medium *medium);

// The same as the meter counts it: without a star only lights at night remain, and those are dimmer
// than what stands here then.
double daylight_meter_wall_cd_m2(const struct medium *medium);

// The ground's albedo in linear sRGB, relative to white in the star's light; in [0, 1].
void daylight_ground_albedo(const struct medium *medium, float rgb[3]);

// The same of any albedo.
void daylight_albedo(const struct medium *medium, const struct spectrum *albedo, float rgb[3]);

// Linear sRGB relative to white in the star's light of a smooth spectrum with values at these
// wavelengths, two at least, evenly spaced: per value. Not clamped.
enum { DAYLIGHT_MAX_WEIGHTS = 48 };
void daylight_weights(const struct medium *medium, const double *nm, int count,
                      double rgb[3][DAYLIGHT_MAX_WEIGHTS]);

#endif // FRAME_DAYLIGHT_H
