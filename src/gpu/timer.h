// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_TIMER_H
#define GPU_TIMER_H
// How long named parts of a frame took on the GPU. Without has_timer_query every call is a no-op
// and no rows come.

#include "gpu/gpu.h"

enum { GPU_TIMER_MAX_SCOPES = 64 };

struct gpu_timer_row {
    const char *name; // as given to gpu_timer_begin; must be a literal or outlive the timer
    double ms;
};

struct gpu_timer {
    struct gpu *gpu;
    uint32_t queries[GPU_TIMER_MAX_SCOPES];
    const char *names[GPU_TIMER_MAX_SCOPES];
    size_t count; // scopes since the last collect; those beyond the maximum are not timed
    bool is_open; // between begin and end
};

TRL_MUST_USE trl_result gpu_timer_init(struct gpu *gpu, struct gpu_timer *out);
void gpu_timer_finish(struct gpu_timer *timer);

// Scopes do not nest: a begin ends the one that is open. timer == NULL is a no-op, so that passes
// can be handed no timer.
void gpu_timer_begin(struct gpu_timer *timer, const char *name);
void gpu_timer_end(struct gpu_timer *timer);

// Waits for the GPU, writes a row for each scope since the last collect, in order, and forgets
// them; scopes of one name that follow each other are not joined. Returns how many there are, at
// most `capacity`.
size_t gpu_timer_collect(struct gpu_timer *timer, struct gpu_timer_row *rows, size_t capacity);

#endif // GPU_TIMER_H
