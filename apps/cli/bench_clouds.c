// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What clouds take of a frame: by cover, view, size and looks toward the star, over a bare sphere;
// and in a flight, where they come together over frames.
#include "bare_scene.h"
#include "bench.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979323846;
static const double turn_rad = 0.005; // of a flight, from frame to frame

enum { DEFAULT_RUNS = 3, TIMINGS_MAX = 32, COVERS = 3, SIZES = 2, VIEWS = 2 };

static const double covers[COVERS] = {0.2, 0.5, 0.9};
static const struct number_size sizes[SIZES] = {{640, 360}, {1280, 720}};
static const char *const views[VIEWS] = {"ground", "full-disc"};

// Of each place that is lit, under stars of these elevations: where ways to the top of the layer
// are long, there are more.
static const struct {
    double elevation_deg;
    int samples;
} suns[] = {{60, 6}, {5, 12}};
enum { SUNS = sizeof suns / sizeof *suns, SUN_COVER = 1 };

static trl_result add_passes(const struct bench_job *job, const trl_renderer *renderer,
                             const char *name)
{
    trl_timing rows[TIMINGS_MAX];
    const size_t all = trl_renderer_timings(renderer, rows, TIMINGS_MAX);
    trl_result result = TRL_OK;
    double sum_ms = 0;
    for (size_t i = 0; i < all && i < TIMINGS_MAX && result == TRL_OK; i++) {
        sum_ms += rows[i].gpu_ms;
        if (strncmp(rows[i].name, "clouds", 6) == 0) {
            result = bench_add(job->table,
                               (struct bench_sample){name, rows[i].name, "ms", rows[i].gpu_ms});
        }
    }
    return result == TRL_OK
               ? bench_add(job->table, (struct bench_sample){name, "passes together", "ms", sum_ms})
               : result;
}

struct cloud_case {
    trl_renderer *renderer;
    trl_view view;
    struct number_size size;
    bool is_flight;
    char name[BENCH_NAME_MAX];
};

static trl_result draw_case(const struct bench_job *job, const struct cloud_case *c)
{
    const int runs = bench_runs(job, DEFAULT_RUNS);
    trl_result result = TRL_OK;
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        if (!progress_report(&job->app->progress, c->name, (double)i / (runs + 1))) {
            report_error(EXIT_FAILED, "cancelled while drawing %s", c->name);
            return TRL_ERROR_CANCELLED;
        }
        trl_view view = c->view;
        view.heading_rad += c->is_flight ? i * turn_rad : 0;
        result = bench_draw(job, c->renderer, &view, c->size, 0);
        trl_renderer_wait(c->renderer);
        if (i > 0 && result == TRL_OK) { // the first compiles
            result = add_passes(job, c->renderer, c->name);
        }
    }
    return result;
}

static trl_result measure_views(const struct bench_job *job, const trl_scene *scene, double cover,
                                struct cloud_case *c)
{
    trl_result result = TRL_OK;
    for (int i = 0; i < 2 * VIEWS * SIZES && result == TRL_OK; i++) {
        const char *view = views[i / 2 / SIZES];
        c->size = sizes[i / 2 % SIZES];
        c->is_flight = i % 2 == 1;
        snprintf(c->name, sizeof c->name, "cover %g, %s %ux%u%s", cover, view, c->size.width,
                 c->size.height, c->is_flight ? ", flight" : "");
        result = trl_scene_view(scene, view, &c->view);
        if (result == TRL_OK) {
            result = trl_renderer_accumulate_clouds(c->renderer, c->is_flight);
        }
        if (result == TRL_OK) {
            result = draw_case(job, c);
            bench_show(job);
        }
    }
    return result;
}

// The same clouds are met; only looks toward the star differ.
static trl_result measure_suns(const struct bench_job *job, const trl_scene *scene, double cover,
                               struct cloud_case *c)
{
    trl_result result = trl_renderer_accumulate_clouds(c->renderer, false);
    c->size = sizes[SIZES - 1];
    c->is_flight = false;
    for (int i = 0; i < SUNS && result == TRL_OK; i++) {
        snprintf(c->name, sizeof c->name, "%d sun samples, cover %g, ground %ux%u", suns[i].samples,
                 cover, c->size.width, c->size.height);
        result = trl_scene_view(scene, views[0], &c->view);
        c->view.sun_mode = TRL_SUN_LOCAL;
        c->view.sun_latitude_or_elevation_rad = suns[i].elevation_deg * pi / 180;
        if (result == TRL_OK) {
            result = draw_case(job, c);
            bench_show(job);
        }
    }
    return result;
}

static trl_result measure_cover(const struct bench_job *job, int cover)
{
    trl_scene *scene = NULL;
    struct cloud_case c = {0};
    trl_result result = bare_scene_make_cloudy(job->app, covers[cover], &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = bench_renderer_desc(job, scene);
        desc.measures_time = true;
        result = trl_renderer_create(job->app->ctx, &desc, &c.renderer);
    }
    if (result == TRL_OK) {
        result = measure_views(job, scene, covers[cover], &c);
    }
    if (result == TRL_OK && cover == SUN_COVER) {
        result = measure_suns(job, scene, covers[cover], &c);
    }
    trl_renderer_destroy(&c.renderer);
    trl_scene_destroy(&scene);
    return result;
}

// What a process takes at most to draw the sphere for the first time: programs that are compiled
// count, and, where no GPU is, textures.
static trl_result measure_memory(const struct bench_job *job, const char *name, bool has_clouds)
{
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_view view;
    trl_result result =
        has_clouds ? bare_scene_make_cloudy(job->app, covers[SUN_COVER], &scene)
                   : bare_scene_make(job->app, "clear", "\"clouds\": {\"layers\": []}", &scene);
    bench_memory_reset();
    if (result == TRL_OK) {
        const trl_renderer_desc desc = bench_renderer_desc(job, scene);
        result = trl_renderer_create(job->app->ctx, &desc, &renderer);
    }
    if (result == TRL_OK) {
        result = trl_scene_view(scene, views[0], &view);
    }
    if (result == TRL_OK) {
        result = bench_draw(job, renderer, &view, sizes[SIZES - 1], 0);
        trl_renderer_wait(renderer);
    }
    if (result == TRL_OK) {
        result = bench_add(
            job->table, (struct bench_sample){name, "peak memory", "MB", bench_memory_peak_mb()});
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    return result;
}

trl_result bench_run_clouds(const struct bench_job *job)
{
    trl_result result = measure_memory(job, "ground 1280x720 without clouds", false);
    if (result == TRL_OK) {
        result = measure_memory(job, "ground 1280x720 with clouds", true);
    }
    for (int i = 0; i < COVERS && result == TRL_OK; i++) {
        result = measure_cover(job, i);
    }
    bench_note(job->table,
               "Sun samples: of each lit place, with the star at 60 and at 5 degrees, where the "
               "way to the layer's top is long.");
    bench_note(job->table,
               "Peak memory is that of this process while it makes a renderer and draws "
               "its first picture, with the driver's if that is a software rasteriser.");
    return result;
}
