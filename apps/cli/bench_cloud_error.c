// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How far drawn clouds are from traced ones: a field of cumulus at noon, at sunset and against the
// sun, luminance pixel by pixel, and where it is off: in what is dark or bright.
#include "bench.h"

#include "difference.h"
#include "shot.h"

#include <math.h>
#include <stdlib.h>

enum { WIDTH = 32, HEIGHT = 18, PIXELS = WIDTH * HEIGHT, SAMPLES = 8, PATHS_A_RUN = 64 };
static const double cover = 0.5;
static const double rad = 0.017453292519943295;

struct cloud_look {
    const char *name;
    double altitude_m, heading_deg, pitch_deg, sun_elevation_deg, sun_azimuth_deg;
};
static const struct cloud_look looks[] = {{"noon, from 3 km", 3000, 170, -12, 65, 40},
                                          {"noon, from below", 2, 170, 25, 65, 40},
                                          {"sunset, from 3 km", 3000, 170, -8, 4, 260},
                                          {"against the sun, from 3 km", 3000, 250, -8, 25, 255}};
enum { LOOKS = sizeof looks / sizeof *looks };

struct cloud_error {
    const struct bench_job *job;
    trl_scene *scene;
    trl_renderer *renderer;
    float *traced, *noise; // PIXELS * 4
};

struct luminance {
    double drawn, traced, noise;
};

// Errors of the primaries of a pixel come from the same paths: together at most their sum.
static void find_luminances(const struct cloud_error *e, const float *drawn, struct luminance *out)
{
    for (size_t i = 0; i < PIXELS; i++) {
        out[i] = (struct luminance){difference_luminance(drawn + 4 * i),
                                    difference_luminance(e->traced + 4 * i),
                                    difference_luminance(e->noise + 4 * i)};
    }
}

static trl_result add_errors(const struct bench_job *job, const char *name,
                             const struct luminance *at)
{
    double sum = 0, sum_drawn = 0, size = 0, noise = 0;
    for (size_t i = 0; i < PIXELS; i++) {
        sum += at[i].traced / PIXELS;
        sum_drawn += at[i].drawn / PIXELS;
        size += fabs(at[i].drawn - at[i].traced) / at[i].traced / PIXELS;
        noise += at[i].noise / at[i].traced / PIXELS;
    }
    noise *= sqrt(2 / 3.14159265358979323846); // mean size of a normal error
    const struct bench_sample rows[] = {
        {name, "mean luminance, traced", "cd m^-2", sum},
        {name, "mean luminance, drawn over traced", "", sum_drawn / sum},
        {name, "mean relative error of pixels", "%", 100 * size},
        {name, "of that noise of the paths", "%", 100 * noise},
        {name, "beyond noise", "%", 100 * sqrt(fmax(0, size * size - noise * noise))}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof rows / sizeof *rows && result == TRL_OK; i++) {
        result = bench_add(job->table, rows[i]);
    }
    return result;
}

static int compare_drawn(const void *a, const void *b)
{
    const double x = ((const struct luminance *)a)->drawn, y = ((const struct luminance *)b)->drawn;
    return (x > y) - (x < y);
}

// Of pixels in the order of what is drawn, which has no noise. Standard deviations are over the
// mean; that of what is traced without what its noise adds.
static trl_result add_contrast(const struct bench_job *job, const char *name, struct luminance *at)
{
    static const char *const thirds[] = {"darkest third as drawn, over traced", "middle third",
                                         "brightest third"};
    double sum[2] = {0}, square[2] = {0}, noise = 0;
    trl_result result = TRL_OK;
    qsort(at, PIXELS, sizeof *at, compare_drawn);
    for (size_t third = 0; third < 3 && result == TRL_OK; third++) {
        double drawn = 0, traced = 0;
        for (size_t i = third * (PIXELS / 3); i < (third + 1) * (PIXELS / 3); i++) {
            drawn += at[i].drawn / PIXELS;
            traced += at[i].traced / PIXELS;
            square[0] += at[i].drawn * at[i].drawn / PIXELS;
            square[1] += at[i].traced * at[i].traced / PIXELS;
            noise += at[i].noise * at[i].noise / PIXELS;
        }
        sum[0] += drawn;
        sum[1] += traced;
        const struct bench_sample row = {name, thirds[third], "", drawn / traced};
        result = bench_add(job->table, row);
    }
    const struct bench_sample rows[] = {
        {name, "contrast, drawn", "", sqrt(fmax(square[0] / (sum[0] * sum[0]) - 1, 0))},
        {name, "contrast, traced", "", sqrt(fmax((square[1] - noise) / (sum[1] * sum[1]) - 1, 0))}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows && result == TRL_OK; i++) {
        result = bench_add(job->table, rows[i]);
    }
    return result;
}

static trl_result trace(const struct cloud_error *e, const trl_view *view)
{
    trl_reference_desc desc = trl_reference_desc_default();
    desc.scene = e->scene;
    desc.paths = (uint64_t)(PATHS_A_RUN * bench_runs(e->job, 1));
    return trl_reference_render(e->job->app->ctx, &desc, view, WIDTH, HEIGHT, e->traced, e->noise);
}

static trl_result compare_look(const struct cloud_error *e, const struct cloud_look *look)
{
    trl_view view;
    trl_result result = trl_scene_view(e->scene, "ground", &view);
    if (result != TRL_OK) {
        return result;
    }
    view.altitude_m = look->altitude_m;
    view.heading_rad = look->heading_deg * rad;
    view.pitch_rad = look->pitch_deg * rad;
    view.sun_latitude_or_elevation_rad = look->sun_elevation_deg * rad;
    view.sun_longitude_or_azimuth_rad = look->sun_azimuth_deg * rad;
    result = trace(e, &view);
    const struct shot_desc desc = {.renderer = e->renderer,
                                   .view = &view,
                                   .model = TRL_SKY_SPECTRAL,
                                   .size = {WIDTH, HEIGHT},
                                   .samples = SAMPLES};
    struct shot drawn = {0};
    if (result == TRL_OK) {
        result = shot_take(&desc, &drawn);
    }
    if (result == TRL_OK) {
        struct luminance at[PIXELS];
        find_luminances(e, drawn.radiance, at);
        result = add_errors(e->job, look->name, at);
        result = result == TRL_OK ? add_contrast(e->job, look->name, at) : result;
        bench_show(e->job);
    }
    shot_finish(&drawn);
    return result;
}

trl_result bench_run_cloud_error(const struct bench_job *job)
{
    struct cloud_error e = {.job = job,
                            .traced = malloc(PIXELS * 4 * sizeof(float)),
                            .noise = malloc(PIXELS * 4 * sizeof(float))};
    trl_result result = e.traced && e.noise ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = bench_cloudy_scene(job, cover, &e.scene);
    }
    if (result == TRL_OK) {
        const trl_renderer_desc desc = bench_renderer_desc(job, e.scene);
        result = trl_renderer_create(job->app->ctx, &desc, &e.renderer);
    }
    for (int i = 0; i < LOOKS && result == TRL_OK; i++) {
        result = compare_look(&e, &looks[i]);
    }
    trl_renderer_destroy(&e.renderer);
    trl_scene_destroy(&e.scene);
    free(e.noise);
    free(e.traced);
    bench_note(job->table,
               "Traced with %d paths a pixel, times --runs; drawn %d x %d as large and "
               "averaged.",
               PATHS_A_RUN, SAMPLES, SAMPLES);
    return result;
}
