// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/clock.h"

#include <time.h>

static double read_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

trl_result frame_clock_init(struct gpu *gpu, bool is_on, struct frame_clock *out)
{
    *out = (struct frame_clock){.is_on = is_on};
    return is_on ? gpu_timer_init(gpu, &out->timer) : TRL_OK;
}

void frame_clock_finish(struct frame_clock *clock)
{
    gpu_timer_finish(&clock->timer);
    *clock = (struct frame_clock){0};
}

void frame_clock_start(struct frame_clock *clock)
{
    clock->count = 0;
    clock->is_open = false;
}

static void end_part(struct frame_clock *clock)
{
    if (clock->is_open) {
        clock->rows[clock->count - 1].cpu_ms = 1e3 * (read_seconds() - clock->begun_s);
        clock->is_open = false;
    }
}

void frame_clock_part(struct frame_clock *clock, const char *name)
{
    if (!clock->is_on || clock->count == GPU_TIMER_MAX_SCOPES) {
        return;
    }
    end_part(clock);
    gpu_timer_begin(&clock->timer, name);
    clock->rows[clock->count++] = (trl_timing){.name = name};
    clock->begun_s = read_seconds();
    clock->is_open = true;
}

void frame_clock_stop(struct frame_clock *clock)
{
    if (!clock->is_on) {
        return;
    }
    end_part(clock);
    gpu_timer_end(&clock->timer);
    struct gpu_timer_row rows[GPU_TIMER_MAX_SCOPES];
    const size_t count = gpu_timer_collect(&clock->timer, rows, GPU_TIMER_MAX_SCOPES);
    // The GPU's rows are those of the parts, in the same order; without timer queries there are
    // none.
    for (size_t i = 0; i < count && i < clock->count; i++) {
        clock->rows[i].gpu_ms = rows[i].ms;
    }
}
