// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Planetary projective grid mapping, Section 8 (Figure 8): frames per second of three views, by the
// size of the grid and of the screen, and the time of the step that makes the mesh. The paper shows
// curves and prints no number; what it says of them is told by ratios within one run.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDES = 3, VIEWS = 3, DEFAULT_RUNS = 3 };

static const uint32_t sides[SIDES] = {512, 768, 1024};

// Global, close to coarse data, close to fine data.
static const char *const earth_views[VIEWS] = {"orbit", "himalaya-morning", "rockies-sunset"};

struct pgm {
    const struct bench_job *job;
    trl_renderer *renderer;
    trl_view view;
    const char *view_name;
    double fps[SIDES][SIDES]; // by grid and screen; the best of each
    double step_ms[SIDES][SIDES];
    int done, all; // cases, for the progress line
};

static trl_result draw_frame(struct pgm *p, uint32_t screen, double *fps)
{
    trl_renderer_wait(p->renderer);
    const double begun_s = progress_clock_s();
    const struct number_size size = {screen, screen};
    const trl_result result = bench_draw(p->job, p->renderer, &p->view, size, 0.02);
    trl_renderer_wait(p->renderer);
    *fps = 1 / fmax(progress_clock_s() - begun_s, 1e-6);
    return result;
}

static trl_result measure_case(struct pgm *p, int grid, int screen)
{
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "%.24s, grid %u^2, screen %u^2", p->view_name, sides[grid],
             sides[screen]);
    const int runs = bench_runs(p->job, DEFAULT_RUNS);
    trl_result result = TRL_OK;
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        double fps = 0;
        p->view.longitude_rad += 1e-9; // the mesh is made anew for every place
        result = draw_frame(p, sides[screen], &fps);
        if (i > 0 && result == TRL_OK) { // the first frame compiles, and makes targets
            const double step_ms = bench_pass_ms(p->renderer, "vertices");
            double *best_ms = &p->step_ms[grid][screen];
            *best_ms = *best_ms > 0 ? fmin(*best_ms, step_ms) : step_ms;
            p->fps[grid][screen] = fmax(p->fps[grid][screen], fps);
            result = bench_add(p->job->table, (struct bench_sample){name, "frame", "fps", fps});
            result =
                result == TRL_OK
                    ? bench_add(p->job->table, (struct bench_sample){name, "step", "ms", step_ms})
                    : result;
        }
    }
    return result;
}

static trl_result set_grid(struct pgm *p, uint32_t side)
{
    const trl_projective_desc grid = {side, side, TRL_PROJECTIVE_ROWS_RELIEF};
    return trl_renderer_set_projective(p->renderer, &grid);
}

// What the paper says of its curves.
static void tell_ratios(struct pgm *p)
{
    double *first = p->fps[0];
    bench_note(p->job->table,
               "%s: four times the grid takes %.2f times as long a frame, four times the screen "
               "%.2f; the step %.2f and %.2f.",
               p->view_name, first[0] / p->fps[SIDES - 1][0], first[0] / first[SIDES - 1],
               p->step_ms[SIDES - 1][0] / p->step_ms[0][0],
               p->step_ms[0][SIDES - 1] / p->step_ms[0][0]);
}

static trl_result check_ground(const struct pgm *p)
{
    trl_mesh_stats stats;
    const trl_result result = trl_renderer_mesh_stats(p->renderer, &stats);
    if (result == TRL_OK && stats.draws == 0) {
        report_error(EXIT_FAILED, "bench: the scene has no ground to lay a grid on; see make data");
        return TRL_ERROR_INVALID;
    }
    return result;
}

static trl_result measure_view(struct pgm *p, const trl_scene *scene, int which)
{
    p->view_name = p->job->scene ? trl_scene_view_name(scene, (size_t)which) : earth_views[which];
    trl_result result = trl_scene_view(scene, p->view_name, &p->view);
    memset(p->fps, 0, sizeof p->fps);
    memset(p->step_ms, 0, sizeof p->step_ms);
    for (int grid = 0; grid < SIDES && result == TRL_OK; grid++) {
        result = set_grid(p, sides[grid]);
        for (int screen = 0; screen < SIDES && result == TRL_OK; screen++) {
            if (!progress_report(&p->job->app->progress, p->view_name,
                                 (double)p->done++ / p->all)) {
                report_error(EXIT_FAILED, "cancelled while drawing %s", p->view_name);
                return TRL_ERROR_CANCELLED;
            }
            result = measure_case(p, grid, screen);
            result = result == TRL_OK ? check_ground(p) : result;
            bench_show(p->job);
        }
    }
    if (result == TRL_OK) {
        tell_ratios(p);
    }
    return result;
}

static trl_result measure(struct pgm *p, const trl_scene *scene)
{
    int views = VIEWS;
    if (p->job->scene && trl_scene_view_count(scene) < VIEWS) {
        views = (int)trl_scene_view_count(scene);
    }
    p->all = views * SIDES * SIDES;
    trl_result result = TRL_OK;
    for (int i = 0; i < views && result == TRL_OK; i++) {
        result = measure_view(p, scene, i);
    }
    bench_note(p->job->table,
               "Frame: all passes, air and light included, each waited for. Step: what makes the "
               "vertices of the grid, before it is drawn.");
    bench_note(p->job->table,
               "The paper: Core i7 2.8 GHz, GeForce GTX 480, Mars. Curves without numbers: the "
               "global view is slowest, the grid counts more than the screen, the step does not "
               "depend on the screen.");
    return result;
}

trl_result bench_run_pgm_fps(const struct bench_job *job)
{
    struct pgm p = {.job = job};
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "earth.json", &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = bench_renderer_desc(job, scene);
        desc.mesher = TRL_MESHER_PROJECTIVE;
        desc.measures_time = true;
        result = trl_renderer_create(job->app->ctx, &desc, &p.renderer);
    }
    if (result == TRL_OK) {
        result = measure(&p, scene);
    }
    trl_renderer_destroy(&p.renderer);
    trl_scene_destroy(&scene);
    return result;
}
