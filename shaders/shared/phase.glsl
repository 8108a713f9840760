// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Phase functions: which share of scattered light goes into a direction, per steradian.
// Quantities: nu = cosine of the scattering angle (1 is straight on), g = mean of nu over the
// scattered light. Valid for nu in [-1, 1] and g in (-1, 1). Each integrates to 1 over the sphere.
// Compiled as C and as GLSL.
#ifndef SHARED_PHASE_GLSL
#define SHARED_PHASE_GLSL

#include "shared/shared.glsl"

#define PHASE_INV_4PI 0.079577471545947667884

// 1 / (4 pi)
SHARED_FN Number phase_isotropic(void)
{
    return PHASE_INV_4PI;
}

// 3 / (16 pi) (1 + nu^2): dipole scattering without depolarisation, Elek 2010 Eq. 4 over 4 pi.
SHARED_FN Number phase_rayleigh(Number nu)
{
    return 0.75 * PHASE_INV_4PI * (1.0 + nu * nu);
}

// Henyey and Greenstein 1941: (1 - g^2) / (4 pi (1 + g^2 - 2 g nu)^1.5). The bracket is written as
// (1 - |g|)^2 + 2 |g| (1 -+ nu), which does not cancel where a strong forward peak makes it small.
SHARED_FN Number phase_henyey_greenstein(Number nu, Number g)
{
    Number size = g < 0.0 ? -g : g;
    Number toward = g < 0.0 ? -nu : nu;
    Number base = (1.0 - size) * (1.0 - size) + 2.0 * size * (1.0 - toward);
    return PHASE_INV_4PI * (1.0 - g) * (1.0 + g) / (base * sqrt(base));
}

// Cornette and Shanks 1992, Elek 2010 Eq. 5 over 4 pi: Henyey-Greenstein times
// 3 (1 + nu^2) / (2 (2 + g^2)); its limit g = 0 is Rayleigh's.
SHARED_FN Number phase_cornette_shanks(Number nu, Number g)
{
    return phase_henyey_greenstein(nu, g) * 1.5 * (1.0 + nu * nu) / (2.0 + g * g);
}

#endif
