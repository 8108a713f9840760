// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Santana 2017, Section 8: what the sky model rayleigh loses and saves with few points along a line
// of sight, few wavelengths, and polynomials for the optical depth. Times are those of the pass of
// air and ground alone; only their ratios can be compared with the paper's.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 480, HEIGHT = 270, DEFAULT_RUNS = 3, VALUES = WIDTH * HEIGHT * 4 };

// From outside, as the paper measures, and where most lines of sight are long.
static const char *const view_names[] = {"full-disc", "limb", "ground", "sunset"};
enum { VIEWS = sizeof view_names / sizeof *view_names };

struct santana {
    const struct bench_job *job;
    trl_scene *scene;
    trl_view view;
    const char *view_name;
    int done, all; // pictures, for the progress line
};

// One picture, and the row of the times that it took.
struct picture {
    const char *case_name, *metric;
    float *radiance; // owned; VALUES
    double ms;       // the fastest
};

static trl_result begin(const struct bench_job *job, int pictures, struct santana *out)
{
    *out = (struct santana){.job = job, .all = pictures};
    return bench_load_scene(job, "bare-sphere.json", &out->scene);
}

static trl_result choose_view(struct santana *s, int which)
{
    const size_t count = trl_scene_view_count(s->scene);
    s->view_name = !s->job->scene ? view_names[which]
                   : count > 0    ? trl_scene_view_name(s->scene, (size_t)which % count)
                                  : "default";
    s->view = trl_view_default();
    return s->job->scene && count == 0 ? TRL_OK : trl_scene_view(s->scene, s->view_name, &s->view);
}

// Draws once to warm up, then measures.
static trl_result measure_drawing(const struct santana *s, trl_renderer *renderer,
                                  struct picture *out)
{
    trl_result result = TRL_OK;
    const int runs = bench_runs(s->job, DEFAULT_RUNS);
    out->ms = INFINITY;
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        result = trl_renderer_draw(renderer, &s->view, WIDTH, HEIGHT, 0);
        trl_renderer_wait(renderer);
        if (i > 0) {
            const double ms = bench_pass_ms(renderer, "sky");
            out->ms = fmin(out->ms, ms);
            if (result == TRL_OK) {
                result = bench_add(s->job->table,
                                   (struct bench_sample){out->case_name, out->metric, "ms", ms});
            }
        }
    }
    return result == TRL_OK ? trl_renderer_read_radiance(renderer, out->radiance) : result;
}

static trl_result draw(struct santana *s, const trl_rayleigh_desc *options, struct picture *out)
{
    out->radiance = malloc(VALUES * sizeof *out->radiance);
    if (!out->radiance) {
        report_error(EXIT_FAILED, "bench: out of memory");
        return TRL_ERROR_MEMORY;
    }
    if (!progress_report(&s->job->app->progress, s->view_name, (double)s->done++ / s->all)) {
        report_error(EXIT_FAILED, "cancelled while drawing %s", s->view_name);
        return TRL_ERROR_CANCELLED;
    }
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    desc.sky_model = TRL_SKY_RAYLEIGH;
    desc.rayleigh = options;
    desc.measures_time = true;
    trl_renderer *renderer = NULL;
    trl_result result = trl_renderer_create(s->job->app->ctx, &desc, &renderer);
    if (result == TRL_OK) {
        result = measure_drawing(s, renderer, out);
    }
    trl_renderer_destroy(&renderer);
    return result;
}

static double size_of(const float rgb[3])
{
    return hypot(hypot((double)rgb[0], (double)rgb[1]), (double)rgb[2]);
}

// Below this many cd/m2 a pixel is taken for black. Not a share of the brightest: that is the
// star's disc, beside which all the sky is black.
static const double DARK = 1;

// Mean distance of the colours over the size of the better's, in per cent, where there is light.
static double compare(const struct picture *picture, const struct picture *better)
{
    double sum = 0;
    size_t count = 0;
    for (int i = 0; i < VALUES; i += 4) {
        const float *a = &picture->radiance[i];
        const float *b = &better->radiance[i];
        const double size = size_of(b);
        if (size > DARK) {
            const float away[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
            sum += size_of(away) / size;
            count++;
        }
    }
    return count > 0 ? 100 * sum / (double)count : 0;
}

static trl_result add(const struct santana *s, struct bench_sample sample)
{
    return bench_add(s->job->table, sample);
}

// Section 8.2 and 8.3 are the same with another number: a study of one option.
struct study {
    const char *noun; // of the option
    const int *numbers;
    int count;
    int truth;              // a number that stands for all
    int base, fewer;        // the paper's two, of which `base` is its truth
    double error, speed_up; // what it prints of them, in per cent; 0: nothing
    void (*set)(trl_rayleigh_desc *desc, int number);
};

static trl_result add_pair(const struct santana *s, const struct study *study,
                           const struct picture *fewer, const struct picture *base)
{
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "%s, %d to %d %s", s->view_name, study->base, study->fewer,
             study->noun);
    const struct bench_sample samples[] = {{name, "error", "%", compare(fewer, base)},
                                           {name, "speed-up", "times", base->ms / fewer->ms}};
    const double printed[] = {study->error, study->speed_up};
    trl_result result = TRL_OK;
    for (int i = 0; i < 2 && result == TRL_OK; i++) {
        result = add(s, samples[i]);
        if (result == TRL_OK && printed[i] > 0) {
            result =
                bench_add_paper(s->job->table, (struct bench_sample){name, samples[i].metric,
                                                                     samples[i].unit, printed[i]});
        }
    }
    return result;
}

enum { STUDY_MAX = 16 };

static void name_case(const struct santana *s, const struct study *study, int number,
                      char out[BENCH_NAME_MAX])
{
    snprintf(out, BENCH_NAME_MAX, "%s, %d %s", s->view_name, number, study->noun);
}

static trl_result study_view(struct santana *s, const struct study *study)
{
    struct picture pictures[STUDY_MAX + 1] = {{0}};
    const struct picture *truth = &pictures[study->count];
    const struct picture *base = NULL;
    const struct picture *fewer = NULL;
    trl_result result = TRL_OK;
    for (int i = 0; i <= study->count && result == TRL_OK; i++) {
        const int number = i == study->count ? study->truth : study->numbers[i];
        trl_rayleigh_desc options = trl_rayleigh_desc_default();
        study->set(&options, number);
        char name[BENCH_NAME_MAX];
        name_case(s, study, number, name);
        pictures[i].case_name = name;
        pictures[i].metric = "sky pass";
        result = draw(s, &options, &pictures[i]);
        base = number == study->base ? &pictures[i] : base;
        fewer = number == study->fewer ? &pictures[i] : fewer;
    }
    for (int i = 0; i < study->count && result == TRL_OK; i++) {
        char name[BENCH_NAME_MAX];
        name_case(s, study, study->numbers[i], name);
        result = add(s, (struct bench_sample){name, "error", "%", compare(&pictures[i], truth)});
    }
    if (result == TRL_OK && base && fewer) {
        result = add_pair(s, study, fewer, base);
    }
    for (int i = 0; i <= study->count; i++) {
        free(pictures[i].radiance);
    }
    return result;
}

static trl_result run_study(const struct bench_job *job, const struct study *study)
{
    struct santana s;
    trl_result result = begin(job, VIEWS * (study->count + 1), &s);
    for (int i = 0; i < VIEWS && result == TRL_OK; i++) {
        result = choose_view(&s, i);
        if (result == TRL_OK) {
            result = study_view(&s, study);
        }
    }
    bench_note(job->table,
               "%d x %d. Error: mean distance of the colours in linear sRGB against %d "
               "%s, where it is brighter than 1 cd/m2.",
               WIDTH, HEIGHT, study->truth, study->noun);
    bench_note(job->table,
               "Rows \"%d to %d\": against %d, as the paper does, which looks from outside.",
               study->base, study->fewer, study->base);
    trl_scene_destroy(&s.scene);
    return result;
}

static void set_samples(trl_rayleigh_desc *desc, int number)
{
    desc->samples = (uint32_t)number;
}

static void set_wavelengths(trl_rayleigh_desc *desc, int number)
{
    desc->wavelengths = (uint32_t)number;
}

trl_result bench_run_santana_samples(const struct bench_job *job)
{
    static const int numbers[] = {3, 5, 7, 9, 11, 13};
    const struct study study = {.noun = "samples",
                                .numbers = numbers,
                                .count = sizeof numbers / sizeof *numbers,
                                .truth = TRL_RAYLEIGH_MAX_SAMPLES,
                                .base = 13,
                                .fewer = 5,
                                .error = 16.15,
                                .speed_up = 2.6,
                                .set = set_samples};
    bench_note(job->table, "Not the same rule: the paper adds up densities at points, here the "
                           "column between two points is exact and only the light in it is "
                           "interpolated. His error is not one that this replaces.");
    return run_study(job, &study);
}

trl_result bench_run_santana_spectrum(const struct bench_job *job)
{
    static const int numbers[] = {3, 4, 5, 6, 8, 10, 14, 20};
    const struct study study = {.noun = "wavelengths",
                                .numbers = numbers,
                                .count = sizeof numbers / sizeof *numbers,
                                .truth = TRL_RAYLEIGH_MAX_WAVELENGTHS,
                                .base = 20,
                                .fewer = 10,
                                .error = 9.81,
                                .set = set_wavelengths};
    bench_note(job->table, "The paper does not say how it measures an error of colour.");
    return run_study(job, &study);
}

static trl_result add_errors(const struct santana *s, const trl_rayleigh_desc *options,
                             const char *name)
{
    trl_rayleigh_errors errors;
    trl_result result = trl_rayleigh_errors_read(s->job->app->ctx, s->scene, options, &errors);
    if (result == TRL_OK) {
        result = add(s, (struct bench_sample){name, "mean error", "%", 100 * errors.mean});
    }
    return result == TRL_OK
               ? add(s, (struct bench_sample){name, "largest error", "%", 100 * errors.largest})
               : result;
}

// The optical depth alone, which is quick: every pair.
static trl_result measure_fits(const struct santana *s)
{
    static const uint32_t heights[] = {5, 10, 20};
    trl_rayleigh_desc options = trl_rayleigh_desc_default();
    trl_result result = add_errors(s, &options, "texture");
    options.optical_depth = TRL_RAYLEIGH_FIT;
    for (int i = 0; i < 9 && result == TRL_OK; i++) {
        char name[BENCH_NAME_MAX];
        options.fit_heights = heights[i / 3];
        options.fit_degree = 3 + 2 * (uint32_t)(i % 3);
        snprintf(name, sizeof name, "%u heights, degree %u", options.fit_heights,
                 options.fit_degree);
        result = add_errors(s, &options, name);
    }
    return result == TRL_OK
               ? bench_add_paper(s->job->table, (struct bench_sample){"10 heights, degree 5",
                                                                      "mean error", "%", 2.84})
               : result;
}

static trl_result time_fit(struct santana *s)
{
    struct picture pictures[2] = {{s->view_name, "sky pass, texture", NULL, 0},
                                  {s->view_name, "sky pass, fit", NULL, 0}};
    trl_rayleigh_desc options = trl_rayleigh_desc_default();
    trl_result result = draw(s, &options, &pictures[0]);
    options.optical_depth = TRL_RAYLEIGH_FIT;
    if (result == TRL_OK) {
        result = draw(s, &options, &pictures[1]);
    }
    if (result == TRL_OK) {
        result = add(s, (struct bench_sample){s->view_name, "fit / texture", "times",
                                              pictures[1].ms / pictures[0].ms});
    }
    if (result == TRL_OK) {
        result = add(s, (struct bench_sample){s->view_name, "colours, fit against texture", "%",
                                              compare(&pictures[1], &pictures[0])});
    }
    free(pictures[0].radiance);
    free(pictures[1].radiance);
    return result;
}

trl_result bench_run_santana_fit(const struct bench_job *job)
{
    struct santana s;
    trl_result result = begin(job, 2 * VIEWS, &s);
    if (result == TRL_OK) {
        result = measure_fits(&s);
    }
    for (int i = 0; i < VIEWS && result == TRL_OK; i++) {
        result = choose_view(&s, i);
        if (result == TRL_OK) {
            result = time_fit(&s);
        }
    }
    bench_note(job->table, "Error: of the column from above the air to a point, over all angles "
                           "and heights. The paper fits g itself, at even heights; here it is the "
                           "inverse air mass.");
    bench_note(job->table, "Times at %d x %d with 10 heights and degree 5.", WIDTH, HEIGHT);
    trl_scene_destroy(&s.scene);
    return result;
}
