// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How far drawn clouds are from traced ones: a field of cumulus at noon, at sunset and against the
// sun, luminance pixel by pixel.
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

// Errors of the primaries of a pixel come from the same paths: together at most their sum.
static trl_result add_errors(const struct cloud_error *e, const char *name, const float *drawn)
{
    double sum = 0;
    double sum_drawn = 0;
    double size = 0;
    double noise = 0;
    for (size_t i = 0; i < PIXELS; i++) {
        const double truth = difference_luminance(e->traced + 4 * i);
        const double got = difference_luminance(drawn + 4 * i);
        sum += truth / PIXELS;
        sum_drawn += got / PIXELS;
        size += fabs(got - truth) / truth / PIXELS;
        noise += difference_luminance(e->noise + 4 * i) / truth / PIXELS;
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
        result = bench_add(e->job->table, rows[i]);
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
        result = add_errors(e, look->name, drawn.radiance);
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
