// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_TONE_GLSL
#define SHARED_TONE_GLSL
// From exposed light to a display: what a camera's meter, its film and its print do.
//
// `x` is exposed luminance: L / (1.2 * 2^EV100), so that 1 is where a sensor of ISO 12232
// saturates. A meter of ISO 2720 (K = 12.5 cd s m^-2) puts the mean of a scene at L = 0.125 *
// 2^EV100, that is x = 0.104. Both curves map that mean to 0.18, the reflectance of a grey card,
// and approach 1 without reaching it. Range: x >= 0, finite.

#include "shared/shared.glsl"

#define TONE_SATURATION_PER_EV0 1.2   // cd m^-2 that are mapped to x = 1 at EV100 = 0
#define TONE_LOG2_MEAN_PER_EV0 (-3.0) // log2 of 0.125 cd m^-2, the metered mean at EV100 = 0

// x^c / (x^c + k) with c = 3/2, the contrast of the middle tones, and k such that 0.125 / 1.2
// becomes 0.18. The same form describes how receptors respond (Naka and Rushton 1966): a toe, a
// nearly straight middle in log x, a long shoulder. The power is one square root, a fraction of
// what pow costs.
#define TONE_FILMIC_K 0.15316
SHARED_FN Number tone_filmic(Number x)
{
    Number powered = x * sqrt(x);
    return powered / (powered + TONE_FILMIC_K);
}

// 1 - exp(-E I), Elek 2010 Section 5, E such that 0.125 / 1.2 becomes 0.18.
#define TONE_EXPONENTIAL_E 1.90513
SHARED_FN Number tone_exponential(Number x)
{
    return 1.0 - exp(-TONE_EXPONENTIAL_E * x);
}

// How far a highlight has bleached toward white: 1 % at x = 0.9, half at 19, 90 % at 150. Colours
// below saturation keep their hue and their saturation, the glow around a low sun goes from orange
// through yellow to white.
SHARED_FN Number tone_bleach(Number x)
{
    Number share = x / (x + 8.0);
    return share * share;
}

// The display's code value in [0, 1] of linear light in [0, 1], IEC 61966-2-1.
SHARED_FN Number tone_srgb_encode(Number linear_light)
{
    Number toe = 12.92 * linear_light;
    Number curve = 1.055 * pow(shared_max(linear_light, 1.0e-6), 1.0 / 2.4) - 0.055;
    return linear_light <= 0.0031308 ? toe : curve;
}

// The dither is an additive recurrence on the plastic number: its inverse and the inverse of its
// square, times 2^32. The noise has little power at low frequencies.
#define TONE_NOISE_X 3242174889u
#define TONE_NOISE_Y 2447445414u

#endif // SHARED_TONE_GLSL
