// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// The sky view factor: which part of an even sky's light falls on a tilted surface among terrain,
// relative to level ground without any (Dozier and Frew 1990, IEEE Transactions on Geoscience and
// Remote Sensing 28, Eq. 7b). With the horizon at the zenith angle H in the azimuth phi,
//
//     V = 1/(2 pi) integral cos(S) sin^2(H) + sin(S) cos(phi - A) (H - sin(H) cos(H)) dphi
//
// for a surface of slope S that faces A: cos(S) is what its unit normal has along the vertical,
// sin(S) cos(phi - A) what it has along the azimuth. The horizon is given by its sine, cos(H).
#ifndef SHARED_SKY_VIEW_GLSL
#define SHARED_SKY_VIEW_GLSL

#include "shared/shared.glsl"

// H - sin(H) cos(H) of c = cos(H) in [0, 1]: pi / 2 at the level horizon, 0 at the zenith. The
// arc's cosine is Abramowitz and Stegun's 4.4.45, good to 7e-5.
SHARED_FN Number sky_view_tilted(Number c)
{
    Number arc = 1.5707288 + c * (-0.2121144 + c * (0.0742610 - 0.0187293 * c));
    return sqrt(1.0 - c) * (arc - c * sqrt(1.0 + c));
}

// One azimuth's part of V, that is, V if all azimuths were alike. `rise` is what the normal has
// along the vertical, `lean` along the azimuth, the horizon's sine is in [0, 1]. Where the surface
// itself is higher than the horizon, it is the horizon; below the level there is no sky.
SHARED_FN Number sky_view_azimuth(Number rise, Number lean, Number horizon)
{
    Number own = shared_max(-lean, 0.0) / sqrt(shared_max(rise * rise + lean * lean, 1e-12));
    Number c = shared_min(shared_max(horizon, own), 1.0);
    return rise * (1.0 - c * c) + lean * sky_view_tilted(c);
}

// How much more light slopes have than what comes to them from outside, where the terrain's mean
// sky view factor is `view` and its albedo `albedo`: the part 1 - view of what they send back meets
// slopes again, a series.
SHARED_FN Number sky_view_again(Number view, Number albedo)
{
    return 1.0 / (1.0 - albedo * (1.0 - view));
}

#endif // SHARED_SKY_VIEW_GLSL
