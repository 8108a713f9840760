// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_CLOCK_H
#define FRAME_CLOCK_H
// Times of the parts of a frame, on the GPU and on the calling thread.

#include "gpu/timer.h"
#include <terrella/renderer.h>

struct frame_clock {
    bool is_on; // when off, every call but init is a no-op and there are no rows
    struct gpu_timer timer;
    size_t count; // parts of the frame that runs, or of the last one
    trl_timing rows[GPU_TIMER_MAX_SCOPES];
    double begun_s; // when the open part began
    bool is_open;
};

TRL_MUST_USE trl_result frame_clock_init(struct gpu *gpu, bool is_on, struct frame_clock *out);
void frame_clock_finish(struct frame_clock *clock);

// Forgets the last frame.
void frame_clock_start(struct frame_clock *clock);
// Ends the part that is open and begins another; the name is a literal.
void frame_clock_part(struct frame_clock *clock, const char *name);
// Ends the last part and waits for the GPU's times.
void frame_clock_stop(struct frame_clock *clock);

#endif // FRAME_CLOCK_H
