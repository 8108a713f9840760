// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_SINGLE_SPHERES_H
#define SKY_SINGLE_SPHERES_H
// Two tessellated spheres, the air's boundary and the ground, as Schafhitzel 2007 draws them and
// measures in Table 2: their fragments look the table up, or show what their vertices have
// integrated.

#include "gpu/mesh.h"
#include "sky/pixels.h"

struct single_spheres {
    struct gpu *gpu;
    struct gpu_mesh mesh;                 // of directions
    uint32_t side;                        // it has side x side vertices; 0: not made yet
    struct gpu_program air[2], ground[2]; // looked up, integrated; made with the mesh
};

// Makes mesh and programs for the view's spheres, or nothing when they are there. `channels` as in
// struct single_tables.
TRL_MUST_USE trl_result single_spheres_prepare(struct single_spheres *spheres, struct gpu *gpu,
                                               const struct sky_spheres *wanted, int channels);
void single_spheres_finish(struct single_spheres *spheres);

// Draws air or ground by one of the programs; the caller has set its uniforms but those of
// ray.glsl and sphere.vert. The air clears the target.
TRL_MUST_USE trl_result single_spheres_draw(struct single_spheres *spheres,
                                            const struct sky_pixels *pixels,
                                            struct gpu_program *program,
                                            const struct sky_view *view);

#endif // SKY_SINGLE_SPHERES_H
