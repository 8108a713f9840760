// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Michelic 2019, Table 2: what spherical Gerstner waves cost, by their number. The paper moves the
// vertices of a grid of 80 x 80 by them; here they are summed for each pixel of open water, so a
// picture of 80 x 80 has as many sums. An invented planet that is all water needs no data.
#include "bench.h"

#include <math.h>
#include <stdio.h>

enum { NUMBERS = 4, SIZES = 2, DEFAULT_RUNS = 3, GRID_SIDE = 80 };

static const int numbers[NUMBERS] = {20, 50, 100, 1000};
static const double paper_ms[NUMBERS] = {0.6, 0.7, 0.9, 4.0};
static const struct number_size sizes[SIZES] = {{GRID_SIDE, GRID_SIDE}, {1024, 576}};
static const char *const metrics[SIZES] = {"80 x 80 sums", "1024 x 576 sums"};

static trl_result make_scene(const struct bench_job *job, int number, trl_scene **out)
{
    char text[640];
    const int length =
        snprintf(text, sizeof text,
                 "{\"terrella\": 1, \"name\": \"waves\", \"star\": {\"spectral_irradiance\": 1.5},"
                 " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
                 " \"surface\": {\"noise\": {\"ocean_share\": 0.99, \"height_m\": 100, "
                 "\"amplitude_m\": 10}},"
                 " \"ocean\": {\"waves\": {\"wind_m_s\": 9, \"count\": %d}}}",
                 number);
    return trl_scene_parse(job->app->ctx, text, (size_t)length, "waves", ".", out);
}

// From 20 m, so low that the nearest pixels show all waves.
static trl_view choose_view(void)
{
    trl_view view = trl_view_default();
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    view.altitude_m = 20;
    view.pitch_rad = -0.6;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.6;
    return view;
}

static trl_result measure_size(const struct bench_job *job, trl_renderer *renderer, int number,
                               int size)
{
    char name[BENCH_NAME_MAX];
    snprintf(name, sizeof name, "%d waves", numbers[number]);
    trl_view view = choose_view();
    trl_result result = TRL_OK;
    const int runs = bench_runs(job, DEFAULT_RUNS);
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        view.time_s += 0.04; // phases are found anew, as in every frame
        result = bench_draw(job, renderer, &view, sizes[size], 0);
        trl_renderer_wait(renderer);
        if (i > 0 && result == TRL_OK) { // the first frame compiles
            result = bench_add(job->table, (struct bench_sample){name, metrics[size], "ms",
                                                                 bench_pass_ms(renderer, "waves")});
        }
    }
    if (result == TRL_OK && size == 0) {
        result = bench_add_paper(
            job->table, (struct bench_sample){name, metrics[size], "ms", paper_ms[number]});
    }
    return result;
}

static trl_result measure(const struct bench_job *job, int number)
{
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_result result = make_scene(job, numbers[number], &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = bench_renderer_desc(job, scene);
        desc.measures_time = true;
        result = trl_renderer_create(job->app->ctx, &desc, &renderer);
    }
    // The larger picture of a thousand waves takes half a minute a frame in software.
    const int shown = numbers[number] > 100 ? 1 : SIZES;
    for (int size = 0; size < shown && result == TRL_OK; size++) {
        result = measure_size(job, renderer, number, size);
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    return result;
}

trl_result bench_run_michelic_table2(const struct bench_job *job)
{
    trl_result result = TRL_OK;
    if (job->scene) {
        report_error(EXIT_FAILED,
                     "bench: michelic-table2 has a scene of its own; leave out --scene");
        return TRL_ERROR_INVALID;
    }
    for (int i = 0; i < NUMBERS && result == TRL_OK; i++) {
        if (!progress_report(&job->app->progress, "waves", (double)i / NUMBERS)) {
            report_error(EXIT_FAILED, "cancelled while summing %d waves", numbers[i]);
            return TRL_ERROR_CANCELLED;
        }
        result = measure(job, i);
        bench_show(job);
    }
    bench_note(job->table,
               "Ours: the pass that sums displacement, slopes and Jacobian of all waves for each "
               "pixel of open water, finding their phases included; 28 bytes a wave.");
    bench_note(job->table,
               "The paper: GeForce GTX 1060; vertices of a grid of 80 x 80, which is tessellated "
               "further, displaced and drawn. Its sums are therefore more than 6400.");
    return result;
}
