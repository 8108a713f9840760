// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Michelic 2019, Figure 17: what terrain, ocean, and air with clouds take of a frame in full HD. An
// invented planet with a sea, to which cumulus is added where it has no clouds.
#include "bench.h"

#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DEFAULT_RUNS = 3, TIMINGS_MAX = 48 };
static const struct number_size SCREEN = {1920, 1080};

// Passes by what the paper has one number for. What is in none comes after its frame: edges,
// exposure, tone. The sea's colour is part of the pass "sky" here, which draws what pixels show.
enum share { TERRAIN, OCEAN, AIR, REST, SHARES };
static const char *const share_names[SHARES] = {"terrain", "ocean", "air and clouds", "the rest"};
static const double paper_ms[SHARES] = {2.96, 0.26, 10.98, 0};
static const struct {
    const char *pass;
    enum share share;
} passes[] = {
    {"tiles", TERRAIN},          {"vertices", TERRAIN},  {"mesh", TERRAIN},     {"shadow", TERRAIN},
    {"surface", TERRAIN},        {"sky view", TERRAIN},  {"waves", OCEAN},      {"sky maps", AIR},
    {"clouds' deck", AIR},       {"clouds' shade", AIR}, {"sky", AIR},          {"stars", AIR},
    {"shadows in the air", AIR}, {"clouds", AIR},        {"clouds joined", AIR}};

static const char *const own_views[] = {"range", "noon"};

static trl_result load_scene(const struct bench_job *job, trl_scene **out)
{
    char *own = job->scene ? NULL : app_find_scene("aurelia.json");
    const char *path = job->scene ? job->scene : own;
    *out = NULL;
    json_error_t error = {.text = "not found"};
    json_t *scene = path ? json_load_file(path, 0, &error) : NULL;
    if (scene && !json_object_get(scene, "clouds")) {
        json_object_set_new(scene, "clouds", json_pack("{s:[{s:f}]}", "layers", "cover", 0.5));
    }
    char *text = scene ? json_dumps(scene, 0) : NULL;
    trl_result result = TRL_ERROR_IO;
    if (text) {
        result = trl_scene_parse(job->app->ctx, text, strlen(text), "michelic-frame", ".", out);
    } else {
        report_error(EXIT_FAILED, "bench: %s: %s", path ? path : "aurelia.json", error.text);
    }
    free(text);
    json_decref(scene);
    free(own);
    return result;
}

static enum share find_share(const char *pass)
{
    for (size_t i = 0; i < sizeof passes / sizeof *passes; i++) {
        if (strcmp(passes[i].pass, pass) == 0) {
            return passes[i].share;
        }
    }
    return REST;
}

static trl_result add_frame(const struct bench_job *job, const trl_renderer *renderer,
                            const char *name)
{
    trl_timing rows[TIMINGS_MAX];
    const size_t all = trl_renderer_timings(renderer, rows, TIMINGS_MAX);
    double share_ms[SHARES] = {0};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < all && i < TIMINGS_MAX && result == TRL_OK; i++) {
        const double ms = bench_timing_ms(&rows[i]);
        char metric[BENCH_NAME_MAX];
        snprintf(metric, sizeof metric, "pass %.32s", rows[i].name);
        share_ms[find_share(rows[i].name)] += ms;
        result = bench_add(job->table, (struct bench_sample){name, metric, "ms", ms});
    }
    for (int s = 0; s < SHARES && result == TRL_OK; s++) {
        result =
            bench_add(job->table, (struct bench_sample){name, share_names[s], "ms", share_ms[s]});
    }
    return result;
}

static trl_result draw_view(const struct bench_job *job, trl_renderer *renderer,
                            const trl_view *view, const char *name)
{
    const int runs = bench_runs(job, DEFAULT_RUNS);
    trl_result result = TRL_OK;
    for (int s = 0; s < REST && result == TRL_OK; s++) {
        result = bench_add_paper(job->table,
                                 (struct bench_sample){name, share_names[s], "ms", paper_ms[s]});
    }
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        if (!progress_report(&job->app->progress, name, (double)i / (runs + 1))) {
            report_error(EXIT_FAILED, "cancelled while drawing %s", name);
            return TRL_ERROR_CANCELLED;
        }
        result = bench_draw(job, renderer, view, SCREEN, 0);
        trl_renderer_wait(renderer);
        if (i > 0 && result == TRL_OK) { // the first compiles
            result = add_frame(job, renderer, name);
        }
    }
    return result;
}

trl_result bench_run_michelic_frame(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_result result = load_scene(job, &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = bench_renderer_desc(job, scene);
        desc.measures_time = true;
        result = trl_renderer_create(job->app->ctx, &desc, &renderer);
    }
    const size_t count =
        job->scene ? trl_scene_view_count(scene) : sizeof own_views / sizeof own_views[0];
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        const char *name = job->scene ? trl_scene_view_name(scene, i) : own_views[i];
        trl_view view;
        result = trl_scene_view(scene, name, &view);
        if (result == TRL_OK) {
            result = draw_view(job, renderer, &view, name);
            bench_show(job);
        }
    }
    bench_note(job->table, "The paper's numbers are of one view on a GeForce GTX 1060. Here the "
                           "sea's colour is in the pass \"sky\", its waves are a pass.");
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    return result;
}
