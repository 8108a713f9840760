// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_CEILING_H
#define TERRAIN_CEILING_H
// Upper bounds of the heights around a place, quickly and for any size of neighbourhood: maxima of
// blocks of texels, of blocks of those, and so on.

#include "terrain/surface.h"

enum { CEILING_MAX_LEVELS = 20 };

// Of one elevation layer.
struct ceiling_pyramid {
    const struct terrain_layer *layer;
    int level_count;
    uint32_t width[CEILING_MAX_LEVELS], height[CEILING_MAX_LEVELS];
    float *highest[CEILING_MAX_LEVELS]; // owned: one block, at the first
    double all;                         // the highest of all
    double steepest;                    // m per m; only where there is noise
};

// Must not outlive the surface.
struct terrain_ceiling {
    const struct surface *surface;
    size_t count;
    double steepest_map; // of the noise's own ground, m per m
    struct ceiling_pyramid pyramids[SURFACE_MAX_LAYERS];
};

// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result terrain_ceiling_init(const struct surface *surface,
                                             struct terrain_ceiling *out);
void terrain_ceiling_finish(struct terrain_ceiling *ceiling);

// An altitude that no ground within `angle_rad` of a direction rises above.
double terrain_ceiling_m(const struct terrain_ceiling *ceiling, struct vec3 direction,
                         double angle_rad);

#endif // TERRAIN_CEILING_H
