// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_CUBIC_GLSL
#define SHARED_CUBIC_GLSL
// The cubic of Mitchell and Netravali 1988 with B = C = 1/3: smooth to the second order where it
// matters, nearly interpolating, hardly any ringing. t in [0, 1) is the place between texels 1 and
// 2 of four.
#include "shared/shared.glsl"

// A value between four can leave their range by this part of it: (sum of |weights| - 1) / 2 in two
// dimensions, largest at the middle (1.139^2).
#define CUBIC_OVERSHOOT 0.15

SHARED_FN Number cubic_weight_outer(Number x) // 1 <= x <= 2
{
    return ((-7.0 / 18.0 * x + 2.0) * x - 10.0 / 3.0) * x + 16.0 / 9.0;
}

SHARED_FN Number cubic_weight_inner(Number x) // 0 <= x <= 1
{
    return (7.0 / 6.0 * x - 2.0) * x * x + 8.0 / 9.0;
}

SHARED_FN Number cubic_blend(Number t, Number a, Number b, Number c, Number d)
{
    return a * cubic_weight_outer(1.0 + t) + b * cubic_weight_inner(t) +
           c * cubic_weight_inner(1.0 - t) + d * cubic_weight_outer(2.0 - t);
}

#endif // SHARED_CUBIC_GLSL
