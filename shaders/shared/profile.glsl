// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Density profiles: how much of a constituent there is at an altitude, relative to its reference
// density. Quantities: altitude above the reference sphere, scale height, centre and half width in
// metres. Valid for any altitude, scale height > 0, half width > 0. Compiled as C and as GLSL.
#ifndef SHARED_PROFILE_GLSL
#define SHARED_PROFILE_GLSL

#include "shared/shared.glsl"

// Barometric formula of an isothermal gas: 1 at the reference sphere.
SHARED_FN Number profile_exponential(Length altitude, Length scale_height)
{
    return exp(-altitude / scale_height);
}

// 1 at the centre, falling linearly to 0 at centre -+ half_width: a layer, such as ozone.
SHARED_FN Number profile_tent(Length altitude, Length centre, Length half_width)
{
    Number offset = (altitude - centre) / half_width;
    Number distance_out = offset < 0.0 ? -offset : offset;
    return distance_out < 1.0 ? 1.0 - distance_out : 0.0;
}

#endif
