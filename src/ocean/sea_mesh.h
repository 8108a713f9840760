// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_SEA_MESH_H
#define OCEAN_SEA_MESH_H
// The sea as waves move it: a mesh of rings about the eye, as far as waves are higher than half a
// pixel, joined with the positions of the ground. From higher up nothing is drawn, and it costs
// nothing. docs/physics.md, *Waves that stand out*.

#include "base/camera.h"
#include "gpu/condition.h"
#include "gpu/mesh.h"
#include "gpu/target.h"
#include "ocean/wave_texture.h"
#include "shared/sea_grid.glsl"
#include "terrain/height_programs.h"

// What a view needs of it.
struct sea_mesh_plan {
    bool is_seen;
    SeaGrid grid;
    double eye_height_m; // above level water
    double east_m,
        north_m; // from below the eye to the place that waves move there: the rings' middle
};

// `pixel_rad`: angle of a pixel. Waves of that significant height.
struct sea_mesh_plan sea_mesh_plan_make(const struct camera *camera, double radius_m,
                                        double height_m, double pixel_rad);

struct sea_mesh {
    struct gpu *gpu;
    const struct surface *surface;
    struct wave_texture *waves;
    double wave_height_m;
    struct height_programs shore_programs;
    struct gpu_program open_program, crest_program, join_program, mesh_program;
    struct gpu_condition is_open; // some vertex is
    struct gpu_texture shore, crests, normals;
    struct gpu_target shore_target, crest_target;
    struct gpu_mesh mesh;
    struct gpu_texture position, level; // of the picture: see shaders/ocean/join.frag
    struct gpu_target target;
    struct sea_mesh_plan plan;
};

// Waves and surface must outlive it. TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result sea_mesh_init(const struct surface *surface, struct wave_texture *waves,
                                      struct sea_mesh *out);
void sea_mesh_finish(struct sea_mesh *mesh);

// `depth`, DEPTH32F of that size, is drawn over.
TRL_MUST_USE trl_result sea_mesh_resize(struct sea_mesh *mesh, const struct gpu_texture *depth);

// Plans, and draws `position` and `level` where the plan has something to see; else they hold
// nothing.
struct sea_mesh_inputs {
    const struct camera *camera;
    double time_s;
    const struct gpu_texture *ground; // positions, of frame/ground.h
};
TRL_MUST_USE trl_result sea_mesh_draw(struct sea_mesh *mesh, const struct sea_mesh_inputs *inputs);

#endif // OCEAN_SEA_MESH_H
