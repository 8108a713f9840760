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
    Number code;     // of its depth by the mask; 0: it is a lake, whose level nobody knows
    Number texels;   // of the mask in the footprint's width
    Length altitude; // of the ground above sea level; that of open sea is 0, or its bed's
    Number bed;      // 1: heights here have the sea's bed, and so its shore
    Length around;   // the same, mean of the texels around
    Number fine;     // 1: heights are finer than the mask
    Number slope;    // of the ground
    Number made;     // of shore_made
    Length texel;    // of the mask
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

// The bed so far from the shore: the profile that waves give to sand of 0.2 mm (Dean 1991, J.
// Coastal Res. 7).
#define SHORE_PROFILE 0.1
SHARED_FN Length shore_bed(Length way)
{
    return SHORE_PROFILE * pow(shared_max(way, 0.0), 2.0 / 3.0);
}

// Ground falls on below water as it does above, where heights end: over so much.
#define SHORE_FALL_M 30.0

// Level water over a bed reaches so high: what has no bed but lies level is water too.
#define SHORE_BED_M 0.05

SHARED_STRUCT(ShoreWater)
{
    Number part; // of the footprint that is open water
    Number code; // of its depth by shared/sea.glsl
};

SHARED_FN ShoreWater shore_water(Shore s)
{
    Number sea = s.code > 0.5 / 255.0 ? 1.0 : s.bed;
    Length around = (1.0 - s.fine) * shared_max(s.around, 0.0);
    Length level = SHORE_SEA_M + around * (SHORE_AROUND + SHORE_AROUND_MADE * s.made);
    level += s.bed * (SHORE_BED_M - level);
    Length rise = s.slope * s.texels * s.texel + 0.1;
    Number below = 0.5 + (level - s.altitude) / rise;
    Number off_level = (shared_abs(s.altitude) - SHORE_SEA_M) / rise;
    Number is_level = sea * shared_clamp(0.5 - off_level, 0.0, 1.0);
    Number limit = 0.5 + (SHORE_LEVEL_MASK - 0.5) * is_level;
    Number made = s.made * (SHORE_LAKE_MADE + (SHORE_SEA_MADE - SHORE_LAKE_MADE) * sea);
    // Over a bed no mask is asked.
    Number moved = s.mask - limit + made * (1.0 - is_level) + 2.0 * s.bed;
    // Where a footprint covers texels, the mask is its mean already.
    Number sharp = shared_clamp(0.5 + moved / shared_max(s.texels, 0.01), 0.0, 1.0);
    Number coarse = shared_clamp(1.0 + 2.0 * (s.texels - SHORE_MEAN_TEXELS), 0.0, 1.0);
    Number mask = sharp + (s.mask - sharp) * coarse;
    // Surely water and surely land stay.
    mask = s.mask + s.bed > 0.0 ? (s.mask < 1.0 ? mask : 1.0) : 0.0;
    Number height = shared_clamp(below, 0.0, 1.0);
    height += (1.0 - height) * shared_max(coarse, 1.0 - sea);
    // From the shore on: by the mask as far as that changes, by heights as far as ground falls.
    Number off = shared_max(moved, 0.0);
    Number part = off / shared_max(off + 1.0 - s.mask, 1.0e-6);
    Number shelf = sea_depth_code(shore_bed(off * s.texel)) * (1.0 - part * part * part * part);
    // Where ground is level yet, heights as coarse as the mask have the slope of what is half a
    // texel on.
    Length below_level = shared_max(level - s.altitude, 0.0);
    Length way = below_level / shared_max(s.slope, 1.0e-6);
    way += 0.5 * (1.0 - s.fine) * s.texel * shared_min(below_level / level, 1.0);
    Number beach = sea * sea_depth_code(shore_bed(way) + SHORE_FALL_M * s.slope);
    ShoreWater w;
    w.part = shared_min(mask, height);
    w.code = shared_max(s.code, shared_max(shelf, beach) * (1.0 - coarse));
    Number bed = sea_depth_code(shared_max(-s.altitude, 0.0));
    w.code += s.bed * (1.0 - coarse) * (bed - w.code);
    return w;
}

// Of `fine` heights with so many octaves more than the mask has: 0 to 1 over two.
SHARED_FN Number shore_fine(Number octaves)
{
    Number x = shared_clamp(0.5 * octaves, 0.0, 1.0);
    return x * x * (3.0 - 2.0 * x);
}

#endif // SHARED_SHORE_GLSL
