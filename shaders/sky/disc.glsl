// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The star's disc before the air.
#ifndef SKY_DISC_GLSL
#define SKY_DISC_GLSL

#include "sky/ray.glsl"

// Radiance per unit irradiance of the star, sr^-1. Limb darkening of a grey atmosphere in radiative
// equilibrium (Eddington): (2 + 3 cos) / 5, here relative to its mean over the disc, 4/5. The edge
// is as soft as a pixel.
float star_disc(Ray ray)
{
    float from_centre = length(cross(ray.direction, u_sun)) / u_disc.y;
    float edge = u_disc.z / u_disc.y;
    float inside = ray.nu > 0.0 ? clamp((1.0 - from_centre) / edge + 0.5, 0.0, 1.0) : 0.0;
    float cosine = sqrt(max(1.0 - from_centre * from_centre, 0.0));
    return inside * (0.5 + 0.75 * cosine) / (SHARED_PI * u_disc.y * u_disc.y);
}

#endif // SKY_DISC_GLSL
