// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Milliseconds per ready frame, and where they go.
#include "bench.h"

#include <stdio.h>
#include <string.h>

enum { WARM_FRAMES = 3, DEFAULT_RUNS = 15, TIMINGS_MAX = 32 };

static const char *const bare_views[] = {"ground", "limb", "full-disc"};
static const struct number_size sizes[] = {{1024, 576}, {1920, 1080}};
enum { SIZE_COUNT = sizeof sizes / sizeof sizes[0] };

// One view at one size.
struct frame_case {
    const struct bench_job *job;
    trl_renderer *renderer;
    trl_view view;
    struct number_size size;
    char name[BENCH_NAME_MAX];
    bool is_moving;  // the camera moves from frame to frame
    bool has_passes; // the renderer measures passes; else whole frames are measured here
};

// "moving" before the metrics of moving frames.
static trl_result add_time(const struct frame_case *c, const char *metric, double ms)
{
    char words[BENCH_NAME_MAX];
    snprintf(words, sizeof words, "%s%.50s", c->is_moving ? "moving " : "", metric);
    return bench_add(c->job->table, (struct bench_sample){c->name, words, "ms", ms});
}

// What each pass takes on the GPU, all together, and what the calling thread takes for the maps of
// the sky.
static trl_result add_passes(const struct frame_case *c)
{
    trl_timing rows[TIMINGS_MAX];
    const size_t all = trl_renderer_timings(c->renderer, rows, TIMINGS_MAX);
    const size_t count = all < TIMINGS_MAX ? all : TIMINGS_MAX;
    trl_result result = TRL_OK;
    double sum_ms = 0.0;
    for (size_t i = 0; result == TRL_OK && i < count; i++) {
        const bool is_on_cpu = strcmp(rows[i].name, "sky maps") == 0;
        const double ms = is_on_cpu ? rows[i].cpu_ms : rows[i].gpu_ms;
        char metric[BENCH_NAME_MAX];
        snprintf(metric, sizeof metric, "pass %.32s%s", rows[i].name, is_on_cpu ? " (CPU)" : "");
        result = add_time(c, metric, ms);
        sum_ms += ms;
    }
    return result == TRL_OK ? add_time(c, "passes together", sum_ms) : result;
}

// The camera climbs while it moves, so that all that depends on its place is made anew.
static void move_camera(struct frame_case *c)
{
    c->view.altitude_m *= 1.001;
    c->view.longitude_rad += 1e-5;
}

static trl_result draw_frame(const struct frame_case *c, double *spent_ms)
{
    trl_renderer_wait(c->renderer);
    const double begun_s = progress_clock_s();
    const trl_result result = bench_draw(c->job, c->renderer, &c->view, c->size, 0.02);
    trl_renderer_wait(c->renderer);
    *spent_ms = 1e3 * (progress_clock_s() - begun_s);
    return result;
}

static trl_result draw_case(struct frame_case *c)
{
    const int runs = bench_runs(c->job, DEFAULT_RUNS);
    trl_result result = TRL_OK;
    for (int i = 0; result == TRL_OK && i < WARM_FRAMES + runs; i++) {
        double spent_ms = 0.0;
        if (c->is_moving) {
            move_camera(c);
        }
        result = draw_frame(c, &spent_ms);
        if (!progress_report(&c->job->app->progress, c->name, (double)i / (WARM_FRAMES + runs))) {
            report_error(EXIT_FAILED, "cancelled while drawing %s", c->name);
            return TRL_ERROR_CANCELLED;
        }
        if (result == TRL_OK && i >= WARM_FRAMES) {
            result = c->has_passes ? add_passes(c) : add_time(c, "frame", spent_ms);
        }
    }
    return result;
}

// One view at every size, and moving at the smallest; `c` brings job and renderer.
static trl_result draw_view(struct frame_case *c, const trl_scene *scene, const char *name)
{
    trl_result result = trl_scene_view(scene, name, &c->view);
    for (int s = 0; result == TRL_OK && s < SIZE_COUNT; s++) {
        c->size = sizes[s];
        snprintf(c->name, sizeof c->name, "%.40s %ux%u", name, c->size.width, c->size.height);
        c->is_moving = false;
        result = draw_case(c);
        if (result == TRL_OK && s == 0) {
            const trl_view still = c->view;
            c->is_moving = true;
            result = draw_case(c);
            c->view = still;
        }
    }
    return result;
}

// Waiting for each pass takes time of its own, so frames and passes come from two renderers.
static trl_result draw_views(const struct bench_job *job, const trl_scene *scene, bool has_passes)
{
    trl_renderer_desc desc = bench_renderer_desc(job, scene);
    desc.measures_time = has_passes;
    struct frame_case c = {.job = job, .has_passes = has_passes};
    trl_result result = trl_renderer_create(job->app->ctx, &desc, &c.renderer);
    const size_t count =
        job->scene ? trl_scene_view_count(scene) : sizeof bare_views / sizeof bare_views[0];
    for (size_t i = 0; result == TRL_OK && i < count; i++) {
        result = draw_view(&c, scene, job->scene ? trl_scene_view_name(scene, i) : bare_views[i]);
        bench_show(job);
    }
    trl_renderer_destroy(&c.renderer);
    return result;
}

trl_result bench_run_sky_frame(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "bare-sphere.json", &scene);
    if (result == TRL_OK) {
        result = draw_views(job, scene, false);
    }
    if (result == TRL_OK) {
        result = draw_views(job, scene, true);
    }
    trl_scene_destroy(&scene);
    return result;
}
