// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How far each mesh of the ground is from the truth, and what it costs. docs/bench.md tells what is
// measured.
#include "bench_terrain.h"

#include <math.h>
#include <stdio.h>
#include <terrella/ground.h>

enum {
    DEFAULT_FRAMES = 3,
    FLIGHT_FRAMES = 120,
    STEP = 8, // of the pixels along a row and a column, one in so many is looked at
    MAX_MESHERS = 16
};
static const struct number_size SCREEN = {1024, 576};

// What is summed up over all views of a mesher.
struct tally {
    double error2_px2, time_ms, worst_rms_px;
};

struct terrain_bench {
    const struct bench_job *job;
    const trl_scene *scene;
    struct bench_terrain_views views;
    trl_ground *ground;
    trl_renderer *renderer;
    struct tally tallies[MAX_MESHERS];
};

static const char *name_mesher(const struct terrain_bench *b)
{
    return trl_mesher_name(trl_renderer_mesher(b->renderer));
}

static struct tally *find_tally(struct terrain_bench *b)
{
    return &b->tallies[trl_renderer_mesher(b->renderer)];
}

static trl_result add(const struct terrain_bench *b, const char *where, struct bench_sample sample)
{
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "%.40s, %.20s", where, name_mesher(b));
    sample.case_name = name;
    return bench_add(b->job->table, sample);
}

static trl_result report(const struct terrain_bench *b, const char *what, double fraction)
{
    if (progress_report(&b->job->app->progress, what, fraction)) {
        return TRL_OK;
    }
    report_error(EXIT_FAILED, "cancelled while measuring %s", what);
    return TRL_ERROR_CANCELLED;
}

// Of the passes "vertices" and "mesh", which together are what a mesher does.
static double find_mesh_ms(const trl_renderer *renderer)
{
    return bench_pass_ms(renderer, "vertices") + bench_pass_ms(renderer, "mesh");
}

// The first frame from a place makes the mesh for it; the next ones draw it.
static trl_result time_view(struct terrain_bench *b, const struct bench_terrain_view *view)
{
    const int frames = bench_runs(b->job, DEFAULT_FRAMES);
    double least_ms = (double)INFINITY;
    trl_result result = TRL_OK;
    for (int i = 0; result == TRL_OK && i <= frames; i++) {
        result = trl_renderer_draw(b->renderer, &view->view, SCREEN.width, SCREEN.height, 0);
        const double ms = find_mesh_ms(b->renderer);
        if (result == TRL_OK) {
            result = add(b, view->name,
                         (struct bench_sample){NULL, i == 0 ? "mesh made anew" : "mesh", "ms", ms});
        }
        least_ms = i > 0 ? fmin(least_ms, ms) : least_ms;
    }
    find_tally(b)->time_ms += least_ms;
    return result;
}

static trl_result add_error(struct terrain_bench *b, const char *where, const trl_mesh_error *e)
{
    trl_mesh_stats stats;
    trl_result result = trl_renderer_mesh_stats(b->renderer, &stats);
    const struct bench_sample rows[] = {
        {NULL, "shift, RMS", "px", e->shift_rms_px},
        {NULL, "shift, largest", "px", e->shift_max_px},
        {NULL, "silhouette, RMS", "px", e->edge_rms_px},
        {NULL, "silhouette, largest", "px", e->edge_max_px},
        {NULL, "silhouettes not found", "%", e->edges ? 100.0 * e->lost_edges / e->edges : 0},
        {NULL, "holes", "", e->holes},
        {NULL, "processor time", "ms", e->cpu_ms},
        {NULL, "triangles", "", stats.triangles},
        {NULL, "mesher's memory", "MB", 1e-6 * (double)stats.bytes}};
    for (size_t i = 0; result == TRL_OK && i < sizeof rows / sizeof *rows; i++) {
        result = add(b, where, rows[i]);
    }
    const double rms_px = fmax(e->shift_rms_px, e->edge_rms_px);
    struct tally *tally = find_tally(b);
    tally->worst_rms_px = fmax(tally->worst_rms_px, rms_px);
    tally->error2_px2 += rms_px * rms_px;
    return result;
}

static trl_result measure_view(struct terrain_bench *b, const struct bench_terrain_view *view)
{
    trl_mesh_check_desc desc = trl_mesh_check_desc_default();
    desc.view = &view->view;
    desc.width = SCREEN.width;
    desc.height = SCREEN.height;
    desc.step = STEP;
    trl_mesh_check *check = NULL;
    trl_result result = trl_mesh_check_create(b->ground, b->renderer, &desc, &check);
    if (result == TRL_OK) {
        const trl_mesh_error error = trl_mesh_check_error(check);
        result = add_error(b, view->name, &error);
    }
    trl_mesh_check_destroy(&check);
    return result;
}

static trl_result fly(struct terrain_bench *b)
{
    trl_mesh_check *before = NULL;
    trl_mesh_change worst = {0};
    double worst_px = 0, shift2_px2 = 0, sum_ms = 0, most_ms = 0;
    trl_result result = TRL_OK;
    for (int i = 0; result == TRL_OK && i < FLIGHT_FRAMES; i++) {
        const trl_view view = bench_terrain_flight(&b->views, i, FLIGHT_FRAMES);
        trl_mesh_check_desc desc = trl_mesh_check_desc_default();
        desc.view = &view;
        desc.width = SCREEN.width;
        desc.height = SCREEN.height;
        desc.step = STEP;
        desc.has_edges = false;
        trl_mesh_check *check = NULL;
        trl_mesh_change change = {0};
        result = trl_mesh_check_create(b->ground, b->renderer, &desc, &check);
        if (result == TRL_OK && before) {
            result = trl_mesh_check_change(before, check, &change);
        }
        const trl_mesh_error error = trl_mesh_check_error(check);
        shift2_px2 += error.shift_rms_px * error.shift_rms_px;
        sum_ms += error.new_cpu_ms;
        most_ms = fmax(most_ms, i > 0 ? error.new_cpu_ms : 0); // the first compiles
        worst = change.rms_px > worst.rms_px ? change : worst;
        worst_px = fmax(worst_px, change.highest_px);
        trl_mesh_check_destroy(&before);
        before = check;
        result = result == TRL_OK ? report(b, "flight", (double)i / FLIGHT_FRAMES) : result;
    }
    trl_mesh_check_destroy(&before);
    const struct bench_sample rows[] = {
        {NULL, "shift, RMS", "px", sqrt(shift2_px2 / FLIGHT_FRAMES)},
        {NULL, "processor time, mean", "ms", sum_ms / FLIGHT_FRAMES},
        {NULL, "processor time, largest", "ms", most_ms},
        {NULL, "popping, RMS", "px", worst.rms_px},
        {NULL, "popping, 999 of 1000", "px", worst_px}};
    for (size_t i = 0; result == TRL_OK && i < sizeof rows / sizeof *rows; i++) {
        result = add(b, "flight", rows[i]);
    }
    return result;
}

static trl_result measure_view_and_time(struct terrain_bench *b,
                                        const struct bench_terrain_view *view)
{
    const trl_result result = time_view(b, view);
    return result == TRL_OK ? measure_view(b, view) : result;
}

static trl_result sum_up(struct terrain_bench *b)
{
    trl_result result = b->views.has_flight ? fly(b) : TRL_OK;
    const struct tally *tally = find_tally(b);
    const int count = b->views.count > 0 ? b->views.count : 1;
    const double rms_px = sqrt(tally->error2_px2 / count), ms = tally->time_ms / count;
    const struct bench_sample rows[] = {{NULL, "worst RMS", "px", tally->worst_rms_px},
                                        {NULL, "RMS", "px", rms_px},
                                        {NULL, "mesh, mean", "ms", ms},
                                        {NULL, "RMS x mesh", "px ms", rms_px * ms}};
    for (size_t i = 0; result == TRL_OK && i < sizeof rows / sizeof *rows; i++) {
        result = add(b, "all views", rows[i]);
    }
    return result;
}

// The tessellated one draws what the hemisphere draws: it is measured when named.
static bool is_meant(const struct terrain_bench *b, int mesher)
{
    return b->job->mesher < 0 ? mesher != TRL_MESHER_TESSELLATED : b->job->mesher == mesher;
}

// One view by all meshers (or, without one, what follows from all), so that rays are cast once.
static trl_result measure_meshers(struct terrain_bench *b, const struct bench_terrain_view *view)
{
    trl_result result = TRL_OK;
    for (int m = 0; result == TRL_OK && m < MAX_MESHERS && trl_mesher_name((trl_mesher)m); m++) {
        if (is_meant(b, m)) {
            result = trl_renderer_set_mesher(b->renderer, (trl_mesher)m);
            if (result == TRL_OK) {
                result = view ? measure_view_and_time(b, view) : sum_up(b);
                bench_show(b->job);
            }
        }
    }
    return result;
}

static trl_result measure(struct terrain_bench *b)
{
    trl_renderer_desc desc = bench_renderer_desc(b->job, b->scene);
    desc.measures_time = true;
    trl_context *ctx = b->job->app->ctx;
    trl_result result = bench_terrain_choose_views(b->scene, &b->views);
    result = result == TRL_OK ? trl_ground_create(ctx, b->scene, &b->ground) : result;
    result = result == TRL_OK ? trl_renderer_create(ctx, &desc, &b->renderer) : result;
    for (int i = 0; result == TRL_OK && i < b->views.count; i++) {
        result = report(b, b->views.of[i].name, (double)i / b->views.count);
        result = result == TRL_OK ? measure_meshers(b, &b->views.of[i]) : result;
    }
    result = result == TRL_OK ? measure_meshers(b, NULL) : result;
    trl_renderer_destroy(&b->renderer);
    trl_ground_destroy(&b->ground);
    return result;
}

trl_result bench_run_terrain_error(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    struct terrain_bench b = {.job = job};
    trl_result result = bench_load_scene(job, "earth.json", &scene);
    if (result == TRL_OK) {
        b.scene = scene;
        result = measure(&b);
    }
    trl_scene_destroy(&scene);
    bench_note(
        job->table,
        "Errors in pixels of %u x %u. Shift: where the truth shows what is drawn at a pixel; "
        "silhouettes: at a right angle. Goal: every RMS below 1.",
        SCREEN.width, SCREEN.height);
    return result;
}
