// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_PROJECTIVE_GLSL
#define SHARED_PROJECTIVE_GLSL
// Planetary projective grid mapping (PGM, "Planetary Terrain Rendering", Sections 3 and 4): rays
// and spheres in the plane through the viewer and the planet's centre. Angles: omega of a ray from
// the nadir, gamma of a point from the viewer, seen from the centre. A sphere of radius r is known
// by the viewer's altitude a = d - r above it, since d - r of floats of a planet's size is noise.
// Derivations, and the paper's printed forms: docs/physics.md, section 16.
//
// Holds for a > 0 and omega from 0 to the tangent.
#include "shared/shared.glsl"

// (d/r)^2 - 1.
SHARED_FN Number projective_excess(Length altitude, Length radius)
{
    Number x = altitude / radius;
    return x * (2.0 + x);
}

// Eq. 3, tau = asin(r/d).
SHARED_FN Angle projective_tangent(Number excess)
{
    return shared_atan2(1.0, sqrt(excess));
}

// Cosine of the angle between ray and normal where the ray meets the sphere first:
// (d/r)^2 (cos(omega)^2 - cos(tau)^2), whose difference is a product near the tangent.
SHARED_FN Number projective_incidence(Angle omega, Angle tangent, Number excess)
{
    Number difference = 2.0 * sin(0.5 * (tangent + omega)) * sin(0.5 * (tangent - omega));
    Number sum = cos(omega) + cos(tangent);
    return sqrt(shared_max((1.0 + excess) * difference * sum, 0.0));
}

// gamma of that point: asin((d/r) sin(omega)) - omega, the law of sines, without the difference.
SHARED_FN Angle projective_normal_angle(Angle omega, Angle tangent, Number excess)
{
    Number q = sqrt(1.0 + excess);
    Number incidence = projective_incidence(omega, tangent, excess);
    Number sine = excess * sin(omega) / (q * cos(omega) + incidence);
    return shared_atan2(sine, incidence * cos(omega) + q * sin(omega) * sin(omega));
}

// Its distance from the viewer: a sin(rho) / sin(chi), rho = pi/2 + gamma/2,
// chi = pi/2 - gamma/2 - omega, without the small angle chi.
SHARED_FN Length projective_distance(Angle omega, Angle tangent, Number excess, Length altitude)
{
    Number q = sqrt(1.0 + excess);
    Number incidence = projective_incidence(omega, tangent, excess);
    return altitude * (1.0 + q) / (q * cos(omega) + incidence);
}

// gamma_0: where the ray that is tangent to a sphere leaves another one, `rise` larger. Nothing
// farther than that is seen of ground between the two.
SHARED_FN Angle projective_reach(Number excess, Length radius, Length rise)
{
    return shared_atan2(sqrt(excess), 1.0) +
           shared_atan2(sqrt(rise * (2.0 * radius + rise)), radius);
}

// Eq. 1 with its ends as Section 3 describes them: 0 at the start of the range, 1 at the tangent.
SHARED_FN Number projective_blend(Angle omega, Angle start, Angle tangent)
{
    return shared_clamp((omega - start) / (tangent - start), 0.0, 1.0);
}

// gamma for a ray of the grid: that of the primary sphere near the viewer, and of the secondary one
// (r_s = d cos(gamma_0), Eq. 4, whose tangent is pi/2 - gamma_0) toward the tangent, so that the
// last ray reaches gamma_0 = `reach` behind the horizon. `threshold` is zeta.
SHARED_FN Angle projective_blended_angle(Angle omega, Number excess, Angle reach, Number threshold)
{
    Angle tangent = projective_tangent(excess);
    Angle secondary = 0.5 * SHARED_PI - reach;
    Angle start = threshold * shared_min(tangent, shared_max(secondary, 0.0));
    Number f = projective_blend(omega, start, tangent);
    Angle primary = projective_normal_angle(omega, tangent, excess);
    if (secondary > 0.02) {
        Number slope = sin(reach) / cos(reach);
        Angle ray = start + f * (secondary - start);
        return primary + f * (projective_normal_angle(ray, secondary, slope * slope) - primary);
    }
    // From so far away there is no secondary sphere: straight on to what the tangent leaves out.
    return primary + f * f * (reach - (0.5 * SHARED_PI - tangent));
}

// The part of all rings around the nadir that lie within gamma, up to `reach`. One half of them is
// even within `near` and in proportion to the distance beyond, the other is even all the way, so
// that no range of mountains far behind the horizon lies between two.
SHARED_FN Number projective_rings_within(Angle gamma, Angle near, Angle reach)
{
    Number x = gamma / near;
    Number whole = reach / near;
    Number logarithms = log(x + sqrt(x * x + 1.0)) / log(whole + sqrt(whole * whole + 1.0));
    return 0.5 * (logarithms + gamma / reach);
}

#endif // SHARED_PROJECTIVE_GLSL
