// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Schafhitzel 2007, Table 1: frames of Earth and Mars from outside and from inside of their air,
// with it and without. As in the paper, tiles of a quadtree are the ground and one 3D table is the
// air; the same frames with the air of the spectral model, all orders of scattering, stand beside.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

// The paper's viewport, and one of today's.
static const struct number_size PAPER_SIZE = {800, 600};
static const struct number_size SCREEN = {1024, 576};
enum { DEFAULT_RUNS = 5, WARM_FRAMES = 2, MAX_VIEWS = 16 };
static const double RAD_PER_DEG = 3.14159265358979323846 / 180;

// Frames per second that the paper prints, with its air and without, and a view like that of its
// Figure 4: (a), (c), (g), (h).
struct paper_view {
    const char *name, *scene_view; // of the scene, changed where it says how
    bool is_changed;
    double latitude_deg, longitude_deg, altitude_m, heading_deg, pitch_deg;
    double with_fps, without_fps;
};

enum { PLANETS = 2, SIDES = 2 };
static const char *const SCENES[PLANETS] = {"earth.json", "mars.json"};
static const struct paper_view VIEWS[PLANETS][SIDES] = {
    {{.name = "Earth, outside", .scene_view = "orbit", .with_fps = 67.26, .without_fps = 76.44},
     {"Earth, inside", "himalaya-morning", true, 44.9, 8.2, 6000, 340, -6, 30.31, 35.83}},
    {{.name = "Mars, outside", .scene_view = "orbit", .with_fps = 83.51, .without_fps = 102.37},
     {"Mars, inside", "valles-marineris", true, -12.4, -63, 9000, 280, -12, 56.02, 61.19}}};

struct table1_case {
    char name[BENCH_NAME_MAX];
    trl_view view;
    const struct paper_view *paper; // NULL: a view of a scene that was given
    double best_ms[SIDES];          // with the paper's air, without
    double best_cpu_ms[SIDES];      // the same in processor time, all threads
};

struct table1 {
    const struct bench_job *job;
    trl_scene *scene, *airless;
    trl_renderer *renderer;
    struct table1_case cases[MAX_VIEWS];
    int count;
    int done, all; // for the progress line
    double cost_sum;
    int cost_count;
};

static trl_result add(const struct table1 *t, const struct table1_case *c, const char *metric,
                      struct bench_sample sample)
{
    sample.case_name = c->name;
    sample.metric = metric;
    return bench_add(t->job->table, sample);
}

struct frame_time {
    double ms, cpu_ms;
};

// A frame that is waited for.
static trl_result draw_frame(struct table1 *t, const struct table1_case *c, struct number_size size,
                             struct frame_time *time)
{
    trl_renderer_wait(t->renderer);
    const double begun_s = progress_clock_s();
    const clock_t begun = clock();
    const trl_result result = bench_draw(t->job, t->renderer, &c->view, size, 0.02);
    trl_renderer_wait(t->renderer);
    time->ms = 1e3 * fmax(progress_clock_s() - begun_s, 1e-6);
    time->cpu_ms = 1e3 * (double)(clock() - begun) / CLOCKS_PER_SEC;
    return result;
}

struct measurement {
    const char *metric, *unit; // "fps" or "ms"
    struct number_size size;
};

static trl_result measure(struct table1 *t, const struct table1_case *c,
                          const struct measurement *m, struct frame_time *best)
{
    if (!progress_report(&t->job->app->progress, c->name, (double)t->done++ / t->all)) {
        report_error(EXIT_FAILED, "cancelled while drawing %s", c->name);
        return TRL_ERROR_CANCELLED;
    }
    trl_result result = TRL_OK;
    *best = (struct frame_time){(double)INFINITY, (double)INFINITY};
    const int runs = bench_runs(t->job, DEFAULT_RUNS);
    for (int i = 0; i < WARM_FRAMES + runs && result == TRL_OK; i++) {
        struct frame_time time = {0, 0};
        result = draw_frame(t, c, m->size, &time);
        if (i >= WARM_FRAMES && result == TRL_OK) {
            best->ms = fmin(best->ms, time.ms);
            best->cpu_ms = fmin(best->cpu_ms, time.cpu_ms);
            const double value = strcmp(m->unit, "fps") == 0 ? 1e3 / time.ms : time.ms;
            result = add(t, c, m->metric, (struct bench_sample){.unit = m->unit, .value = value});
        }
    }
    return result;
}

static trl_result add_triangles(const struct table1 *t, const struct table1_case *c)
{
    trl_mesh_stats stats;
    const trl_result result = trl_renderer_mesh_stats(t->renderer, &stats);
    if (result == TRL_OK && stats.draws == 0) {
        report_error(EXIT_FAILED, "bench: %s has no ground; see make data", c->name);
        return TRL_ERROR_INVALID;
    }
    return result == TRL_OK
               ? add(t, c, "triangles", (struct bench_sample){.unit = "", .value = stats.triangles})
               : result;
}

// What the air adds to a frame's time, in the words of the paper: of the rate without it.
static trl_result add_cost(struct table1 *t, struct table1_case *c)
{
    const double percent = 100 * (1 - c->best_ms[1] / c->best_ms[0]);
    const double cpu_percent = 100 * (1 - c->best_cpu_ms[1] / c->best_cpu_ms[0]);
    t->cost_sum += cpu_percent;
    t->cost_count++;
    trl_result result =
        add(t, c, "the air takes", (struct bench_sample){.unit = "%", .value = percent});
    if (result == TRL_OK) {
        result = add(t, c, "of processor time",
                     (struct bench_sample){.unit = "%", .value = cpu_percent});
    }
    if (!c->paper) {
        return result;
    }
    const double with = c->paper->with_fps;
    const double without = c->paper->without_fps;
    const struct bench_sample printed[] = {
        {c->name, "with air", "fps", with},
        {c->name, "without air", "fps", without},
        {c->name, "the air takes", "%", 100 * (1 - with / without)}};
    for (int i = 0; i < 3 && result == TRL_OK; i++) {
        result = bench_add_paper(t->job->table, printed[i]);
    }
    return result;
}

static trl_result make_renderer(struct table1 *t, trl_sky_model model)
{
    trl_renderer_desc desc = bench_renderer_desc(t->job, t->scene);
    desc.mesher = t->job->mesher < 0 ? TRL_MESHER_QUADTREE : desc.mesher;
    desc.sky_model = model;
    trl_renderer_destroy(&t->renderer);
    return trl_renderer_create(t->job->app->ctx, &desc, &t->renderer);
}

// The scene as it is shown by default.
static trl_result measure_whole(struct table1 *t)
{
    const struct measurement m = {"whole scene, 1024 x 576", "ms", SCREEN};
    trl_result result = make_renderer(t, TRL_SKY_SPECTRAL);
    for (int i = 0; i < t->count && result == TRL_OK; i++) {
        struct frame_time best;
        result = measure(t, &t->cases[i], &m, &best);
        if (result == TRL_OK) {
            result = add(t, &t->cases[i], "its processor time",
                         (struct bench_sample){.unit = "ms", .value = best.cpu_ms});
        }
        if (result == TRL_OK) {
            result = add_triangles(t, &t->cases[i]);
        }
    }
    return result;
}

static trl_result measure_paper(struct table1 *t)
{
    trl_result result = make_renderer(t, TRL_SKY_SINGLE);
    for (int way = 0; way < SIDES && result == TRL_OK; way++) {
        const struct measurement m = {way == 0 ? "with air" : "without air", "fps", PAPER_SIZE};
        if (way == 1) {
            result = trl_renderer_change_atmosphere(t->renderer, t->airless, NULL, 0);
        }
        for (int i = 0; i < t->count && result == TRL_OK; i++) {
            struct frame_time best;
            result = measure(t, &t->cases[i], &m, &best);
            t->cases[i].best_ms[way] = best.ms;
            t->cases[i].best_cpu_ms[way] = best.cpu_ms;
        }
    }
    for (int i = 0; i < t->count && result == TRL_OK; i++) {
        result = add_cost(t, &t->cases[i]);
    }
    return result;
}

// No constituents: what changes an atmosphere into none.
static trl_result make_airless(struct table1 *t)
{
    char text[256];
    const int length =
        snprintf(text, sizeof text,
                 "{\"terrella\": 1, \"name\": \"no air\", \"star\": {\"spectral_irradiance\": 1}, "
                 "\"planet\": {\"radius_m\": %.17g, \"ground_albedo\": 0.1}}",
                 trl_scene_ground_radius_m(t->scene));
    return trl_scene_parse(t->job->app->ctx, text, (size_t)length, "no air", ".", &t->airless);
}

static trl_result choose_paper_views(struct table1 *t, int planet)
{
    trl_result result = TRL_OK;
    t->count = 0;
    for (int i = 0; i < SIDES && result == TRL_OK; i++) {
        const struct paper_view *paper = &VIEWS[planet][i];
        struct table1_case *c = &t->cases[t->count++];
        *c = (struct table1_case){.paper = paper};
        snprintf(c->name, sizeof c->name, "%s", paper->name);
        result = trl_scene_view(t->scene, paper->scene_view, &c->view);
        if (paper->is_changed) {
            c->view.latitude_rad = paper->latitude_deg * RAD_PER_DEG;
            c->view.longitude_rad = paper->longitude_deg * RAD_PER_DEG;
            c->view.altitude_m = paper->altitude_m;
            c->view.altitude_mode = TRL_ALTITUDE_SPHERE;
            c->view.heading_rad = paper->heading_deg * RAD_PER_DEG;
            c->view.pitch_rad = paper->pitch_deg * RAD_PER_DEG;
        }
    }
    return result;
}

static trl_result choose_all_views(struct table1 *t)
{
    trl_result result = TRL_OK;
    const size_t count = trl_scene_view_count(t->scene);
    t->count = 0;
    for (size_t i = 0; i < count && i < MAX_VIEWS && result == TRL_OK; i++) {
        struct table1_case *c = &t->cases[t->count++];
        *c = (struct table1_case){.paper = NULL};
        snprintf(c->name, sizeof c->name, "%.60s", trl_scene_view_name(t->scene, i));
        result = trl_scene_view(t->scene, trl_scene_view_name(t->scene, i), &c->view);
    }
    return result;
}

static trl_result measure_planet(struct table1 *t, int planet)
{
    trl_result result = bench_load_scene(t->job, SCENES[planet], &t->scene);
    if (result == TRL_OK) {
        result = make_airless(t);
    }
    if (result == TRL_OK) {
        result = t->job->scene ? choose_all_views(t) : choose_paper_views(t, planet);
    }
    t->all = (t->job->scene ? 1 : PLANETS) * 3 * t->count;
    if (result == TRL_OK) {
        result = measure_whole(t);
    }
    if (result == TRL_OK) {
        result = measure_paper(t);
    }
    trl_renderer_destroy(&t->renderer);
    trl_scene_destroy(&t->airless);
    trl_scene_destroy(&t->scene);
    return result;
}

trl_result bench_run_schafhitzel_table1(const struct bench_job *job)
{
    struct table1 t = {.job = job};
    trl_result result = TRL_OK;
    for (int planet = 0; planet < (job->scene ? 1 : PLANETS) && result == TRL_OK; planet++) {
        result = measure_planet(&t, planet);
        bench_show(job);
    }
    bench_note(job->table,
               "Rates: whole frames at %u x %u, light of the model single (one 3D table); without "
               "air the same scene with no constituents, ground and star. Frames after the first "
               "%d, from a place that stays.",
               PAPER_SIZE.width, PAPER_SIZE.height, WARM_FRAMES);
    bench_note(job->table, "Whole scene: the model spectral, all orders, shadows in the air; sun "
                           "and ground as always.");
    if (t.cost_count > 0) {
        bench_note(
            job->table,
            "The air takes %.0f %% of the processor's time in the mean, by the best frame of "
            "each; the paper says about 15 %% of the clock's. On a GPU look at the clock's.",
            t.cost_sum / t.cost_count);
    }
    bench_note(job->table, "The paper: Athlon 64 X2 4800+, GeForce 7900 GT; 24 x 12 tiles of 257^2 "
                           "(Earth) and 65^2 heights (Mars).");
    return result;
}
