// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// How much of a star's disc is seen beside the disc of a body before it. Both discs are small and
// taken as flat, the star's as uniform (physics.md, "Eclipses"). Angles in units of the star's
// radius.
#ifndef SHARED_ECLIPSE_GLSL
#define SHARED_ECLIPSE_GLSL

#include "shared/shared.glsl"

// Area of a circle of radius 1 beyond a chord that is seen under twice this angle from the centre:
// a - sin(a) cos(a), without the difference where it would be lost.
SHARED_FN Number eclipse_segment(Angle a)
{
    Number square = a * a;
    return a < 0.1 ? square * a * (2.0 / 3.0 - square * (2.0 / 15.0 - square * (4.0 / 315.0)))
                   : a - sin(a) * cos(a);
}

// Visible part of the star, 0 to 1: `apart` between the centres, `radius` of the body. Exactly 1
// where the discs do not touch and exactly 0 where the star is covered.
SHARED_FN Number eclipse_visible(Number apart, Number radius)
{
    Number d = shared_max(apart, 1.0e-6);
    // Of the chord through both crossings: distance from the star's centre, and half its length.
    Number from_star = 0.5 * (d + (1.0 - radius) * (1.0 + radius) / d);
    Number square = (d + 1.0 + radius) * (d + 1.0 - radius) * (d - 1.0 + radius) *
                    (1.0 + radius - d) / (4.0 * d * d);
    Number chord = sqrt(shared_max(square, 0.0));
    Number covered = eclipse_segment(shared_atan2(chord, from_star)) +
                     radius * radius * eclipse_segment(shared_atan2(chord, d - from_star));
    Number crossing = shared_clamp(1.0 - covered / SHARED_PI, 0.0, 1.0);
    Number within = radius < 1.0 ? 1.0 - radius * radius : 0.0;
    return apart >= 1.0 + radius ? 1.0 : (apart <= shared_abs(radius - 1.0) ? within : crossing);
}

// The same at a place in the body's shadow: `across` from the axis through the body's centre away
// from the star, `along` behind the centre, both in m; radii of the body in m and of the star in
// rad.
SHARED_FN Number eclipse_shadow(Length across, Length along, Length radius_m, Angle star_rad)
{
    Length away = sqrt(across * across + along * along);
    Angle body = asin(shared_min(radius_m / shared_max(away, radius_m), 1.0));
    Angle apart = shared_atan2(across, along);
    return eclipse_visible(apart / star_rad, body / star_rad);
}

// Radiance of the Sun's corona at `apart` from its centre, 1 and more, relative to the mean over
// the disc: the fit known as Baumbach's. Its first term is light from dust (F), the others from
// electrons (K); physics.md tells how well other measurements agree.
SHARED_FN Number eclipse_corona(Number apart)
{
    Number i = 1.0 / shared_max(apart, 1.0);
    Number i2 = i * i;
    Number i7 = i2 * i2 * i2 * i;
    return 1.0e-6 * (0.0532 * i2 * sqrt(i) + i7 * (1.425 + 2.565 * i7 * i2 * i));
}

#endif // SHARED_ECLIPSE_GLSL
