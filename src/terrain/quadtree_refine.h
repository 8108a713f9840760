// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_QUADTREE_REFINE_H
#define TERRAIN_QUADTREE_REFINE_H
// Which squares of the quadtrees stand for the ground in a view, and how far each is morphed.
//
// A square's continuous level says which surface it shows: 5.3 is three tenths of the way from the
// grids of level 5 to those of level 6. Levels at corners are those of the lowest square around,
// and between corners they run linearly; so squares that share a border show the same there.

#include "base/camera.h"
#include "terrain/quadtree_node.h"

// In view, or nearly.
enum { QUADTREE_MAX_LEAVES = 2048 };
enum { QUADTREE_WEST, QUADTREE_EAST, QUADTREE_SOUTH, QUADTREE_NORTH, QUADTREE_SIDES };

struct quadtree_leaf {
    uint32_t node;
    double lod[4];                   // at the corners: lower left, lower right, upper left, right
    bool is_coarser[QUADTREE_SIDES]; // what lies beyond
};

struct quadtree_leaves {
    uint32_t count;
    double nearest_m; // no ground is nearer to the camera
    struct quadtree_leaf all[QUADTREE_MAX_LEAVES];
};

// Fills `out` with all squares in view, made ready. `tolerance`: the error that may be seen, as an
// angle in radians; more is allowed when there would be too many squares.
// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result quadtree_refine(struct quadtree_nodes *nodes, const struct camera *camera,
                                        double tolerance_rad, struct quadtree_leaves *out);

#endif // TERRAIN_QUADTREE_REFINE_H
