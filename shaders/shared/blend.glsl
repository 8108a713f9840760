// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_BLEND_GLSL
#define SHARED_BLEND_GLSL
// How a layer of the surface is laid over those below it. Values are metres, or parts of 1 for
// pictures and masks; `weight` is 0 where the layer is not, 1 where it is, between in its feather.
#include "shared/shared.glsl"

#define BLEND_OVER 0.0
#define BLEND_ADD 1.0
#define BLEND_MULTIPLY 2.0
#define BLEND_MAX 3.0
#define BLEND_MIN 4.0

// Whether a layer holds what changes those below, and no heights of its own; whether that is a
// factor.
SHARED_FN bool blend_is_change(Number mode)
{
    return mode > 0.5 && mode < 2.5;
}

SHARED_FN bool blend_is_factor(Number mode)
{
    return mode > 1.5 && mode < 2.5;
}

SHARED_FN Number blend_whole(Number mode, Number below, Number value)
{
    Number extreme = mode < 3.5 ? shared_max(below, value) : shared_min(below, value);
    Number combined = mode < 1.5 ? below + value : (mode < 2.5 ? below * value : extreme);
    return mode < 0.5 ? value : combined;
}

SHARED_FN Number blend_layers(Number mode, Number below, Number value, Number weight)
{
    return below + weight * (blend_whole(mode, below, value) - below);
}

// The slope of that, without the weight's own: from the slopes of both.
SHARED_FN Number blend_slope(Number mode, Number below, Number value, Number below_slope,
                             Number slope)
{
    Number product = below_slope * value + below * slope;
    bool is_value = mode < 3.5 ? value > below : value < below;
    Number extreme = is_value ? slope : below_slope;
    Number combined = mode < 1.5 ? below_slope + slope : (mode < 2.5 ? product : extreme);
    return mode < 0.5 ? slope : combined;
}

// What changes nothing, for gaps of a layer; those of the modes that take `below` itself get it.
SHARED_FN Number blend_neutral(Number mode, Number below)
{
    return blend_is_change(mode) ? (blend_is_factor(mode) ? 1.0 : 0.0) : below;
}

#endif // SHARED_BLEND_GLSL
