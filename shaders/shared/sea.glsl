// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// The rough surface of the sea as facets whose slopes are normally distributed, alike in all
// directions (Cox and Munk 1954, J. Opt. Soc. Am. 44), of which one hides another (Smith 1967, IEEE
// Trans. Antennas Propag. 15; the joint factor: Ross, Dion and Potvin 2005, J. Opt. Soc. Am. A 22).
// `mss` is the mean square slope, along and across together, above 0; cosines are of angles to the
// mean normal.
#ifndef SHARED_SEA_GLSL
#define SHARED_SEA_GLSL

#include "shared/fresnel.glsl"

// Density of slopes, per unit of slope along and across, where the facet's normal has this cosine.
SHARED_FN Number sea_slope_density(Number facet_mu, Number mss)
{
    Number slope2 = 1.0 / (facet_mu * facet_mu) - 1.0;
    return exp(-slope2 / mss) / (SHARED_PI * mss);
}

// Smith's lambda: hidden facets for each one that is seen in a direction. Of it, with
// v = cot(angle) / sqrt(mss): (exp(-v^2) / (v sqrt(pi)) - erfc(v)) / 2, here in the rational form
// of Walter et al. 2007 (Eurographics Symposium on Rendering), within 0.4 %.
SHARED_FN Number sea_hidden(Number mu, Number mss)
{
    Number c = shared_clamp(mu, 1.0e-4, 1.0);
    Number v = c / sqrt(shared_max(1.0 - c * c, 1.0e-12) * mss);
    Number seen = v < 1.6 ? (3.535 * v + 2.181 * v * v) / (1.0 + 2.276 * v + 2.577 * v * v) : 1.0;
    return 1.0 / seen - 1.0;
}

// Radiance per irradiance of a plane that faces the light, sr^-1, of light reflected once by facets
// whose normal has `facet_mu` and an angle to both rays with `facet_cosine`.
SHARED_FN Number sea_glint(Number facet_mu, Number facet_cosine, Number view_mu, Number light_mu,
                           Number mss, Number index)
{
    Number facet = shared_max(facet_mu, 1.0e-3);
    Number facet2 = facet * facet;
    Number seen = 1.0 / (1.0 + sea_hidden(view_mu, mss) + sea_hidden(light_mu, mss));
    return fresnel_reflectance(facet_cosine, index) * sea_slope_density(facet, mss) * seen /
           (4.0 * shared_max(view_mu, 1.0e-4) * facet2 * facet2);
}

// What a disc of this angular radius adds to the mean square slope that shapes its glint: half the
// mean square angle of its points, by the law of reflection a quarter of it in slopes.
SHARED_FN Number sea_disc_slope(Angle radius)
{
    return radius * radius / 8.0;
}

// Albedo of fresh foam in visible light (Whitlock, Bartlett and Gurganus 1982, Geophys. Res. Lett.
// 9).
#define SEA_FOAM_ALBEDO 0.55

// Of normally distributed numbers the part below one (logistic; within 2e-4).
SHARED_FN Number sea_part_below(Number deviations)
{
    return 1.0 / (1.0 + exp(-deviations * (1.5976 + 0.070566 * deviations * deviations)));
}

// Part of the water under fresh foam, where waves press the surface together by `crest`, and others
// which are not seen by normally distributed numbers of the deviation `lost`; all over the
// deviation of all. Foam begins at `first` and is dense `width` beyond it: three steps of a ramp.
SHARED_FN Number sea_foam(Number crest, Number lost, Number first, Number width)
{
    Number scale = 1.0 / sqrt(lost * lost + width * width / 36.0);
    Number past = crest - first;
    return (sea_part_below((past - width / 6.0) * scale) +
            sea_part_below((past - width / 2.0) * scale) +
            sea_part_below((past - width * (5.0 / 6.0)) * scale)) /
           3.0;
}

// Surf: where the depth is `broken` and less, all waves have broken; of those that come in the part
// (broken / depth)^4 has (Thornton and Guza 1983, J. Geophys. Res. 88), a quarter of it for each of
// these steps, down to the open sea.
#define SEA_SURF_STEPS 8
#define SEA_SURF_LAST 8.0
SHARED_FN Number sea_surf_step(Length depth, Length broken)
{
    Number ratio = shared_max(depth, 1.0e-3) / shared_max(broken, 1.0e-6);
    return shared_clamp(2.0 * log2(ratio), 0.0, SEA_SURF_LAST);
}

// What waves press together counts with this part: long ones break, short ones only make edges
// ragged. `breaking`: wavenumber of half of it.
SHARED_FN Number sea_breaking(Number wavenumber, Number breaking)
{
    return 1.0 / (1.0 + wavenumber / breaking);
}

// Roughnesses that tables have: the mean square slope of all waves, and less by a factor of 2 to
// this power for each level below it.
#define SEA_LEVELS 3
#define SEA_LEVEL_OCTAVES 3.0

// Table of what comes out of the water: orders of azimuth, and angles of star and view. Those of
// sky/sea.h.
#define SEA_ORDERS 3
#define SEA_ANGLES 12

// Depth of water as a code for a byte, 1 at the shore and 0 from SEA_DEEP_M on, where no light
// comes back from the bed of the clearest water; and back.
#define SEA_DEEP_M 200.0
SHARED_FN Number sea_depth_code(Length depth)
{
    return 1.0 - sqrt(shared_clamp(depth / SEA_DEEP_M, 0.0, 1.0));
}

SHARED_FN Length sea_code_depth(Number code)
{
    return SEA_DEEP_M * (1.0 - code) * (1.0 - code);
}

#endif // SHARED_SEA_GLSL
