// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_MAKE_H
#define TERRAIN_MAKE_H
// Used by load.c and bounds.c: the noise of a surface.

#include "terrain/surface.h"

// The ground of an invented planet, if the surface is one. TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result make_ground(const struct surface_desc *desc, struct surface *surface);

// Noise that goes on where the data of the surface end, if it is wanted. The layers are loaded.
// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result make_detail(const struct surface_desc *desc, struct surface *surface);

// Bounds of the map's heights in a cell of surface->bounds, and how far octaves reach from there.
struct surface_bounds make_bound_ground(const struct surface *surface, int column, int row);
struct noise_reach make_bound_octaves(const struct surface *surface, int column, int row);

#endif // TERRAIN_MAKE_H
