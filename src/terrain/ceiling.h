// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_CEILING_H
#define TERRAIN_CEILING_H
// Upper bounds of the heights around a place, quickly and for any size of neighbourhood: of data by
// the pyramids of its layers; with octaves of noise by the relief in the middle of cells and what
// it can rise within them.

#include "terrain/ceiling_cells.h"
#include "terrain/ceiling_pyramid.h"
#include "terrain/surface.h"

// Must not outlive the surface. Threads: any may ask.
struct terrain_ceiling {
    const struct surface *surface;
    size_t count;
    double steepest_map; // of the noise's own ground, m per m
    struct ceiling_pyramid pyramids[SURFACE_MAX_LAYERS];
    struct ceiling_cells cells; // where there is noise
};

// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result terrain_ceiling_init(const struct surface *surface,
                                             struct terrain_ceiling *out);
void terrain_ceiling_finish(struct terrain_ceiling *ceiling);

// An altitude that no ground within `angle_rad` of a direction rises above.
double terrain_ceiling_m(const struct terrain_ceiling *ceiling, struct vec3 direction,
                         double angle_rad);

// Whether none does, as far as is known: quicker where the answer is clear.
bool terrain_ceiling_is_below(const struct terrain_ceiling *ceiling, struct vec3 direction,
                              double angle_rad, double altitude_m);

#endif // TERRAIN_CEILING_H
