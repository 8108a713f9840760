// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_SLOPE_H
#define TERRAIN_SLOPE_H
// Slopes of layers of heights on the CPU, as layers_slope of terrain/slope.glsl finds them.

#include "shared/relief.glsl"
#include "terrain/layer.h"

#define SLOPE_NO_DATA 30.0 // log2 of a texel in m: larger than any planet

struct slope {
    struct vec3 slope; // tangential, planet axes, m per m
    double height_m;   // linear between texels: what modes that compare or multiply need
    double log2_texel; // of the size in m of what the heights resolve, between layers
    ReliefData data;   // the same, layer by layer
};

// Lays a layer's slope at a unit direction over what lies below.
void slope_lay_over(const struct terrain_layer *layer, struct vec3 up, double radius_m,
                    struct slope *slope);

#endif // TERRAIN_SLOPE_H
