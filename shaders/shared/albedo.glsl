// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_ALBEDO_GLSL
#define SHARED_ALBEDO_GLSL
// Albedos of ground that is not alike everywhere. 0 to 1.
#include "shared/shared.glsl"

// The albedo of ground whose scattering is `paler` times (> 0) as strong relative to its
// absorption. Of a thick layer these are to each other as (1 - a)^2 / (2 a): Kubelka and Munk 1931,
// Z. tech. Phys. 12. Dark ground is nearly `paler` times as bright, snow hardly changes.
SHARED_FN Number albedo_varied(Number albedo, Number paler)
{
    Number a = shared_clamp(albedo, 1e-4, 1.0);
    Number ratio = (1.0 - a) * (1.0 - a) / (2.0 * a * paler);
    return 1.0 / (1.0 + ratio + sqrt(ratio * (ratio + 2.0)));
}

#endif // SHARED_ALBEDO_GLSL
