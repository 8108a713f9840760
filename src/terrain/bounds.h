// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_BOUNDS_H
#define TERRAIN_BOUNDS_H
// Used by load.c and stream.c: surface.h has what others ask.

#include "terrain/surface.h"

// Finds surface->bounds and the lowest and highest altitude from its elevation layers.
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result surface_find_bounds(struct surface *surface);

// A rectangle of a layer's frame, in texels from its corner.
struct layer_rectangle {
    double x, y, width, height;
};

// A cap of the sphere that holds it.
void surface_bound_rectangle(const struct layer_frame *frame,
                             const struct layer_rectangle *rectangle, struct vec3 *direction,
                             double *angle_rad);

// Widens the bounds by heights that were found in a rectangle.
void surface_grow_bounds(struct surface *surface, const struct layer_frame *frame,
                         const struct layer_rectangle *rectangle, float min_m, float max_m);

#endif // TERRAIN_BOUNDS_H
