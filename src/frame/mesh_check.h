// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_MESH_CHECK_H
#define FRAME_MESH_CHECK_H
// How far the ground that a mesher draws is from the true one, in pixels of a picture. What is
// measured, and why so, is told in docs/bench.md under terrain-error.

#include "frame/mesh_truth.h"
#include "terrain/mesher.h"

struct mesh_check_desc {
    const trl_context *ctx;
    struct gpu *gpu;
    struct mesher *mesher;
    struct reference_caster truth; // its camera is the one to draw from
    uint32_t width, height;        // of the picture whose pixels are counted
    uint32_t step;                 // every step-th pixel of a row and of a column is looked at
};

// In pixels.
struct mesh_error {
    uint32_t places; // of the ground, looked at
    double shift_rms, shift_max;
    uint32_t edges; // places of silhouettes
    double edge_rms, edge_max;
    uint32_t lost_edges; // with none drawn within MESH_CHECK_MAX_EDGE; they count as that
    uint32_t holes;      // no ground where there is, far from silhouettes, or the reverse
    double new_cpu_ms; // processor time of the mesh's update and drawing, for the first time there
    double cpu_ms;     // and once more
};
#define MESH_CHECK_MAX_EDGE 16.0

// One view, checked.
struct mesh_check {
    const trl_context *ctx;
    struct camera camera;
    double radius_m;
    uint32_t columns, rows;
    double pixel; // on the image plane at distance 1
    // columns x rows x 4, lowest row first: position as drawn, relative to the camera, m; drawn
    // less true altitude, m; NAN where no ground is drawn.
    float *places; // owned
    struct mesh_error error;
};

// Columns and rows of the places that are looked at: what the truth is found for.
void mesh_check_size(const struct mesh_check_desc *desc, uint32_t size[2]);

// `truth` has silhouettes; NULL: shifts only. TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result mesh_check_init(const struct mesh_check_desc *desc,
                                        const struct mesh_truth *truth, struct mesh_check *out);
void mesh_check_finish(struct mesh_check *check);

// Of two views that follow each other in a flight: by how much ground that both show moved in the
// picture beyond what the camera's motion explains. Pixels of `after`.
struct mesh_change {
    uint32_t places;
    double rms, highest; // `highest`: 999 of 1000 places are below it
};
TRL_MUST_USE trl_result mesh_check_change(const struct mesh_check *before,
                                          const struct mesh_check *after, struct mesh_change *out);

#endif // FRAME_MESH_CHECK_H
