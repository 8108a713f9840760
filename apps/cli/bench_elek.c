// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Elek and Kmoch 2010, Section 6: the time of the precomputation, the size of what it leaves, and
// frames per second. One core of theirs, a graphics card of theirs: only ratios carry over.
#include "bench.h"

#include <math.h>
#include <stdio.h>

enum { PRECOMPUTE_RUNS = 2, FRAME_RUNS = 3, PAPER_WAVELENGTHS = 15, PAPER_ORDERS = 6 };
static const double DEGREE = 3.14159265358979323846 / 180;

// Everything that pictures need, made anew with that many wavelengths.
static trl_result add_wavelengths(const struct bench_job *job, const trl_scene *scene,
                                  uint32_t wavelengths)
{
    trl_atmosphere_desc desc = trl_atmosphere_desc_default();
    desc.wavelengths = wavelengths;
    desc.uses_cache = false;
    trl_atmosphere *atmosphere = NULL;
    trl_result result = trl_atmosphere_create(job->app->ctx, scene, &desc, &atmosphere);
    if (result != TRL_OK) {
        return result;
    }
    trl_atmosphere_stats stats;
    trl_atmosphere_read_stats(atmosphere, &stats);
    trl_atmosphere_destroy(&atmosphere);
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "pictures, %u wavelengths", wavelengths);
    const struct bench_sample samples[] = {
        {name, "solve and table", "s", stats.solve_s + stats.table_s},
        {name, "orders", "1", (double)stats.orders},
        {name, "tables", "MB", (double)(stats.table_bytes + stats.solution_bytes) / 1e6}};
    for (int i = 0; i < 3 && result == TRL_OK; i++) {
        result = bench_add(job->table, samples[i]);
    }
    return result;
}

// The solver of numbers, which stops at an order when it is told; one ray at the paper's number of
// wavelengths. 0 orders: all.
static trl_result add_orders(const struct bench_job *job, const trl_scene *scene, uint32_t orders)
{
    trl_sky_desc desc = trl_sky_desc_default();
    desc.max_orders = orders;
    trl_sky_query queries[PAPER_WAVELENGTHS];
    for (int i = 0; i < PAPER_WAVELENGTHS; i++) {
        queries[i] = (trl_sky_query){.altitude_m = 2,
                                     .sun_zenith_rad = 60 * DEGREE,
                                     .view_zenith_rad = 45 * DEGREE,
                                     .wavelength_nm = 385 + 330.0 * i / (PAPER_WAVELENGTHS - 1)};
    }
    double radiance[PAPER_WAVELENGTHS];
    const double begun_s = progress_clock_s();
    trl_result result =
        trl_sky_radiance(job->app->ctx, scene, &desc, queries, PAPER_WAVELENGTHS, radiance, NULL);
    const double spent_s = progress_clock_s() - begun_s;
    char name[BENCH_NAME_MAX] = "numbers, all orders";
    if (orders > 0) {
        snprintf(name, sizeof name, "numbers, %u order%s", orders, orders > 1 ? "s" : "");
    }
    return result == TRL_OK
               ? bench_add(job->table, (struct bench_sample){name, "solve", "s", spent_s})
               : result;
}

static trl_result add_paper_times(struct bench_table *table)
{
    const struct bench_sample printed[] = {{"the paper's tables", "time", "s", 1.5 * 3600},
                                           {"the paper's tables", "orders", "1", PAPER_ORDERS},
                                           {"the paper's tables", "tables", "MB", 10}};
    trl_result result = TRL_OK;
    for (int i = 0; i < 3 && result == TRL_OK; i++) {
        result = bench_add_paper(table, printed[i]);
    }
    bench_note(table, "The paper: 15 wavelengths, air and water, Core 2 Duo 1.86 GHz; it prints no "
                      "time for other orders.");
    bench_note(table, "Pictures: all orders to a tolerance, the steps of an iteration counted. "
                      "Numbers: the finer grids of terrella sky, 15 wavelengths.");
    bench_note(table, "Up to 16 wavelengths are one vector: fewer do the same work.");
    return result;
}

trl_result bench_run_elek_precompute(const struct bench_job *job)
{
    static const uint32_t wavelengths[] = {3, 8, PAPER_WAVELENGTHS, 16};
    static const uint32_t orders[] = {1, 2, PAPER_ORDERS, 10, 0};
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "bare-sphere.json", &scene);
    const int runs = bench_runs(job, PRECOMPUTE_RUNS);
    for (int i = 0; i < runs; i++) {
        for (size_t k = 0; k < sizeof wavelengths / sizeof *wavelengths && result == TRL_OK; k++) {
            result = add_wavelengths(job, scene, wavelengths[k]);
        }
        for (size_t k = 0; k < sizeof orders / sizeof *orders && result == TRL_OK; k++) {
            result = add_orders(job, scene, orders[k]);
        }
    }
    trl_scene_destroy(&scene);
    return result == TRL_OK ? add_paper_times(job->table) : result;
}

static const struct {
    struct number_size size;
    double average, least; // frames per second in the paper
} screens[] = {{{1024, 768}, 180, 85}, {{2560, 2048}, 60, 29}};
enum { SCREENS = sizeof screens / sizeof *screens };

// Moves the camera a little, so that what depends on its place is made anew as in a flight.
static trl_result draw_moving(const struct bench_job *job, trl_renderer *renderer, trl_view *view,
                              struct number_size size, double *spent_s)
{
    view->altitude_m *= 1.001;
    view->longitude_rad += 1e-5;
    const double begun_s = progress_clock_s();
    const trl_result result = bench_draw(job, renderer, view, size, 0.02);
    trl_renderer_wait(renderer);
    *spent_s = progress_clock_s() - begun_s;
    return result;
}

// All views once; adds the frames per second of each.
static trl_result fly(const struct bench_job *job, const trl_scene *scene, trl_renderer *renderer,
                      int screen)
{
    const struct number_size size = screens[screen].size;
    const size_t views = trl_scene_view_count(scene);
    double sum_s = 0;
    double longest_s = 0;
    char name[BENCH_NAME_MAX];
    trl_result result = TRL_OK;
    for (size_t i = 0; i < views && result == TRL_OK; i++) {
        trl_view view;
        double spent_s = 0;
        snprintf(name, sizeof name, "%.30s %ux%u", trl_scene_view_name(scene, i), size.width,
                 size.height);
        if (!progress_report(&job->app->progress, name, (double)i / (double)views)) {
            report_error(EXIT_FAILED, "cancelled while drawing %s", name);
            return TRL_ERROR_CANCELLED;
        }
        result = trl_scene_view(scene, trl_scene_view_name(scene, i), &view);
        for (int warm = 0; warm < 2 && result == TRL_OK; warm++) { // the second is measured
            result = draw_moving(job, renderer, &view, size, &spent_s);
        }
        sum_s += spent_s;
        longest_s = fmax(longest_s, spent_s);
        if (result == TRL_OK) {
            result =
                bench_add(job->table, (struct bench_sample){name, "frames", "fps", 1 / spent_s});
        }
    }
    snprintf(name, sizeof name, "all views %ux%u", size.width, size.height);
    if (result == TRL_OK && views > 0) {
        result = bench_add(job->table,
                           (struct bench_sample){name, "average", "fps", (double)views / sum_s});
    }
    return result == TRL_OK && views > 0
               ? bench_add(job->table, (struct bench_sample){name, "least", "fps", 1 / longest_s})
               : result;
}

static trl_result add_paper_frames(struct bench_table *table)
{
    trl_result result = TRL_OK;
    for (int i = 0; i < SCREENS && result == TRL_OK; i++) {
        char name[BENCH_NAME_MAX];
        snprintf(name, sizeof name, "all views %ux%u", screens[i].size.width,
                 screens[i].size.height);
        result = bench_add_paper(table,
                                 (struct bench_sample){name, "average", "fps", screens[i].average});
        if (result == TRL_OK) {
            result = bench_add_paper(table,
                                     (struct bench_sample){name, "least", "fps", screens[i].least});
        }
    }
    bench_note(table,
               "The paper: GeForce 8800 GT, 1.1 million triangles, sphere and water; here "
               "the scene's views, the camera moving, without terrain unless --scene has it.");
    bench_note(table,
               "The paper's larger screen has 6.7 times the pixels and a third of the frames "
               "per second.");
    return result;
}

trl_result bench_run_elek_fps(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_result result = bench_load_scene(job, "bare-sphere.json", &scene);
    if (result == TRL_OK) {
        const trl_renderer_desc desc = bench_renderer_desc(job, scene);
        result = trl_renderer_create(job->app->ctx, &desc, &renderer);
    }
    const int runs = bench_runs(job, FRAME_RUNS);
    for (int s = 0; s < SCREENS; s++) {
        for (int i = 0; i < runs && result == TRL_OK; i++) {
            result = fly(job, scene, renderer, s);
        }
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    return result == TRL_OK ? add_paper_frames(job->table) : result;
}
