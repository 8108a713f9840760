// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_PROJECTION_GLSL
#define SHARED_PROJECTION_GLSL
// Map projections of rasters, without the radius (PGM, Section 7; Snyder 1987, Map Projections: a
// Working Manual, Eq. 12-1 and 21-33): where a place lies on a map, as the difference to where the
// anchor lies on it. Nothing here subtracts two places, so offsets of millimetres keep their digits
// in float. Derived in docs/physics.md, section 16.
//
//     equirectangular   x = longitude, y = latitude
//     stereographic     x = 2 tan(theta / 2) along the anchor's meridian away from the pole, y to
//                       the east of it; theta is the angle from the pole
//
// Both are radians where they are true to scale: on the equator, and at the pole.
#include "shared/shared.glsl"

// A direction's difference to the anchor's, along the axis of the planet and across it.
SHARED_STRUCT(AxisOffset)
{
    Number outward; // away from the axis, in the anchor's meridian
    Number east;    // across that meridian
    Number up;      // along the axis, northward
};

SHARED_STRUCT(MapOffset)
{
    Number x, y;
};

// From the difference in longitude and latitude to the anchor, whose latitude has this sine and
// cosine. cos(a + b) - cos(a) = -2 sin(a + b / 2) sin(b / 2), and so on: nothing cancels.
SHARED_FN AxisOffset projection_axis_offset(Number anchor_sine, Number anchor_cosine,
                                            Angle longitude, Angle latitude)
{
    Number s = sin(0.5 * latitude);
    Number c = cos(0.5 * latitude);
    Number middle_sine = anchor_sine * c + anchor_cosine * s;
    Number middle_cosine = anchor_cosine * c - anchor_sine * s;
    Number fall = -2.0 * middle_sine * s; // of the distance from the axis
    Number turn = sin(0.5 * longitude);
    AxisOffset o;
    o.outward = fall - 2.0 * (anchor_cosine + fall) * turn * turn;
    o.east = (anchor_cosine + fall) * sin(longitude);
    o.up = 2.0 * middle_cosine * s;
    return o;
}

// On an ellipsoid the latitude that counts is the conformal one: distances from the pole are those
// of the sphere times ((1 + e s) / (1 - e s))^(e / 2), s the sine of the latitude toward the pole.
// This is what that factor is at `sine`, divided by what it is at `anchor_sine`, less 1: with
// atanh(a) - atanh(b) = atanh((a - b) / (1 - a b)) a series in the difference. e2 = e^2 < 0.1.
SHARED_FN Number projection_ellipsoid(Number difference, Number sine, Number anchor_sine, Number e2)
{
    Number t = difference / (1.0 - e2 * sine * anchor_sine);
    Number power = e2 * t * (1.0 + e2 * t * t / 3.0);
    return power * (1.0 + 0.5 * power * (1.0 + power / 3.0));
}

// Half the number that times the offset in radians gives the offset on the stereographic map.
SHARED_FN Number projection_stereographic_scale(Number anchor_sine, Number up, Number pole)
{
    return 1.0 / shared_max(1.0 + pole * (anchor_sine + up), 1.0e-4);
}

// Stereographic about the north (pole = 1) or the south pole (-1): 2 (outward, east) / (1 + pole z)
// of the unit vector, less the anchor's 2 cosine / (1 + pole sine). e2 is 0 on a sphere, and
// `anchor_factor` the ellipsoid's factor at the anchor. The other pole lies infinitely far away.
SHARED_FN MapOffset projection_stereographic(AxisOffset o, Number anchor_sine, Number anchor_cosine,
                                             Number pole, Number e2, Number anchor_factor)
{
    Number w0 = shared_max(1.0 + pole * anchor_sine, 1.0e-4);
    Number up = 1.0 + pole * (anchor_sine + o.up);
    Number w = shared_max(up, 1.0e-6);
    MapOffset m;
    m.x = 2.0 * (o.outward * w0 - anchor_cosine * pole * o.up) / (w * w0);
    m.x = up < 1.0e-6 ? 1.0e6 : m.x;
    m.y = 2.0 * o.east / w;
    Number grown =
        projection_ellipsoid(pole * o.up, pole * (anchor_sine + o.up), pole * anchor_sine, e2);
    m.x = anchor_factor * (m.x + grown * (m.x + 2.0 * anchor_cosine / w0));
    m.y = anchor_factor * (1.0 + grown) * m.y;
    return m;
}

#endif // SHARED_PROJECTION_GLSL
