// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_SPLINE_GLSL
#define SHARED_SPLINE_GLSL
// The quadratic B-spline: three samples, a continuous slope, and never outside of them, since its
// weights are not negative. t in [-1/2, 1/2] is the place from the middle sample.
#include "shared/shared.glsl"

SHARED_FN Number spline_blend(Number t, Number a, Number b, Number c)
{
    return 0.5 * (0.5 - t) * (0.5 - t) * a + (0.75 - t * t) * b + 0.5 * (0.5 + t) * (0.5 + t) * c;
}

// Its derivative by t: linear between the differences of neighbours, and so never above them.
SHARED_FN Number spline_slope(Number t, Number a, Number b, Number c)
{
    return (0.5 - t) * (b - a) + (0.5 + t) * (c - b);
}

#endif // SHARED_SPLINE_GLSL
