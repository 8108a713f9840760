// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_QUADTREE_NODE_H
#define TERRAIN_QUADTREE_NODE_H
// The squares of the quadtrees, kept while they are in use: a grid of heights each, how far it is
// from the ground, and a ball around it. Four of them are made at once, and the ones that were not
// looked at for longest make room.

#include "terrain/quadtree_heights.h"
#include "terrain/surface.h"

// Of one square. `index` 0 stands for none.
struct quadtree_node {
    struct tiles_place place;
    uint32_t parent, children;           // first of four
    uint32_t used;                       // last frame in which it was looked at
    bool is_ready;                       // all that follows is made
    uint32_t serial;                     // of what was made, never 0
    uint32_t slot;                       // of its vertices on the GPU, see quadtree.c
    double heights_m[QUADTREE_VERTICES]; // above the sphere, row by row from the lower left
    double low_m, high_m;                // of the ground within, with a margin
    double error_m;                      // largest distance of grid and ground that was found
    double finest_m;                     // a texel of the finest elevations that reach here
    double cell_m;
    struct vec3 origin_m; // of its vertices: near its middle, in the planet frame
    struct vec3 up;
    double radius_m;  // of a ball around the origin
    double angle_rad; // of a cap of the sphere around `up`

    // Of the frame, see quadtree_refine.h.
    uint32_t split_frame; // the last frame in which its children stood for it
    bool is_near;         // in view, or nearly
    double range_m;       // nearer than this it is split
    double lod;           // continuous level
};

struct quadtree_nodes {
    const trl_context *ctx;
    const struct surface *surface;
    struct quadtree_heights heights;
    struct quadtree_node *all; // owned; tiles from 1, then blocks of four
    uint32_t capacity, end;    // end: from here on never used
    uint32_t frame;
    uint32_t made;     // since creation
    uint64_t revision; // of the surface
};

// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result quadtree_nodes_init(const struct surface *surface,
                                            struct quadtree_nodes *out);
void quadtree_nodes_finish(struct quadtree_nodes *nodes);

// The tile's node, number 1 to TILES_COUNT.
static inline uint32_t quadtree_root(int32_t tile)
{
    return (uint32_t)tile + 1;
}

// Gives nodes children that are not ready yet. Those that no longer fit stay without: false.
bool quadtree_nodes_add_children(struct quadtree_nodes *nodes, uint32_t parent);

// Nodes whose ground has become another are not ready any more. Before a frame's first look at any.
void quadtree_nodes_follow_surface(struct quadtree_nodes *nodes);

// Makes all that are not ready of `count` nodes. Their parents must be ready.
TRL_MUST_USE trl_result quadtree_nodes_make(struct quadtree_nodes *nodes, const uint32_t *indices,
                                            size_t count);

// The vertices of a node as the shader takes them: position from its origin in the planet frame and
// altitude, in m; of its own grid, of that of its parent, and of that of its parent's parent, which
// are the same surfaces that those draw.
enum { QUADTREE_GRIDS = 3 };
void quadtree_node_vertices(const struct quadtree_nodes *nodes, uint32_t index,
                            float out[QUADTREE_SIDE][QUADTREE_GRIDS][QUADTREE_SIDE][4]);

#endif // TERRAIN_QUADTREE_NODE_H
