// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_CEILING_PYRAMID_H
#define TERRAIN_CEILING_PYRAMID_H
// Upper bounds of the heights of one layer and of their slopes: maxima of blocks of texels, of
// blocks of those, and so on.

#include "terrain/layer.h"

enum { CEILING_MAX_LEVELS = 20 };
enum ceiling_value {
    CEILING_HIGHEST,  // m
    CEILING_STEEPEST, // m per m, of the cubic between texels; INFINITY: not known
    CEILING_VALUE_COUNT
};

// Must not outlive the layer.
struct ceiling_pyramid {
    const struct terrain_layer *layer;
    int level_count;
    uint32_t width[CEILING_MAX_LEVELS], height[CEILING_MAX_LEVELS];
    // Owned: one block for each, at the first level.
    float *values[CEILING_VALUE_COUNT][CEILING_MAX_LEVELS];
    double all[CEILING_VALUE_COUNT]; // over the whole layer
    double lowest;                   // of the whole layer, if it is a factor
};

// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result ceiling_pyramid_init(const struct terrain_layer *layer, double radius_m,
                                             bool has_slopes, struct ceiling_pyramid *out);
void ceiling_pyramid_finish(struct ceiling_pyramid *pyramid);

// The most within `angle_rad` of a unit direction; -INFINITY: the layer is not in reach.
double ceiling_pyramid_most(const struct ceiling_pyramid *pyramid, enum ceiling_value value,
                            struct vec3 up, double angle_rad);

#endif // TERRAIN_CEILING_PYRAMID_H
