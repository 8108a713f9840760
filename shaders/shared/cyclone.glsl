// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// The cover of a tropical cyclone: an eye, the ring of dense cloud around it, and two bands that
// wind outward as logarithmic spirals, which cross circles at the same angle everywhere. `x` is the
// distance from its centre in parts of its radius, `turn` the angle around it in its sense of
// turning, `eye` the radius of the eye in the same parts, `noise` in [0, 1] and 0.5 in the mean.
// Shapes are set by eye to photographs from orbit; the angle is that of bands seen by radar, 10 to
// 25 degrees (Willoughby 1978, J. Geophys. Res. 83); that of real bands changes with the distance
// (Yurchak 2019, doi 10.5772/intechopen.88683), here it does not. No wind is modelled.
#ifndef SHARED_CYCLONE_GLSL
#define SHARED_CYCLONE_GLSL

#include "shared/shared.glsl"

#define CYCLONE_COTANGENT 3.4 // of the angle between bands and circles, 16 degrees
// Turns of the noise's tile around the centre, a whole number, and tiles along a band for each
// factor of e in distance: streaks run along the bands.
#define CYCLONE_NOISE_TURNS 3.0
#define CYCLONE_NOISE_TILES 0.45

SHARED_FN Number cyclone_step(Number from, Number to, Number x)
{
    Number t = shared_clamp((x - from) / (to - from), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Constant along a band.
SHARED_FN Angle cyclone_phase(Number x, Angle turn)
{
    return turn + CYCLONE_COTANGENT * log(shared_max(x, 1.0e-4));
}

// The part of a place that has the cyclone's own cover.
SHARED_FN Number cyclone_share(Number x, Angle phase, Number eye, Number noise)
{
    Number lump = noise - 0.5;
    Number inner = 1.0 - cyclone_step(0.2, 0.5, x + 0.35 * lump);
    Number outer = 1.0 - cyclone_step(0.45, 1.0, x + 0.3 * lump);
    Number band = 0.5 + 0.5 * cos(2.0 * phase) + 1.3 * lump;
    Number arms = outer * cyclone_step(0.15, 0.9, band);
    return shared_max(inner, arms) * cyclone_step(0.75 * eye, 1.05 * eye, x);
}

// What is left there of the cover around: between the bands air sinks, in the eye most.
SHARED_FN Number cyclone_rest(Number x, Number eye)
{
    return (0.35 + 0.65 * cyclone_step(0.5, 1.1, x)) *
           (0.1 + 0.9 * cyclone_step(eye, 1.5 * eye, x));
}

#endif // SHARED_CYCLONE_GLSL
