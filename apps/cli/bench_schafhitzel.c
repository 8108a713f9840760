// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Schafhitzel 2007, Table 2: the atmosphere alone, on two spheres of n x n vertices, looked up in
// the 3D table for each fragment or integrated at each vertex. Both draw the same air, view and
// size in one run; only the ratio can be compared with the paper's machine.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// The paper's viewport.
enum { WIDTH = 800, HEIGHT = 600, DEFAULT_RUNS = 5, STEPS = 32, SIDES = 3 };

static const struct {
    uint32_t side;
    double looked_up, integrated; // frames per second
} printed[SIDES] = {{128, 608.49, 151.06}, {256, 181.54, 35.92}, {512, 48.67, 9.97}};

struct schafhitzel {
    const struct bench_job *job;
    trl_renderer *renderer;
    trl_view view;
    float *radiance[2]; // looked up, integrated; WIDTH x HEIGHT x 4
    int done, all;      // frames, for the progress line
};

// Draws once to warm up, then measures; keeps the last picture.
static trl_result draw_case(struct schafhitzel *s, uint32_t side, trl_single_drawing drawing,
                            double *best_fps)
{
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "%u x %u vertices", side, side);
    const bool is_integrated = drawing == TRL_SINGLE_VERTICES;
    trl_result result = trl_renderer_set_single_drawing(s->renderer, drawing, side, STEPS);
    const int runs = bench_runs(s->job, DEFAULT_RUNS);
    *best_fps = 0;
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        if (!progress_report(&s->job->app->progress, name, (double)s->done++ / s->all)) {
            report_error(EXIT_FAILED, "cancelled while drawing %s", name);
            return TRL_ERROR_CANCELLED;
        }
        result = trl_renderer_draw(s->renderer, &s->view, WIDTH, HEIGHT, 0);
        trl_renderer_wait(s->renderer);
        const double ms = bench_pass_ms(s->renderer, "sky");
        if (i > 0 && result == TRL_OK && ms > 0) {
            *best_fps = fmax(*best_fps, 1e3 / ms);
            result = bench_add(s->job->table,
                               (struct bench_sample){
                                   name, is_integrated ? "vertex shader" : "optimized (3D table)",
                                   "fps", 1e3 / ms});
        }
    }
    return result == TRL_OK
               ? trl_renderer_read_radiance(s->renderer, s->radiance[is_integrated ? 1 : 0])
               : result;
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

// Median difference of the two pictures' green, relative, where there is light. Overwrites the
// second picture.
static double compare_pictures(struct schafhitzel *s)
{
    float *error = s->radiance[1];
    size_t count = 0;
    for (size_t k = 0; k < (size_t)WIDTH * HEIGHT; k++) {
        const float a = s->radiance[0][4 * k + 1];
        const float b = s->radiance[1][4 * k + 1];
        if (a > 1) {
            error[count++] = fabsf(b - a) / a; // never overtakes what is still read
        }
    }
    qsort(error, count, sizeof *error, compare_floats);
    return count > 0 ? (double)error[count / 2] : 0;
}

static trl_result measure_side(struct schafhitzel *s, int which)
{
    const uint32_t side = printed[which].side;
    struct bench_table *table = s->job->table;
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "%u x %u vertices", side, side);
    double looked_up = 0;
    double integrated = 0;
    trl_result result = draw_case(s, side, TRL_SINGLE_SPHERES, &looked_up);
    if (result == TRL_OK) {
        result = draw_case(s, side, TRL_SINGLE_VERTICES, &integrated);
    }
    if (result == TRL_OK && integrated > 0) {
        result = bench_add(table, (struct bench_sample){name, "optimized / vertex shader", "times",
                                                        looked_up / integrated});
        bench_note(table, "%s: the two pictures differ by %.2f %% in the median.", name,
                   100 * compare_pictures(s));
    }
    const struct bench_sample paper[] = {
        {name, "optimized (3D table)", "fps", printed[which].looked_up},
        {name, "vertex shader", "fps", printed[which].integrated},
        {name, "optimized / vertex shader", "times",
         printed[which].looked_up / printed[which].integrated}};
    for (int i = 0; i < 3 && result == TRL_OK; i++) {
        result = bench_add_paper(table, paper[i]);
    }
    return result;
}

// As pictures are drawn with this model: no spheres, every pixel once.
static trl_result measure_pixels(struct schafhitzel *s)
{
    trl_result result = trl_renderer_set_single_drawing(s->renderer, TRL_SINGLE_PIXELS, 0, 0);
    const int runs = bench_runs(s->job, DEFAULT_RUNS);
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        s->done++;
        result = trl_renderer_draw(s->renderer, &s->view, WIDTH, HEIGHT, 0);
        trl_renderer_wait(s->renderer);
        const double ms = bench_pass_ms(s->renderer, "sky");
        if (i > 0 && result == TRL_OK && ms > 0) {
            result = bench_add(s->job->table, (struct bench_sample){"every pixel, no spheres",
                                                                    "3D table", "fps", 1e3 / ms});
        }
    }
    return result;
}

static trl_result measure(struct schafhitzel *s)
{
    s->all = (2 * SIDES + 1) * (1 + bench_runs(s->job, DEFAULT_RUNS));
    trl_result result = TRL_OK;
    for (int i = 0; i < SIDES && result == TRL_OK; i++) {
        result = measure_side(s, i);
    }
    if (result == TRL_OK) {
        result = measure_pixels(s);
    }
    struct bench_table *table = s->job->table;
    bench_note(table, "Both: the pass of air and ground alone, at %d x %d, no terrain, no star.",
               WIDTH, HEIGHT);
    bench_note(table,
               "Vertex shader: %d steps through the air; direct light and extinction looked up in "
               "2D tables at each (O'Neil 2004).",
               STEPS);
    bench_note(table, "The paper: Athlon 64 X2 4800+, GeForce 7900 GT, whole frames; it tells 4 to "
                      "5.3 times.");
    return result;
}

trl_result bench_run_schafhitzel_table2(const struct bench_job *job)
{
    struct schafhitzel s = {.job = job};
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "bare-sphere.json", &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = scene;
        desc.sky_model = TRL_SKY_SINGLE;
        desc.measures_time = true;
        result = trl_renderer_create(job->app->ctx, &desc, &s.renderer);
    }
    if (result == TRL_OK) {
        result = trl_scene_view(scene, job->scene ? trl_scene_view_name(scene, 0) : "full-disc",
                                &s.view);
    }
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        s.radiance[i] = calloc((size_t)WIDTH * HEIGHT * 4, sizeof *s.radiance[i]);
        if (!s.radiance[i]) {
            report_error(EXIT_FAILED, "bench: out of memory");
            result = TRL_ERROR_MEMORY;
        }
    }
    if (result == TRL_OK) {
        result = measure(&s);
    }
    free(s.radiance[0]);
    free(s.radiance[1]);
    trl_renderer_destroy(&s.renderer);
    trl_scene_destroy(&scene);
    return result;
}
