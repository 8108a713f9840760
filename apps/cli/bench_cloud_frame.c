// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames of a scene with everything in it, terrain, sea, air and clouds: complete ones of its
// views, and flights through it as the viewer draws them while something moves.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { WARM_FRAMES = 2, DEFAULT_RUNS = 3, WARM_FLIGHT = 5, FLIGHT_RUNS = 12, TIMINGS_MAX = 48 };

// A picture of 640 x 360 in flight as it is, and with the pixels that the viewer draws, and
// enlarges, where that one is not fluent (apps/viewer/pace.c).
static const struct frame_kind {
    struct number_size size;
    bool is_flight;
} kinds[] = {{{1280, 720}, false}, {{640, 360}, true}, {{454, 256}, true}};

// From frame to frame of a flight; as fast as the viewer flies (apps/viewer/fly.c), over the ground
// or, where a view has its altitude from the sphere, over that.
static const double frame_s = 0.2, least_m_s = 15, heights_per_s = 0.8, turn_rad = 0.003;
static const double half_turn_rad = 3.14159265358979323846;

struct frame_case {
    const struct bench_job *job;
    trl_renderer *renderer;
    double ground_radius_m;
    trl_view view;
    double height_m; // of a flight, by which its speed goes
    struct number_size size;
    bool is_flight;
    char name[BENCH_NAME_MAX];
};

static trl_result add(const struct frame_case *c, const char *metric, const char *unit,
                      double value)
{
    return bench_add(c->job->table, (struct bench_sample){c->name, metric, unit, value});
}

static trl_result add_passes(const struct frame_case *c)
{
    trl_timing rows[TIMINGS_MAX];
    const size_t all = trl_renderer_timings(c->renderer, rows, TIMINGS_MAX);
    trl_result result = TRL_OK;
    for (size_t i = 0; i < all && i < TIMINGS_MAX && result == TRL_OK; i++) {
        char metric[BENCH_NAME_MAX];
        snprintf(metric, sizeof metric, "pass %.32s", rows[i].name);
        result = add(c, metric, "ms", bench_timing_ms(&rows[i]));
    }
    return result;
}

static void fly_on(struct frame_case *c)
{
    trl_view *view = &c->view;
    const double radius_m = c->ground_radius_m + view->altitude_m;
    const double step_m = frame_s * fmax(least_m_s, heights_per_s * c->height_m);
    view->latitude_rad += step_m * cos(view->heading_rad) / radius_m;
    view->longitude_rad +=
        step_m * sin(view->heading_rad) / (radius_m * fmax(cos(view->latitude_rad), 0.01));
    view->heading_rad += turn_rad;
    view->time_s += frame_s;
    if (fabs(view->latitude_rad) > half_turn_rad / 2) { // over a pole
        view->latitude_rad = copysign(half_turn_rad, view->latitude_rad) - view->latitude_rad;
        view->longitude_rad += half_turn_rad;
        view->heading_rad += half_turn_rad;
    }
}

static double processor_ms(void)
{
    return 1e3 * (double)clock() / CLOCKS_PER_SEC;
}

static trl_result draw_once(const struct frame_case *c, bool is_measured)
{
    trl_renderer_wait(c->renderer);
    const double begun_s = progress_clock_s();
    const double begun_ms = processor_ms();
    trl_result result =
        bench_draw(c->job, c->renderer, &c->view, c->size, c->is_flight ? frame_s : 0);
    trl_renderer_wait(c->renderer);
    const double frame_ms = 1e3 * (progress_clock_s() - begun_s);
    const double spent_ms = processor_ms() - begun_ms;
    if (result == TRL_OK && is_measured) {
        result = add(c, "frame", "ms", frame_ms);
    }
    if (result == TRL_OK && is_measured) {
        result = add(c, "processor", "ms", spent_ms);
    }
    return result == TRL_OK && is_measured ? add_passes(c) : result;
}

static trl_result draw_case(struct frame_case *c)
{
    const int warm = c->is_flight ? WARM_FLIGHT : WARM_FRAMES;
    const int runs = bench_runs(c->job, c->is_flight ? FLIGHT_RUNS : DEFAULT_RUNS);
    trl_result result = trl_renderer_accumulate_clouds(c->renderer, c->is_flight);
    for (int i = 0; i < warm + runs && result == TRL_OK; i++) {
        if (!progress_report(&c->job->app->progress, c->name, (double)i / (warm + runs))) {
            report_error(EXIT_FAILED, "cancelled while drawing %s", c->name);
            return TRL_ERROR_CANCELLED;
        }
        result = draw_once(c, i >= warm);
        if (c->is_flight) {
            fly_on(c);
        }
    }
    return result;
}

// All views of the scene. A flight does not wait for rasters, nor for the times of passes.
static trl_result draw_views(const struct bench_job *job, const trl_scene *scene,
                             const struct frame_kind *kind)
{
    const bool is_flight = kind->is_flight;
    trl_renderer_desc desc = bench_renderer_desc(job, scene);
    desc.waits_for_rasters = !is_flight;
    desc.measures_time = !is_flight;
    struct frame_case c = {.job = job,
                           .ground_radius_m = trl_scene_ground_radius_m(scene),
                           .size = kind->size,
                           .is_flight = is_flight};
    trl_result result = trl_renderer_create(job->app->ctx, &desc, &c.renderer);
    for (size_t i = 0; i < trl_scene_view_count(scene) && result == TRL_OK; i++) {
        const char *name = trl_scene_view_name(scene, i);
        snprintf(c.name, sizeof c.name, "%s%.40s %ux%u", is_flight ? "flight " : "", name,
                 c.size.width, c.size.height);
        result = trl_scene_view(scene, name, &c.view);
        c.height_m = c.view.altitude_m;
        if (result == TRL_OK && is_flight) { // as the viewer: the sun stays over its place
            result = trl_renderer_resolve(c.renderer, &c.view, &c.view);
        }
        if (result == TRL_OK) {
            result = draw_case(&c);
            bench_show(job);
        }
    }
    trl_renderer_destroy(&c.renderer);
    return result;
}

trl_result bench_run_cloud_frame(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "cloudy-earth.json", &scene);
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds && result == TRL_OK; i++) {
        result = draw_views(job, scene, &kinds[i]);
    }
    bench_note(job->table, "Flights march a quarter of the clouds' rays in each frame, as the "
                           "viewer does while something moves; for a window of 640 x 360 it draws "
                           "454 x 256 where more is not fluent.");
    trl_scene_destroy(&scene);
    return result;
}
