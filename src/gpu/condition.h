// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_CONDITION_H
#define GPU_CONDITION_H
// Draws that are left out when an earlier draw has left no pixel. The GPU decides; the CPU does not
// wait. OpenGL ES has no such thing: there all is drawn.

#include "gpu/gpu.h"

struct gpu_condition {
    struct gpu *gpu;
    uint32_t query;
    bool is_counted; // something, ever
};

TRL_MUST_USE trl_result gpu_condition_init(struct gpu *gpu, struct gpu_condition *out);
void gpu_condition_finish(struct gpu_condition *condition);

// Around the draws whose pixels are looked for: those that pass the depth test and are not
// discarded. Counts do not nest.
void gpu_condition_count(struct gpu_condition *condition);
void gpu_condition_counted(struct gpu_condition *condition);

// Around passes, clears among them, that happen only when there were such pixels. NULL, and one
// that has counted nothing: always.
void gpu_condition_begin(const struct gpu_condition *condition);
void gpu_condition_end(const struct gpu_condition *condition);

#endif // GPU_CONDITION_H
