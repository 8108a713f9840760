// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_PROJECTIVE_ROWS_H
#define TERRAIN_PROJECTIVE_ROWS_H
// At which angle from the nadir, seen from the planet's centre, the rows of a projective grid lie.
// Coarse probes of the ground find what is in the picture; a reduction over them gives the primary
// reference sphere of PGM, or weights by which rows are placed. All of it on the GPU, in the frame
// that it is for: nothing is read back, and no picture depends on the one before.
//
//     probes   RG32F     shaders/terrain/projective_probe.frag
//     highest  R32F      shaders/terrain/projective_blocks.frag
//     seen     RGBA32F   shaders/terrain/projective_seen.frag
//     weights  RGBA32F   shaders/terrain/projective_weights.frag, one for each ring
//     rows     R32F      shaders/terrain/projective_rows.frag, one for each row

#include "gpu/target.h"
#include "terrain/height_programs.h"
#include "terrain/sampling_camera.h"
#include <terrella/renderer.h>

// What a pass draws into.
struct projective_map {
    struct gpu_texture texture;
    struct gpu_target target;
};

enum { PROJECTIVE_MAPS = 5 };

// Must not outlive the surface.
struct projective_rows {
    struct gpu *gpu;
    const struct surface *surface;
    uint32_t count;
    trl_projective_rows placing;
    struct height_programs probes;
    struct gpu_program programs[PROJECTIVE_MAPS]; // of the maps behind the first
    struct projective_map maps[PROJECTIVE_MAPS];
    struct gpu_texture rings; // R32F, gamma of each
};

struct projective_rows_desc {
    uint32_t count; // even
    trl_projective_rows placing;
};

// TRL_ERROR_GPU; TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result projective_rows_init(const struct surface *surface,
                                             const struct projective_rows_desc *desc,
                                             struct projective_rows *out);
void projective_rows_finish(struct projective_rows *rows);

struct projective_rows_inputs {
    const struct sampling_camera *camera;
    const struct gpu_texture *columns; // sampling_camera_columns
    uint32_t column_count;
};
TRL_MUST_USE trl_result projective_rows_draw(struct projective_rows *rows,
                                             const struct projective_rows_inputs *inputs);

// Of GPU memory.
uint64_t projective_rows_bytes(const struct projective_rows *rows);

// R32F, `count` x 1: ascending from 0 to the reach.
const struct gpu_texture *projective_rows_texture(const struct projective_rows *rows);

// Sets u_eye, u_rings and u_columns of shaders/terrain/projective.glsl.
void projective_rows_bind(const struct projective_rows *rows,
                          const struct projective_rows_inputs *inputs, struct gpu_program *program);

#endif // TERRAIN_PROJECTIVE_ROWS_H
