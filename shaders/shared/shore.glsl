// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Where water ends between the texels of a mask: docs/physics.md, *The sea*. The mask decides by
// texels, and between them, where water is the sea, so does the height of the ground.
#ifndef SHARED_SHORE_GLSL
#define SHARED_SHORE_GLSL

#include "shared/sea.glsl"
#include "shared/shared.glsl"

// Of a place, or the mean of a footprint.
SHARED_STRUCT(Shore)
{
    Number mask;     // part that is water, linear between the mask's texels
    Number texels;   // of the mask in the footprint's width
    Number sea;      // 1: the water lies at sea level, 0: it is a lake, whose level nobody knows
    Length altitude; // of the ground above sea level; that of open sea is 0
    Length around;   // the same, mean of the texels around; 0 where heights are finer than the mask
    Length rise;     // of the ground over the footprint's width
    Number made;     // of shore_made
};

// Ground this high is land even where the mask says sea, since the sea is level. Where heights know
// no more than the mask, that would be all that has a corner of land: up to this part of what is
// around, more or less by made-up detail, it is the sea's.
#define SHORE_SEA_M 0.3
#define SHORE_AROUND 1.0
#define SHORE_AROUND_MADE 0.9
// How far the detail moves the shore of a lake, and of the sea, in texels.
#define SHORE_LAKE_MADE 0.2
#define SHORE_SEA_MADE 0.35
// What lies at sea level beside the sea is sea from this part of the mask on.
#define SHORE_LEVEL_MASK 0.1
// Of so many of the mask's texels and more a footprint has the mean.
#define SHORE_MEAN_TEXELS 0.75

// Made-up detail of so many of the mask's texels, -1 to 1. Each octave moves the shore by a part of
// its own wavelength: more would tear it into specks.
#define SHORE_MADE 0.5
SHARED_FN Number shore_made(Number texels)
{
    return shared_clamp(SHORE_MADE * texels, -1.0, 1.0);
}

// Part of the made-up relief that is left where a mask has this value: water is level, and so is
// what detail may add to it beside a lake. Never 0, where relief would have no detail to tell.
SHARED_FN Number shore_dry(Number mask)
{
    Number x = shared_clamp(mask / (0.5 - SHORE_LAKE_MADE), 0.0, 1.0);
    return shared_max(1.0 - x * x * (3.0 - 2.0 * x), 1.0e-4);
}

// Part of the footprint that is open water.
SHARED_FN Number shore_water(Shore s)
{
    Length level =
        SHORE_SEA_M + shared_max(s.around, 0.0) * (SHORE_AROUND + SHORE_AROUND_MADE * s.made);
    Number below = 0.5 + (level - s.altitude) / (s.rise + 0.1);
    Number off_level = (shared_abs(s.altitude) - SHORE_SEA_M) / (s.rise + 0.1);
    Number is_level = s.sea * shared_clamp(0.5 - off_level, 0.0, 1.0);
    Number limit = 0.5 + (SHORE_LEVEL_MASK - 0.5) * is_level;
    Number made = s.made * (SHORE_LAKE_MADE + (SHORE_SEA_MADE - SHORE_LAKE_MADE) * s.sea);
    Number moved = s.mask - limit + made * (1.0 - is_level);
    // Where a footprint covers texels, the mask is its mean already.
    Number sharp = shared_clamp(0.5 + moved / shared_max(s.texels, 0.01), 0.0, 1.0);
    Number coarse = shared_clamp(1.0 + 2.0 * (s.texels - SHORE_MEAN_TEXELS), 0.0, 1.0);
    Number mask = sharp + (s.mask - sharp) * coarse;
    // Surely water and surely land stay.
    mask = s.mask > 0.0 ? (s.mask < 1.0 ? mask : 1.0) : 0.0;
    Number height = shared_clamp(below, 0.0, 1.0);
    height += (1.0 - height) * shared_max(coarse, 1.0 - s.sea);
    return shared_min(mask, height);
}

// Where heights finer than the mask have the sea go on into what the mask has as land, the bed lies
// below the surface too, that deep: no bay is a dry one.
#define SHORE_BAY_M 5.0

// Of `fine` heights with so many octaves more than the mask has: 0 to 1 over two.
SHARED_FN Number shore_fine(Number octaves)
{
    Number x = shared_clamp(0.5 * octaves, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

// Depth of water as a code of shared/sea.glsl, where the mask has the part `mask` and `told` is the
// depth around: toward land, where it may be unknown, it shelves.
SHARED_FN Number shore_depth(Number told, Number mask, Number fine)
{
    Number shelf = 1.0 - mask * mask;
    Number bay = shared_min(shelf, sea_depth_code(SHORE_BAY_M));
    return shared_max(told, shelf + (bay - shelf) * fine);
}

#endif // SHARED_SHORE_GLSL
