// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SHARED_SEA_GRID_GLSL
#define SHARED_SEA_GRID_GLSL
// The grid of the sea's mesh: rings about the place below the eye, each farther out than the last
// by the same factor, and spokes over the azimuths that a picture shows. A cell looks about as
// large wherever it lies. docs/physics.md, *Waves that stand out*.
#include "shared/shared.glsl"

// Cells from ring to ring and from spoke to spoke.
#define SEA_GRID_RINGS 480
#define SEA_GRID_SPOKES 192
#define SEA_GRID_LAST 192.0

// A wave is left with what a Gaussian window leaves whose sides are so many cells: with 11 % where
// it has 4.5 vertices a length, and all but all of it with 20.
#define SEA_GRID_WINDOW 3.0

SHARED_STRUCT(SeaGrid)
{
    Length inner;  // radius of ring 1; ring 0 is the place below the eye
    Number growth; // logarithm of the factor
    Angle begin;   // azimuth of spoke 0, clockwise from north
    Angle step;    // from spoke to spoke
    Length reach;  // beyond which nothing is displaced
};

// Along the ground, m.
SHARED_FN Length sea_grid_radius(SeaGrid g, Number ring)
{
    return ring < 0.5 ? 0.0 : g.inner * exp(g.growth * (ring - 1.0));
}

// Sides of cells at a radius, outward and around.
SHARED_FN Length sea_grid_long(SeaGrid g, Length radius)
{
    return g.growth * shared_max(radius, g.inner);
}

SHARED_FN Length sea_grid_wide(SeaGrid g, Length radius)
{
    return g.step * shared_max(radius, g.inner);
}

// The last spoke of a whole circle is the first one, to the last digit.
SHARED_FN Angle sea_grid_azimuth(SeaGrid g, Number spoke)
{
    Number whole = g.step * SEA_GRID_LAST > 6.28 ? 1.0 : 0.0;
    Number turned = whole > 0.5 && spoke > SEA_GRID_LAST - 0.5 ? 0.0 : spoke;
    return g.begin + g.step * turned;
}

// What is left of displacement at a distance: none where it is half a pixel high, all at twice
// that.
SHARED_FN Number sea_grid_shown(SeaGrid g, Length distance)
{
    Number t = shared_clamp(2.0 - 2.0 * distance / g.reach, 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

// Height of a crest that no eye is to dive into: a bowl around it, as a hull makes one.
SHARED_FN Length sea_grid_bowl(Length crest, Length radius, Length eye_height)
{
    Length room = shared_min(0.5 * eye_height, 1.0);
    Length rim = eye_height - room + 0.4 * radius;
    Length over = crest - rim;
    // A smooth lesser of both, over the width of the room.
    return rim + 0.5 * (over - sqrt(over * over + room * room));
}

#endif // SHARED_SEA_GRID_GLSL
