// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_PASS_H
#define GPU_PASS_H
// Drawing. A pass sets the whole render state, so that nothing relies on what another one, or an
// embedder, left. A zeroed gpu_state writes all colours, with no depth, culling or blending.
//
// Depth is reversed: projections map near to 1 and infinity to 0 in [0, 1]. Without
// has_clip_control the same matrices and tests work, but window depth is then (1 + z) / 2, whose
// steps are 6e-8 everywhere: draw near and far in two passes.

#include "gpu/mesh.h"
#include "gpu/program.h"
#include "gpu/target.h"

enum gpu_depth {
    GPU_DEPTH_ALWAYS = 0,
    GPU_DEPTH_NEARER, // reversed: greater
    GPU_DEPTH_NEARER_OR_EQUAL,
    GPU_DEPTH_EQUAL,
    GPU_DEPTH_FARTHER,   // reversed: less; drawn where something nearer already is
    GPU_DEPTH_LESS_EQUAL // the unreversed convention, for shadow maps
};
enum gpu_cull { GPU_CULL_NONE = 0, GPU_CULL_BACK, GPU_CULL_FRONT }; // counter-clockwise is front
enum gpu_blend {
    GPU_BLEND_NONE = 0,
    GPU_BLEND_ALPHA,         // rgb * a + below * (1 - a)
    GPU_BLEND_PREMULTIPLIED, // rgb + below * (1 - a)
    GPU_BLEND_ADD
};

struct gpu_state {
    enum gpu_depth depth;
    bool writes_depth;
    enum gpu_cull cull;
    enum gpu_blend blend;
    bool hides_color; // depth only
};

struct gpu_pass {
    const struct gpu_target *target;
    struct gpu_rect viewport; // a width of 0: all of the target
    struct gpu_rect scissor;  // a width of 0: none; clears are scissored too
    struct gpu_state state;
    bool clears_color;
    float color[4]; // for every color of the target
    bool clears_depth;
    float depth; // 0 is infinitely far
};

// Begins drawing. There is no end: a pass lasts until the next one.
void gpu_pass_begin(struct gpu *gpu, const struct gpu_pass *pass);

// One triangle over the whole viewport; program with vertex shader "lib/fullscreen.vert", which
// gives the fragment shader `in vec2 v_uv`, (0, 0) lower left to (1, 1). TRL_ERROR_GPU names
// `where`.
TRL_MUST_USE trl_result gpu_draw_fullscreen(struct gpu_program *program, const char *where);

// All of a mesh, `instances` times (1: as it is; 0: nothing).
TRL_MUST_USE trl_result gpu_draw_mesh(struct gpu_program *program, const struct gpu_mesh *mesh,
                                      uint32_t instances, const char *where);

// Part of a mesh: `count` indices from `first`, or vertices where it has no indices. Out of range
// is TRL_ERROR_INVALID.
struct gpu_draw_range {
    uint32_t first, count, instances;
};
TRL_MUST_USE trl_result gpu_draw_mesh_range(struct gpu_program *program,
                                            const struct gpu_mesh *mesh,
                                            struct gpu_draw_range range, const char *where);

#endif // GPU_PASS_H
