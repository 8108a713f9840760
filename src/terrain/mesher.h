// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_MESHER_H
#define TERRAIN_MESHER_H
// Meshes of the ground behind one interface. A mesher knows heights only through struct surface.
//
// A new one is an enumerator of trl_mesher, its create function below, and a line in the table of
// mesher.c.

#include "base/camera.h"
#include "gpu/target.h"
#include "terrain/surface.h"
#include <terrella/renderer.h>

enum { MESHER_MAX_KINDS = 8 };

// Of the last draw, and since creation.
struct mesher_stats {
    uint32_t triangles, draws, chunks;
    uint32_t projections; // times the mesh was made anew
    uint64_t bytes;       // of GPU and CPU memory that it holds
};

struct mesher;
struct mesher_ops {
    trl_result (*update)(struct mesher *mesher, const struct camera *camera);
    trl_result (*draw)(struct mesher *mesher, const struct gpu_target *target);
    void (*destroy)(struct mesher *mesher);
};

// What the picture may show of a mesh that follows its errors, unless another is asked for, pixels.
#define MESHER_ERROR_PX 1.25

// Base of each mesher. Owner: caller. Must not outlive its surface.
struct mesher {
    const struct mesher_ops *ops;
    struct mesher_stats stats;
    double error_px; // wanted at most, for those that follow it; 0: MESHER_ERROR_PX
};

// NULL: there is no such mesher.
const char *mesher_name(trl_mesher kind);

// TRL_ERROR_UNSUPPORTED: a kind that is not there; TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result mesher_create(const struct surface *surface, trl_mesher kind,
                                      struct mesher **out);
void mesher_destroy(struct mesher **mesher);

// Makes the mesh fit the camera, which must be above the ground.
TRL_MUST_USE trl_result mesher_update(struct mesher *mesher, const struct camera *camera);

// Clears `target` and draws what the camera of the last update sees. Color 0, RGBA32F: position
// relative to the camera along planet axes in m, altitude above the reference sphere in m; 0, 0, 0,
// MESHER_NO_SURFACE where there is no ground. Depth: DEPTH32F, as terrain/depth.h says.
#define MESHER_NO_SURFACE (-1e9f)
TRL_MUST_USE trl_result mesher_draw(struct mesher *mesher, const struct gpu_target *target);

// The hemisphere's grid, see trl_renderer_set_hemisphere. Tessellation makes cells of its own.
enum { HEMISPHERE_CELLS = 1312, TESSELLATED_CELLS = 800 };
bool hemisphere_cells_are_good(uint32_t cells);

struct hemisphere_desc {
    uint32_t cells; // good ones; 0: as many as the mesher begins with
    bool is_tessellated;
};
TRL_MUST_USE trl_result hemisphere_create_of(const struct surface *surface,
                                             const struct hemisphere_desc *desc,
                                             struct mesher **out);

// Used by the above.
TRL_MUST_USE trl_result hemisphere_create(const struct surface *surface, struct mesher **out);
TRL_MUST_USE trl_result hemisphere_create_tessellated(const struct surface *surface,
                                                      struct mesher **out);
TRL_MUST_USE trl_result quadtree_create(const struct surface *surface, struct mesher **out);

#endif // TERRAIN_MESHER_H
