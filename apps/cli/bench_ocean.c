// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the sea costs in a frame, pass by pass, from 10 m, 1 km and orbit. An invented planet that
// is all water needs no data.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PLACES = 3, PASSES = 4, DEFAULT_RUNS = 3 };

static const struct number_size size = {640, 360};
static const char *const passes[PASSES] = {"sea mesh", "waves", "sky", "all"};
static const struct place {
    const char *name;
    double altitude_m, pitch_deg;
} places[PLACES] = {{"10 m", 10, -3}, {"1 km", 1000, -20}, {"400 km", 4e5, -60}};

static trl_result make_scene(const struct bench_job *job, trl_scene **out)
{
    static const char text[] =
        "{\"terrella\": 1, \"name\": \"ocean\", \"star\": {\"spectral_irradiance\": 1.5},"
        " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
        " \"surface\": {\"noise\": {\"ocean_share\": 0.99, \"height_m\": 100, "
        "\"amplitude_m\": 10}},"
        " \"ocean\": {\"waves\": {\"wind_m_s\": 9}}}";
    return trl_scene_parse(job->app->ctx, text, sizeof text - 1, "ocean", ".", out);
}

static double find_ms(const trl_renderer *renderer, const char *pass)
{
    enum { MOST = 32 };
    trl_timing rows[MOST];
    const size_t all = trl_renderer_timings(renderer, rows, MOST);
    double sum_ms = 0;
    for (size_t i = 0; i < all && i < MOST; i++) {
        sum_ms += bench_timing_ms(&rows[i]);
    }
    return strcmp(pass, "all") == 0 ? sum_ms : bench_pass_ms(renderer, pass);
}

static trl_result measure(const struct bench_job *job, trl_renderer *renderer,
                          const struct place *place)
{
    trl_view view = trl_view_default();
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    view.altitude_m = place->altitude_m;
    view.pitch_rad = place->pitch_deg * acos(-1) / 180;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.6;
    trl_result result = TRL_OK;
    const int runs = bench_runs(job, DEFAULT_RUNS);
    for (int i = 0; i <= runs && result == TRL_OK; i++) {
        view.time_s += 0.04; // waves move, as in every frame
        result = bench_draw(job, renderer, &view, size, 0);
        trl_renderer_wait(renderer);
        for (int p = 0; p < PASSES && i > 0 && result == TRL_OK; p++) { // the first compiles
            result = bench_add(job->table, (struct bench_sample){place->name, passes[p], "ms",
                                                                 find_ms(renderer, passes[p])});
        }
    }
    bench_show(job);
    return result;
}

trl_result bench_run_ocean_frame(const struct bench_job *job)
{
    if (job->scene) {
        report_error(EXIT_FAILED, "bench: ocean-frame has a scene of its own; leave out --scene");
        return TRL_ERROR_INVALID;
    }
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_result result = make_scene(job, &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = bench_renderer_desc(job, scene);
        desc.measures_time = true;
        result = trl_renderer_create(job->app->ctx, &desc, &renderer);
    }
    for (int i = 0; i < PLACES && result == TRL_OK; i++) {
        if (!progress_report(&job->app->progress, "sea", (double)i / PLACES)) {
            report_error(EXIT_FAILED, "cancelled while drawing the sea from %s", places[i].name);
            result = TRL_ERROR_CANCELLED;
            break;
        }
        result = measure(job, renderer, &places[i]);
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    bench_note(job->table, "640 x 360, no air; \"all\" is every pass of the frame together.");
    return result;
}
