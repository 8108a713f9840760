// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_QUADTREE_CORNERS_H
#define TERRAIN_QUADTREE_CORNERS_H
// Continuous levels at the corners of the squares in view, from those of the squares.

#include "terrain/quadtree_refine.h"

// Fills `lod` of all leaves, whose other members and whose nodes' levels are known.
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result quadtree_corners_find(const struct quadtree_nodes *nodes,
                                              struct quadtree_leaves *leaves);

#endif // TERRAIN_QUADTREE_CORNERS_H
