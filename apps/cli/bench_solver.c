// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Seconds and memory for the light in the air, and for the table made of it.
#include "bench.h"

#include "bench_machine.h"

enum { DEFAULT_RUNS = 3 };

// Solves anew, without the cache, and says what that took.
static trl_result solve_once(const struct bench_job *job, const trl_scene *scene,
                             trl_atmosphere_stats *stats, double *peak_mb)
{
    trl_atmosphere_desc desc = trl_atmosphere_desc_default();
    desc.uses_cache = false;
    trl_atmosphere *atmosphere = NULL;
    bench_memory_reset();
    trl_result result = trl_atmosphere_create(job->app->ctx, scene, &desc, &atmosphere);
    *peak_mb = bench_memory_peak_mb();
    if (result == TRL_OK) {
        trl_atmosphere_read_stats(atmosphere, stats);
    }
    trl_atmosphere_destroy(&atmosphere);
    return result;
}

// Adds samples until one fails.
static trl_result add_all(struct bench_table *table, const struct bench_sample *samples, int count)
{
    trl_result result = TRL_OK;
    for (int i = 0; result == TRL_OK && i < count; i++) {
        result = bench_add(table, samples[i]);
    }
    return result;
}

static trl_result measure(const struct bench_job *job, bool wants_table)
{
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "earth.json", &scene);
    const int runs = bench_runs(job, DEFAULT_RUNS);
    for (int i = 0; result == TRL_OK && i < runs; i++) {
        trl_atmosphere_stats stats;
        double peak_mb = 0.0;
        result = solve_once(job, scene, &stats, &peak_mb);
        if (result != TRL_OK) {
            break;
        }
        const char *name = trl_scene_name(scene);
        const struct bench_sample solver[] = {{name, "solve", "s", stats.solve_s},
                                              {name, "orders", "1", (double)stats.orders},
                                              {name, "peak memory", "MB", peak_mb}};
        const struct bench_sample table[] = {
            {name, "table after solving", "s", stats.table_s},
            {name, "table", "MB", (double)stats.table_bytes / 1e6}};
        result = wants_table ? add_all(job->table, table, 2) : add_all(job->table, solver, 3);
    }
    trl_scene_destroy(&scene);
    return result;
}

trl_result bench_run_solver(const struct bench_job *job)
{
    return measure(job, false);
}

trl_result bench_run_tables(const struct bench_job *job)
{
    return measure(job, true);
}
