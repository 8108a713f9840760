// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_GERSTNER_GLSL
#define SHARED_GERSTNER_GLSL
// Spherical Gerstner waves (Michelic 2019, Section 4, Eq. 7 to 11): each runs from an origin on the
// planet over the great circles to the place opposite. docs/physics.md, *Waves*, derives what
// differs: places count from an anchor near them, so that no float holds a distance from the
// origin; amplitudes fade with Q at both poles of a wave; the normal is exact for many waves.
//
// Axes of the anchor: two along the ground, z up. Axes of a place: those of the anchor, turned the
// shortest way. Holds everywhere but opposite the anchor.
#include "shared/shared.glsl"

// Waves fade within so many wavelengths of their poles.
#define GERSTNER_FADE_WAVES 4.0

SHARED_STRUCT(GerstnerWave)
{
    Number x, y, z; // unit, to the origin, axes of the anchor
    Length amplitude;
    PerLength wavenumber;
    Angle phase;      // at the anchor, now
    Number steepness; // Q
};

SHARED_STRUCT(GerstnerPlace)
{
    Length x, y, z;    // from the planet's centre, axes of the anchor; any length but 0
    Number vx, vy, vz; // the same, unit
};

SHARED_FN GerstnerPlace gerstner_place(Length x, Length y, Length z)
{
    GerstnerPlace p;
    p.x = x;
    p.y = y;
    p.z = z;
    Number scale = 1.0 / sqrt(x * x + y * y + z * z);
    p.vx = x * scale;
    p.vy = y * scale;
    p.vz = z * scale;
    return p;
}

// One wave at one place: how it is there.
SHARED_STRUCT(GerstnerRipple)
{
    Number dx, dy; // where it travels to, axes of the place
    Number sine, cosine;
    Number fade;          // 1 but near the wave's poles
    PerLength fade_slope; // along the travel
    PerLength spread;     // 1 / radius of the circle that its crest is, as seen along the ground
};

// The angle between the travel to the place and that to the anchor, as a fraction whose parts keep
// their digits however near the place is: tan = rise / run.
SHARED_STRUCT(GerstnerTurn)
{
    Length rise, run;
};

SHARED_FN GerstnerTurn gerstner_turn(GerstnerWave w, GerstnerPlace p)
{
    Number away = sqrt(w.x * w.x + w.y * w.y); // sine of the anchor's angle from the origin
    Number is_pole = away < 1.0e-9 ? 1.0 : 0.0;
    Number scale = (1.0 - is_pole) / shared_max(away, 1.0e-9);
    Number dx = is_pole - w.x * scale;
    Number dy = -w.y * scale;
    Length along = p.x * dx + p.y * dy;
    Length side = p.y * dx - p.x * dy;
    Length s = p.z * away + along * w.z;
    Length root = sqrt(side * side + s * s);
    Length q = s > 0.0 ? side * side / (root + s) : root - s;
    GerstnerTurn t;
    t.rise = along + q * w.z;
    t.run = p.z + q * away;
    return t;
}

// The arc tangent of a fifth and less: what a float has, where a driver's own may be off by 2e-5.
SHARED_FN Angle gerstner_small_angle(GerstnerTurn turn)
{
    Number t = turn.rise / turn.run;
    Number t2 = t * t;
    return t * (1.0 - t2 * (1.0 / 3.0 - t2 * (0.2 - t2 * (1.0 / 7.0 - t2 * (1.0 / 9.0)))));
}

// `angle` from the anchor: of the above, or shared_atan2(turn.rise, turn.run) anywhere.
SHARED_FN GerstnerRipple gerstner_ripple(GerstnerWave w, GerstnerPlace p, Length radius,
                                         Angle angle)
{
    Number lean = (p.vx * w.x + p.vy * w.y) / (1.0 + p.vz) + w.z;
    Number ox = w.x - p.vx * lean;
    Number oy = w.y - p.vy * lean;
    Number cosine = p.vx * w.x + p.vy * w.y + p.vz * w.z;
    Number sine = sqrt(ox * ox + oy * oy);
    Number scale = 1.0 / shared_max(sine, 1.0e-12);
    GerstnerRipple r;
    r.dx = -ox * scale;
    r.dy = -oy * scale;
    // Eq. 11: smoothstep of 1 - |v o|, without that difference.
    Number reach = GERSTNER_FADE_WAVES * 2.0 * SHARED_PI / (w.wavenumber * radius);
    Number e1 = shared_min(0.5 * reach * reach, 1.0);
    Number u = shared_min(sine * sine / ((1.0 + shared_abs(cosine)) * e1), 1.0);
    r.fade = u * u * (3.0 - 2.0 * u);
    r.fade_slope = 6.0 * u * (1.0 - u) * sine / (e1 * radius) * (cosine < 0.0 ? -1.0 : 1.0);
    r.spread = cosine * scale / radius;
    Angle phase = w.wavenumber * radius * angle + w.phase;
    r.sine = sin(phase);
    r.cosine = cos(phase);
    return r;
}

// Of all waves at a place, in its axes.
SHARED_STRUCT(GerstnerSum)
{
    Length x, y, z;     // displacement
    Number gx, gy;      // gradient of z by the undisplaced place
    Number xx, xy, yy;  // compression: 1 - the gradient of x and y
    Number lost_square; // mean square slope of what weights have left out
    // What makes foam, by shared/sea.glsl: compression with Q = 1 by the waves that break, the mean
    // square of all of it, and of what weights have left out.
    Number press, press_square, press_lost;
};

SHARED_FN GerstnerSum gerstner_level(void)
{
    GerstnerSum s;
    s.x = s.y = s.z = 0.0;
    s.gx = s.gy = 0.0;
    s.xx = s.xy = s.yy = 0.0;
    s.lost_square = 0.0;
    s.press = s.press_square = s.press_lost = 0.0;
    return s;
}

// `weight` on the amplitude: what a pixel or a mesh leaves of the wave.
SHARED_FN GerstnerSum gerstner_add(GerstnerSum s, GerstnerWave w, GerstnerRipple r, Number weight)
{
    Length a = w.amplitude * weight;
    Length height = a * r.fade;
    Number slope = a * (r.fade * w.wavenumber * r.cosine + r.fade_slope * r.sine);
    Length qa = w.steepness * a * r.fade;
    Length shift = qa * r.fade * r.cosine;
    Number squeeze = qa * (r.fade * w.wavenumber * r.sine - 2.0 * r.fade_slope * r.cosine);
    Number across = -shift * r.spread;
    s.x += shift * r.dx;
    s.y += shift * r.dy;
    s.z += height * r.sine;
    s.gx += slope * r.dx;
    s.gy += slope * r.dy;
    s.xx += squeeze * r.dx * r.dx + across * r.dy * r.dy;
    s.xy += (squeeze - across) * r.dx * r.dy;
    s.yy += squeeze * r.dy * r.dy + across * r.dx * r.dx;
    Number steep = w.amplitude * w.wavenumber;
    s.lost_square += 0.5 * steep * steep * (1.0 - weight * weight);
    return s;
}

// Where a window leaves less of a wave than this, it and all shorter ones are roughness.
#define GERSTNER_LEAST_WEIGHT 0.02

// What is left of an amplitude under a Gaussian window over a pixel, whose sides advance the wave
// by these angles: the window's deviation is half a side.
SHARED_FN Number gerstner_weight(Angle along_x, Angle along_y)
{
    return exp(-0.125 * (along_x * along_x + along_y * along_y));
}

// A drawn wave stands for a share of all directions, of this deviation from its own (a tenth of
// their range, which has one wave of eight): crests end. With `sides2`, the sum of the sides'
// squares, what is left of the mean of them all; else a wave that runs across a long pixel would
// be seen to the horizon.
#define GERSTNER_COURSES 0.2

SHARED_FN Number gerstner_weight_of(Angle along_x, Angle along_y, PerLength wavenumber, Area sides2)
{
    Number spread2 = GERSTNER_COURSES * GERSTNER_COURSES;
    return exp(-0.125 * ((1.0 - spread2) * (along_x * along_x + along_y * along_y) +
                         spread2 * wavenumber * wavenumber * sides2));
}

// The wavenumber of which a window whose shorter side is `least` leaves GERSTNER_LEAST_WEIGHT,
// where `near` of all waves is shown.
SHARED_FN PerLength gerstner_last(Number near, Length least)
{
    Number ratio = shared_max(near / GERSTNER_LEAST_WEIGHT, 1.0);
    return sqrt(8.0 * log(ratio)) / shared_max(least, 1.0e-6);
}

// What water of a depth leaves of an amplitude: the root of the depth factor by which a sea keeps
// the shape of its saturated spectrum in wavenumbers (Kitaigorodskii et al. 1975, J. Phys.
// Oceanogr. 5; Bouws et al. 1985, J. Geophys. Res. 90; as parabolas: Thompson and Vincent 1983).
// What is missing has broken. `wavenumber` is that of deep water: k d = w^2 d / g.
SHARED_FN Number gerstner_shoal(PerLength wavenumber, Length depth)
{
    Number h = sqrt(shared_clamp(wavenumber * depth, 0.0, 4.0));
    return h < 1.0 ? 0.70710678118654752 * h : sqrt(1.0 - 0.5 * (2.0 - h) * (2.0 - h));
}

SHARED_STRUCT(GerstnerNormal)
{
    Number x, y, z; // not of length 1
};

// The cross product of the displaced tangents: with F = 1 - compression and the gradient g,
// z = det F and (x, y) = -adj(F) g. Eq. 10 is that for waves of one direction.
SHARED_FN GerstnerNormal gerstner_normal(GerstnerSum s)
{
    GerstnerNormal n;
    n.x = -((1.0 - s.yy) * s.gx + s.xy * s.gy);
    n.y = -((1.0 - s.xx) * s.gy + s.xy * s.gx);
    n.z = (1.0 - s.xx) * (1.0 - s.yy) - s.xy * s.xy;
    return n;
}

// The Jacobian of the surface with all steepness scaled: below 0 where it would fold, which is
// where crests break.
SHARED_FN Number gerstner_jacobian(GerstnerSum s, Number scale)
{
    return (1.0 - scale * s.xx) * (1.0 - scale * s.yy) - scale * scale * s.xy * s.xy;
}

// From the axes of a place to those of the anchor.
SHARED_FN GerstnerNormal gerstner_to_anchor(GerstnerPlace p, Number x, Number y, Number z)
{
    Number lean = z - (p.vx * x + p.vy * y) / (1.0 + p.vz);
    GerstnerNormal n;
    n.x = x + p.vx * lean;
    n.y = y + p.vy * lean;
    n.z = p.vz * z - p.vx * x - p.vy * y;
    return n;
}

#endif // SHARED_GERSTNER_GLSL
