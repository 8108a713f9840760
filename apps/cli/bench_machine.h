// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_BENCH_MACHINE_H
#define CLI_BENCH_MACHINE_H
// On what a bench ran, and how much memory it took. Linux.

#include <terrella/renderer.h>

struct bench_machine {
    char cpu[128];
    int cores;             // in use by the system
    double load_average;   // over the last minute, before the benches
    char gl_renderer[128]; // "none" without OpenGL
};

void bench_machine_read(trl_context *ctx, struct bench_machine *out);

// Starts a new measurement of the process's largest memory.
void bench_memory_reset(void);

// The largest resident memory since then, in MB. 0 when the system does not tell.
double bench_memory_peak_mb(void);

#endif // CLI_BENCH_MACHINE_H
