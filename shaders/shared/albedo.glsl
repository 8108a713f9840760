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

// The part of a place that is covered (by snow) where a larger area around it is covered by `share`
// and heights in it, `height` standard deviations above its mean, decide by `strength`; of their
// variance the part `hidden` is within the place. The mean over all places is the share again,
// where heights have a normal distribution: the logistic function of a normal variable, MacKay
// 1992, Neural Comput. 4, 720.
SHARED_FN Number albedo_cover(Number share, Number height, Number strength, Number hidden)
{
    Number s = shared_clamp(share, 0.003, 0.997);
    Number spread = SHARED_PI / 8.0 * strength * strength;
    Number level = log(s / (1.0 - s)) * sqrt(1.0 + spread) + strength * height;
    Number part = 1.0 / (1.0 + exp(-level / sqrt(1.0 + spread * hidden)));
    return shared_clamp((part - 0.01) / 0.98, 0.0, 1.0);
}

// The strength of heights of a deviation in m: on level ground they decide nothing.
SHARED_FN Number albedo_cover_strength(Length deviation)
{
    return 3.0 * deviation / (deviation + 100.0);
}

#endif // SHARED_ALBEDO_GLSL
