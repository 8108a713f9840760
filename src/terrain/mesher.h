// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_MESHER_H
#define TERRAIN_MESHER_H
// Meshes of the ground behind one interface. A mesher knows heights only through struct surface.

#include "base/camera.h"
#include "gpu/target.h"
#include "terrain/surface.h"

enum mesher_kind {
    MESHER_HEMISPHERE, // Michelic 2019, Section 3
    MESHER_KIND_COUNT
};

// Of the last draw, and since creation.
struct mesher_stats {
    uint32_t triangles, draws, chunks;
    uint32_t projections; // times the mesh was made anew
};

struct mesher;
struct mesher_ops {
    trl_result (*update)(struct mesher *mesher, const struct camera *camera);
    trl_result (*draw)(struct mesher *mesher, const struct gpu_target *target);
    void (*destroy)(struct mesher *mesher);
};

// Base of each mesher. Owner: caller. Must not outlive its surface.
struct mesher {
    const struct mesher_ops *ops;
    struct mesher_stats stats;
};

// TRL_ERROR_UNSUPPORTED: a kind that is not there; TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result mesher_create(const struct surface *surface, enum mesher_kind kind,
                                      struct mesher **out);
void mesher_destroy(struct mesher **mesher);

// Makes the mesh fit the camera, which must be above the ground.
TRL_MUST_USE trl_result mesher_update(struct mesher *mesher, const struct camera *camera);

// Clears `target` and draws what the camera of the last update sees. Color 0, RGBA32F: position
// relative to the camera along planet axes in m, altitude above the reference sphere in m; 0, 0, 0,
// MESHER_NO_SURFACE where there is no ground. Depth: DEPTH32F, reversed, no far plane.
#define MESHER_NO_SURFACE (-1e9f)
TRL_MUST_USE trl_result mesher_draw(struct mesher *mesher, const struct gpu_target *target);

// Used by the above.
TRL_MUST_USE trl_result hemisphere_create(const struct surface *surface, struct mesher **out);

#endif // TERRAIN_MESHER_H
