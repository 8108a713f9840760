// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_MESH_TRUTH_H
#define FRAME_MESH_TRUTH_H
// The true ground of one view: a ray through each of its places, and the silhouettes between them.
// Found once, however many meshes are judged by it.

#include "reference/caster.h"

// A silhouette in a column of the picture: it parts what is nearer than `parting_m` from the rest.
struct mesh_edge {
    double row;       // rows from the lower border of the picture; NAN: there is none
    double parting_m; // INFINITY: the sky is one of its sides
    bool is_near_below;
};

struct mesh_truth {
    const trl_context *ctx; // NULL: empty
    uint32_t columns, rows;
    struct reference_hit *hits; // owned; columns x rows, lowest row first
    struct mesh_edge *edges;    // owned; the same, each above its place; NULL: not looked for
};

// Casts the rays, on all cores. TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result mesh_truth_init(const trl_context *ctx,
                                        const struct reference_caster *caster,
                                        const uint32_t size[2], struct mesh_truth *out);
void mesh_truth_finish(struct mesh_truth *truth);

// Looks for the silhouettes of the same caster's picture, unless that is done. TRL_ERROR_MEMORY;
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result mesh_truth_find_edges(struct mesh_truth *truth,
                                              const struct reference_caster *caster);

#endif // FRAME_MESH_TRUTH_H
