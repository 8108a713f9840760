// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_BOUNDS_H
#define TERRAIN_BOUNDS_H
// Used by load.c: surface.h has what others ask.

#include "terrain/surface.h"

// Finds surface->bounds and the lowest and highest altitude from its elevation layers.
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result surface_find_bounds(struct surface *surface);

#endif // TERRAIN_BOUNDS_H
