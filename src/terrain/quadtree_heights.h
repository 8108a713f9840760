// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_QUADTREE_HEIGHTS_H
#define TERRAIN_QUADTREE_HEIGHTS_H
// Heights of the ground on grids of the quadtree's squares: by a fragment pass, many squares in one
// texture, or on the CPU where a grid is finer than the data and floats would show.

#include "gpu/target.h"
#include "terrain/height_programs.h"
#include "terrain/quadtree_tiles.h"
#include "terrain/surface.h"

enum {
    QUADTREE_CELLS = 16, // of a square, in each direction
    QUADTREE_SIDE = QUADTREE_CELLS + 1,
    QUADTREE_VERTICES = QUADTREE_SIDE * QUADTREE_SIDE
};

// What is asked of one square.
struct quadtree_sample {
    const struct tiles_place *place;
    bool is_exact;          // on the CPU
    struct surface_eye eye; // else: in whose reach layers matter
    double datum_m;         // about where the ground is: floats on the GPU count from there
    double cell_m;          // heights at vertices are means over cells of this size
    double *vertices;       // QUADTREE_VERTICES, row by row from the lower left
    double middles[QUADTREE_CELLS * QUADTREE_CELLS]; // the ground as fine as it is known
};

struct quadtree_heights {
    const struct surface *surface;
    struct height_programs programs;
    struct gpu_texture places, heights;
    struct gpu_target target;
    float *staging; // owned
    uint64_t bytes; // of memory that all this takes
};

// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result quadtree_heights_init(const struct surface *surface,
                                              struct quadtree_heights *out);
void quadtree_heights_finish(struct quadtree_heights *heights);

// At most QUADTREE_BATCH at once. Waits for the GPU.
enum { QUADTREE_BATCH = 256 };
TRL_MUST_USE trl_result quadtree_heights_sample(struct quadtree_heights *heights,
                                                struct quadtree_sample *samples, size_t count);

// Place of a vertex of a square, in tiles from the corner of its face; halves are middles of cells.
void quadtree_vertex_uv(const struct tiles_place *place, double i, double j, double uv[2]);

#endif // TERRAIN_QUADTREE_HEIGHTS_H
