// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_BENCH_H
#define CLI_BENCH_H
// What the benches share: samples gathered into rows, and what a paper says of the same.
//
// A new bench is a function here, in a file of its own, and a line in the list of bench.c.

#include "bench_table.h"

// What a bench is run with.
struct bench_job {
    struct app *app;
    const char *scene; // file given by the user; NULL: the bench's own
    int runs;          // 0: the bench's own number
    int shrink;        // pictures that are timed are that many times narrower and lower
    int mesher;        // a trl_mesher; -1: the default, or all where they are compared
    bool is_json;      // nothing is printed before the end
    struct bench_table *table;
};

// The job's scene, or the one of that name that ships with the program. Errors are reported.
trl_result bench_load_scene(const struct bench_job *job, const char *file, trl_scene **out);

static inline int bench_runs(const struct bench_job *job, int fallback)
{
    return job->runs > 0 ? job->runs : fallback;
}

// Prints for people the rows that were measured since the last call: a long bench calls it when all
// samples of a case are there.
void bench_show(const struct bench_job *job);

// A renderer's description with the scene and the job's mesher.
trl_renderer_desc bench_renderer_desc(const struct bench_job *job, const trl_scene *scene);

// Draws a picture of which the time alone is wanted, smaller by the job's `shrink`.
trl_result bench_draw(const struct bench_job *job, trl_renderer *renderer, const trl_view *view,
                      struct number_size size, double frame_s);

// Of a pass of the last frame, on the GPU where there are timer queries.
double bench_timing_ms(const trl_timing *timing);
// The same by the pass's name; 0: the frame had none.
double bench_pass_ms(const trl_renderer *renderer, const char *pass);

trl_result bench_run_solver(const struct bench_job *job);
trl_result bench_run_terrain_error(const struct bench_job *job);
trl_result bench_run_tables(const struct bench_job *job);
trl_result bench_run_sky_frame(const struct bench_job *job);
trl_result bench_run_start(const struct bench_job *job);
trl_result bench_run_clouds(const struct bench_job *job);
trl_result bench_run_cloud_error(const struct bench_job *job);
trl_result bench_run_cloud_frame(const struct bench_job *job);
trl_result bench_run_stream(const struct bench_job *job);
trl_result bench_run_elek_precompute(const struct bench_job *job);
trl_result bench_run_elek_fps(const struct bench_job *job);
trl_result bench_run_elek_rgb(const struct bench_job *job);
trl_result bench_run_schafhitzel_table1(const struct bench_job *job);
trl_result bench_run_schafhitzel_table2(const struct bench_job *job);
trl_result bench_run_santana_samples(const struct bench_job *job);
trl_result bench_run_santana_spectrum(const struct bench_job *job);
trl_result bench_run_santana_fit(const struct bench_job *job);
trl_result bench_run_michelic_table1(const struct bench_job *job);
trl_result bench_run_water_tables(const struct bench_job *job);
trl_result bench_run_water_error(const struct bench_job *job);
trl_result bench_run_michelic_table2(const struct bench_job *job);
trl_result bench_run_ocean_frame(const struct bench_job *job);
trl_result bench_run_michelic_frame(const struct bench_job *job);
trl_result bench_run_pgm_fps(const struct bench_job *job);

#endif // CLI_BENCH_H
