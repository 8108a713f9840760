// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_RAYLEIGH_GLSL
#define SHARED_RAYLEIGH_GLSL
// Single scattering in a gas whose density falls exponentially, after Santana 2017. A straight line
// is seen in its own plane (his Eq. 7): X along it, in the direction of sight, from the point that
// is closest to the planet's centre. With the radius r of a point, cos(phi) = X / r (Section 5).
//
//     g(phi, h)  column from the line's far beginning, X = -infinity, to a point, in m of gas as
//                dense as at the reference sphere (Section 6)
//
// `excess` is r^2 - R^2 of a point, from which its altitude follows without cancellation; at X it
// is that of the closest point plus X^2. docs/physics.md has the derivations.
#include "shared/shared.glsl"

SHARED_STRUCT(RayleighAir)
{
    Length ground_m; // radius R of the reference sphere
    Length height_m; // of the air
    Length scale_m;  // scale height of its density
    Number softness; // of rayleigh_map_x
};

SHARED_FN Area rayleigh_excess(RayleighAir air, Length altitude)
{
    return altitude * (2.0 * air.ground_m + altitude);
}

SHARED_FN Length rayleigh_altitude(RayleighAir air, Area excess)
{
    return excess / (air.ground_m + sqrt(shared_max(air.ground_m * air.ground_m + excess, 0.0)));
}

// Relative to that at the reference sphere. Deep pits are as dense as at ten scale heights.
SHARED_FN Number rayleigh_density(RayleighAir air, Length altitude)
{
    return exp(shared_min(-altitude / air.scale_m, 10.0));
}

// Where g is kept. The map holds the inverse air mass: the column straight up over that along the
// line, 1 at the zenith. x runs from the horizon to the zenith and spreads the horizon; y from the
// sphere to the air's top, where the inverse goes as the root of what is left above.
SHARED_FN Number rayleigh_map_x(Number cosine, Number softness)
{
    return cosine * (1.0 + softness) / (cosine + softness);
}

SHARED_FN Number rayleigh_map_cosine(Number x, Number softness)
{
    return x * softness / (1.0 + softness - x);
}

SHARED_FN Number rayleigh_map_y(Length altitude, Length height)
{
    return 1.0 - sqrt(shared_clamp(1.0 - altitude / height, 0.0, 1.0));
}

SHARED_FN Length rayleigh_map_altitude(Number y, Length height)
{
    return height * (1.0 - (1.0 - y) * (1.0 - y));
}

// The column of a line that comes from above, by the inverse air mass; 0 above the air.
SHARED_FN Length rayleigh_column(RayleighAir air, Length altitude, Number inverse)
{
    Number above = 1.0 - exp(shared_min((altitude - air.height_m) / air.scale_m, 0.0));
    return air.scale_m * rayleigh_density(air, altitude) * above / shared_max(inverse, 1.0e-6);
}

// A fit of the inverse air mass at one height: a polynomial in x.
SHARED_STRUCT(RayleighFit)
{
    Number c0, c1, c2, c3, c4, c5, c6, c7;
};

SHARED_FN Number rayleigh_fit_value(RayleighFit f, Number x)
{
    return f.c0 +
           x * (f.c1 + x * (f.c2 + x * (f.c3 + x * (f.c4 + x * (f.c5 + x * (f.c6 + x * f.c7))))));
}

// Symmetry 4: beyond its closest point a line has gone through both halves less what is still to
// come.
SHARED_FN Length rayleigh_beyond(Length closest, Length mirrored)
{
    return 2.0 * closest - mirrored;
}

// Altitude of the closest point of a line through a point: r^2 sin(phi)^2 = r^2 - (r cos(phi))^2.
SHARED_FN Length rayleigh_closest(RayleighAir air, Area excess, Length along)
{
    return rayleigh_altitude(air, excess - along * along);
}

// The column between two points is the difference of two g. On a short way that cancels; but the
// column also lies between the way times the least and times the largest density on it, which is
// as good as exact where the way is short.
SHARED_FN Length rayleigh_between(Length difference, Length way, Number thin, Number thick)
{
    return shared_clamp(difference, way * thin, way * thick);
}

// A line of sight between two X, with the star: nu is the cosine of the angle between them.
SHARED_STRUCT(RayleighLine)
{
    Length begin, end; // X
    Area excess;       // of the closest point
    Number nu;
    Length sun_distance; // of the closest point from the terminator's plane, toward the star
};

// The part of the line in the shadow, which is a cylinder behind the planet (Section 2). Nothing
// when to <= from.
SHARED_STRUCT(RayleighShadow)
{
    Length from, to; // X
};

// A point at X is `X nu + sun_distance` above the terminator's plane, and its square distance from
// the axis of the shadow is Y0^2 + X^2 - (X nu + sun_distance)^2: a quadratic equation in X.
SHARED_FN RayleighShadow rayleigh_shadow(RayleighLine line)
{
    Number across = shared_max(1.0 - line.nu * line.nu, 1.0e-7);
    Area root2 = line.sun_distance * line.sun_distance - across * line.excess;
    Length middle = line.nu * line.sun_distance / across;
    Length reach = sqrt(shared_max(root2, 0.0)) / across;
    Number along = shared_abs(line.nu) < 1.0e-6 ? (line.nu < 0.0 ? -1.0e-6 : 1.0e-6) : line.nu;
    Length plane = -line.sun_distance / along; // the shadow is on the far side of it
    RayleighShadow shadow;
    shadow.from = along < 0.0 ? shared_max(middle - reach, plane) : middle - reach;
    shadow.to = along < 0.0 ? middle + reach : shared_min(middle + reach, plane);
    shadow.to = root2 > 0.0 ? shadow.to : shadow.from;
    return shadow;
}

// How much of the way from a to b is lit.
SHARED_FN Number rayleigh_lit(RayleighShadow shadow, Length a, Length b)
{
    Length dark = shared_min(b, shadow.to) - shared_max(a, shadow.from);
    return 1.0 - shared_clamp(dark / shared_max(b - a, 1.0e-3), 0.0, 1.0);
}

// The two legs of the lit part, before and beyond the closest point. One may have no length.
SHARED_STRUCT(RayleighLegs)
{
    Length first_far, first_near, second_near, second_far; // X, ascending
    Number split;                                          // share of the samples on the first
};

SHARED_FN RayleighLegs rayleigh_legs(RayleighLine line, RayleighShadow shadow)
{
    Length begin = line.begin >= shadow.from && line.begin < shadow.to
                       ? shared_min(shadow.to, line.end)
                       : line.begin;
    Length end =
        line.end > shadow.from && line.end <= shadow.to ? shared_max(shadow.from, begin) : line.end;
    Length middle = shared_clamp(0.0, begin, end);
    Number in_shadow = middle > shadow.from && middle < shadow.to ? 1.0 : 0.0;
    RayleighLegs legs;
    legs.first_far = begin;
    legs.first_near = in_shadow > 0.5 ? shared_max(begin, shadow.from) : middle;
    legs.second_near = in_shadow > 0.5 ? shared_min(end, shadow.to) : middle;
    legs.second_far = end;
    Length first = legs.first_near - legs.first_far;
    Length second = legs.second_far - legs.second_near;
    legs.split = first / shared_max(first + second, 1.0e-3);
    return legs;
}

// V of Section 7, from 0 to 1 (his ends exp(-mu) before that).
#define RAYLEIGH_MU 2.5
SHARED_FN Number rayleigh_spread(Number t)
{
    return (1.0 - exp(-RAYLEIGH_MU * t)) / (1.0 - exp(-RAYLEIGH_MU));
}

// X of the sample at u in [0, 1] along both legs: dense where they are lowest. Equal legs with an
// odd number of samples are his Eq. 11 (the second leg mirrored; the print has it dense at its far
// end), a single one is his Eq. 10; what is between changes without a jump from one to the other.
SHARED_FN Length rayleigh_place(RayleighLegs legs, Number u)
{
    Number before = 1.0 - rayleigh_spread(shared_min(u / shared_max(legs.split, 1.0e-6), 1.0));
    Number beyond =
        1.0 - rayleigh_spread(shared_min((1.0 - u) / shared_max(1.0 - legs.split, 1.0e-6), 1.0));
    Length first = legs.first_near + (legs.first_far - legs.first_near) * before;
    Length second = legs.second_near + (legs.second_far - legs.second_near) * beyond;
    return u < legs.split ? first : second;
}

// Mean of exp(-tau) while tau changes evenly from the one end to the other, from the
// transmittances there.
SHARED_FN Number rayleigh_mean(Number transmittance, Number next, Number tau_change)
{
    Number square = tau_change * tau_change;
    Number series = sqrt(transmittance * next) * (1.0 + square / 24.0);
    Number exact = (transmittance - next) / (square < 0.04 ? 1.0 : tau_change);
    return square < 0.04 ? series : exact;
}

// The visible part of the star's disc: uniform, `height` its centre's above the horizon over its
// radius.
SHARED_FN Number rayleigh_visible(Number height)
{
    Number y = shared_clamp(height, -1.0, 1.0);
    return 0.5 + (asin(y) + y * sqrt(shared_max(1.0 - y * y, 0.0))) / SHARED_PI;
}

#endif // SHARED_RAYLEIGH_GLSL
