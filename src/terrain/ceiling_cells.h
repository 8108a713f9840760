// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_CEILING_CELLS_H
#define TERRAIN_CEILING_CELLS_H
// Bounds that are expensive, found once for cells of the sphere: six faces of a cube seen from the
// centre, each a quadtree down to decimetres. Cells are found when they are asked for, and kept in
// a table of fixed size, in which later ones take the places of earlier ones.

#include "base/context.h"
#include "base/vec3.h"

#include <stdatomic.h>
#include <stdbool.h>
#include <stdint.h>

// A cell's name and its value; the first is kept as its exclusive or with the second, so that a
// slot that two threads have written halves of is nobody's.
struct ceiling_slot {
    _Atomic uint64_t mixed, value;
};

// Threads: any may ask. An answer does not depend on what others asked.
struct ceiling_cells {
    struct ceiling_slot *slots; // owned
    // An altitude that no ground within `angle_rad` of a unit direction rises above.
    double (*bound)(const void *user, struct vec3 up, double angle_rad);
    const void *user;
};

// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result ceiling_cells_init(const trl_context *ctx, struct ceiling_cells *cells);
void ceiling_cells_finish(const trl_context *ctx, struct ceiling_cells *cells);

// Whether no ground within the angle rises above an altitude, as the cells know; the first that
// knows otherwise ends it.
bool ceiling_cells_are_below(const struct ceiling_cells *cells, struct vec3 up, double angle_rad,
                             double altitude_m);

// The same bound from the cells that the neighbourhood touches: up to nine, each no wider than it.
double ceiling_cells_ask(const struct ceiling_cells *cells, struct vec3 up, double angle_rad);

#endif // TERRAIN_CEILING_CELLS_H
