// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_HEMISPHERE_GLSL
#define SHARED_HEMISPHERE_GLSL
// The grid of Michelic 2019, Section 3, with a warp before its Eq. 2, and the square map of the
// terrain shadow. Local frame: x east, y north, z up at the anchor. Directions are given as their
// difference from the anchor's, (0, 0, 1): near the anchor that keeps all digits of a float.
#include "shared/shared.glsl"

SHARED_STRUCT(LocalDirection)
{
    Number x, y, z; // unit direction - (0, 0, 1)
};

// How square rings |max(gx, gy)| = m of the grid move: beyond m = inner each is larger than the
// last by the same factor, to 1 at 1, so that cells have one size as seen from the middle; within,
// by the power. Continuous with the first derivative. inner in (0, 1], power >= 1; power = inner =
// 1 leaves them as they are.
SHARED_STRUCT(HemisphereRings)
{
    Number inner, power;
};

// The factor for gx and gy.
SHARED_FN Number hemisphere_warp(Number gx, Number gy, HemisphereRings rings)
{
    Number ring = shared_max(shared_max(shared_abs(gx), shared_abs(gy)), 1e-6);
    Number outer = shared_max(ring, rings.inner);
    Number within = shared_min(ring, rings.inner) / rings.inner;
    return exp((outer - 1.0) * rings.power / rings.inner) / outer * pow(within, rings.power - 1.0);
}

// Eq. 1 and 2 with n = 4: the grid point (gx, gy) in [-1, 1]^2, lifted to the approximate
// hemisphere and by `lift` (z_s, Eq. 3), seen from the planet's centre.
SHARED_FN LocalDirection hemisphere_direction(Number gx, Number gy, HemisphereRings rings,
                                              Number lift)
{
    Number warp = hemisphere_warp(gx, gy, rings);
    Number x = gx * warp;
    Number y = gy * warp;
    Number z = (1.0 - x * x * x * x) * (1.0 - y * y * y * y) + lift;
    Number flat2 = x * x + y * y;
    Number size = sqrt(flat2 + z * z);
    LocalDirection d;
    d.x = x / size;
    d.y = y / size;
    d.z = -flat2 / (size * (size + z)); // z / size - 1 without cancellation
    return d;
}

// Square rings of the shadow map move to m^power: cells shrink toward the middle in proportion to
// the distance from it. Returns the factor for gx and gy. power >= 1.
SHARED_FN Number shadow_map_warp(Number gx, Number gy, Number power)
{
    Number ring = shared_max(shared_abs(gx), shared_abs(gy));
    return pow(shared_max(ring, 1e-6), power - 1.0);
}

// Stereographic square of the shadow map: the side's middle is `extent` = tan(angle / 2) away.
SHARED_FN LocalDirection shadow_map_direction(Number gx, Number gy, Number power, Number extent)
{
    Number warp = shadow_map_warp(gx, gy, power) * extent;
    Number x = gx * warp;
    Number y = gy * warp;
    Number t2 = x * x + y * y;
    LocalDirection d;
    d.x = 2.0 * x / (1.0 + t2);
    d.y = 2.0 * y / (1.0 + t2);
    d.z = -2.0 * t2 / (1.0 + t2);
    return d;
}

// Its inverse as a factor: grid coordinates are (x, y) times this, for a direction of any length
// (x, y, z) with x, y, z + 1 in the local frame.
SHARED_FN Number shadow_map_scale(LocalDirection d, Number power, Number extent)
{
    Number up = 1.0 + d.z;
    Number stereo = 1.0 / ((sqrt(d.x * d.x + d.y * d.y + up * up) + up) * extent);
    Number ring = shared_max(shared_max(shared_abs(d.x), shared_abs(d.y)) * stereo, 1e-30);
    return stereo * pow(ring, 1.0 / power - 1.0);
}

#endif // SHARED_HEMISPHERE_GLSL
