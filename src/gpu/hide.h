// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_HIDE_H
#define GPU_HIDE_H
// Takes pixels that something opaque will be drawn over out of passes before it: sets their depth
// to one at which none of these draws. A software rasteriser does not enter a shader there.

#include "gpu/pass.h"

struct gpu_hide {
    struct gpu *gpu;
    struct gpu_program program;
};

TRL_MUST_USE trl_result gpu_hide_init(struct gpu *gpu, struct gpu_hide *out);
void gpu_hide_finish(struct gpu_hide *hide);

#define GPU_HIDE_SQUARE 4 // pixels a side; shaders/lib/hide.frag and cloud/join.frag have it too
// R8, a texel for each square of the target's pixels: 1 where all of it is hidden. NULL: nothing
// is.
TRL_MUST_USE trl_result gpu_hide_draw(struct gpu_hide *hide, const struct gpu_texture *hidden,
                                      float depth, const struct gpu_target *target);

#endif // GPU_HIDE_H
