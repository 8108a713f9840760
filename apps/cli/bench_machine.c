// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "bench_machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// The text behind "key<blanks>:<blanks>" of the first such line of a file of /proc; "" when there
// is none.
static void read_proc_line(const char *path, const char *key, char *out, size_t size)
{
    out[0] = '\0';
    FILE *file = fopen(path, "r");
    char line[512];
    while (file && !out[0] && fgets(line, sizeof line, file)) {
        const char *colon = strchr(line, ':');
        if (colon && strncmp(line, key, strlen(key)) == 0) {
            const char *value = colon + 1 + strspn(colon + 1, " \t");
            snprintf(out, size, "%.*s", (int)strcspn(value, "\n"), value);
        }
    }
    if (file) {
        fclose(file);
    }
}

void bench_machine_read(trl_context *ctx, struct bench_machine *out)
{
    *out = (struct bench_machine){.cores = (int)sysconf(_SC_NPROCESSORS_ONLN)};
    read_proc_line("/proc/cpuinfo", "model name", out->cpu, sizeof out->cpu);
    if (!out->cpu[0]) {
        snprintf(out->cpu, sizeof out->cpu, "unknown processor");
    }
    if (getloadavg(&out->load_average, 1) != 1) {
        out->load_average = 0.0;
    }
    trl_gpu_info gpu;
    const bool has_gl = trl_gpu_info_read(ctx, &gpu) == TRL_OK;
    snprintf(out->gl_renderer, sizeof out->gl_renderer, "%s", has_gl ? gpu.renderer : "none");
}

void bench_memory_reset(void)
{
    FILE *file = fopen("/proc/self/clear_refs", "w");
    if (file) {
        fputs("5", file); // proc(5): resets the peak resident set size
        fclose(file);
    }
}

double bench_memory_peak_mb(void)
{
    char text[64];
    read_proc_line("/proc/self/status", "VmHWM", text, sizeof text);
    return strtod(text, NULL) * 1024.0 / 1e6; // the kernel counts in KiB
}
