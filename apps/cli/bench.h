// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_BENCH_H
#define CLI_BENCH_H
// What the benches share: samples gathered into rows.

#include "app.h"

enum { BENCH_MAX_ROWS = 256, BENCH_MAX_RUNS = 1000, BENCH_NAME_MAX = 64 };

// One quantity of one case, measured some times.
struct bench_row {
    char case_name[BENCH_NAME_MAX];
    char metric[BENCH_NAME_MAX];
    const char *unit;
    double *samples; // owned; BENCH_MAX_RUNS of them
    int runs;
};

struct bench_table {
    struct bench_row rows[BENCH_MAX_ROWS];
    int row_count;
};

// What a bench is run with.
struct bench_job {
    struct app *app;
    const char *scene; // file given by the user; NULL: the bench's own
    int runs;          // 0: the bench's own number
    struct bench_table *table;
};

struct bench_sample {
    const char *case_name;
    const char *metric;
    const char *unit; // a literal
    double value;
};

// Adds a sample to the row of its case and metric, which appears in the order of first use.
// TRL_ERROR_MEMORY when there is no place for it.
trl_result bench_add(struct bench_table *table, struct bench_sample sample);

// The job's scene, or the one of that name that ships with the program. Errors are reported.
trl_result bench_load_scene(const struct bench_job *job, const char *file, trl_scene **out);

static inline int bench_runs(const struct bench_job *job, int fallback)
{
    return job->runs > 0 ? job->runs : fallback;
}

trl_result bench_run_solver(const struct bench_job *job);
trl_result bench_run_tables(const struct bench_job *job);
trl_result bench_run_sky_frame(const struct bench_job *job);
trl_result bench_run_start(const struct bench_job *job);

#endif // CLI_BENCH_H
