// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The table of light that leaves the water: seconds, size, error.
#include "bench.h"

#include <terrella/water.h>

enum { DEFAULT_RUNS = 3 };

trl_result bench_run_water_tables(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "earth.json", &scene);
    const int runs = bench_runs(job, DEFAULT_RUNS);
    for (int i = 0; result == TRL_OK && i < runs; i++) {
        trl_water_table_stats stats;
        result = trl_water_table_measure(job->app->ctx, scene, &stats);
        const char *name = result == TRL_OK ? trl_scene_name(scene) : "";
        const struct bench_sample samples[] = {
            {name, "table", "s", stats.make_s},
            {name, "size", "MB", (double)stats.bytes / 1e6},
            {name, "mean error", "%", 100 * stats.mean_error},
            {name, "largest error", "%", 100 * stats.largest_error}};
        for (int k = 0; k < 4 && result == TRL_OK; k++) {
            result = bench_add(job->table, samples[k]);
        }
    }
    trl_scene_destroy(&scene);
    return result;
}
