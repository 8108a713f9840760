// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// The edge of a shadow whose distance is known along a way: how much of the star is seen at a
// point, and in the mean over a segment. A point's place is t: how far it is outside the line where
// half of the star is seen, in units of the penumbra's half width; -1 and below is dark, 1 and
// above is lit. In between the smooth step 3 u^2 - 2 u^3 of u = (t + 1) / 2, which has nearly the
// slope of a disc behind a straight edge (physics.md, "Shadows in the air").
#ifndef SHARED_PENUMBRA_GLSL
#define SHARED_PENUMBRA_GLSL

#include "shared/shared.glsl"

SHARED_FN Number penumbra_visible(Number t)
{
    Number u = shared_clamp(0.5 + 0.5 * t, 0.0, 1.0);
    return u * u * (3.0 - 2.0 * u);
}

// Its integral from -infinity to t.
SHARED_FN Number penumbra_integral(Number t)
{
    Number u = shared_clamp(0.5 + 0.5 * t, 0.0, 1.0);
    return u * u * u * (2.0 - u) + shared_max(t - 1.0, 0.0);
}

// The mean where t changes evenly from one value to another. Exactly 1 where both are lit.
SHARED_FN Number penumbra_mean(Number from, Number to)
{
    Number change = to - from;
    Number mean = shared_abs(change) < 0.02
                      ? penumbra_visible(0.5 * (from + to))
                      : (penumbra_integral(to) - penumbra_integral(from)) / change;
    return shared_min(from, to) >= 1.0 ? 1.0 : shared_clamp(mean, 0.0, 1.0);
}

#endif // SHARED_PENUMBRA_GLSL
