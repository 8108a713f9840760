// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Reflectance of a smooth boundary between clear media for unpolarised light (Fresnel; Born and
// Wolf, Principles of Optics, Section 1.5.2): the mean of both polarisations. No dimensions.
#ifndef SHARED_FRESNEL_GLSL
#define SHARED_FRESNEL_GLSL

#include "shared/shared.glsl"

// `cosine` of the angle of incidence, 0 to 1; `index` of what lies beyond relative to where the
// light comes from, above 0. 1 where all is reflected.
SHARED_FN Number fresnel_reflectance(Number cosine, Number index)
{
    Number c = shared_clamp(cosine, 0.0, 1.0);
    Number inside2 = index * index - 1.0 + c * c; // square of index times the cosine beyond
    Number g = sqrt(shared_max(inside2, 0.0));
    Number across = (c - g) / shared_max(c + g, 1.0e-9);
    Number along = (index * index * c - g) / shared_max(index * index * c + g, 1.0e-9);
    return inside2 > 0.0 ? 0.5 * (across * across + along * along) : 1.0;
}

#endif // SHARED_FRESNEL_GLSL
