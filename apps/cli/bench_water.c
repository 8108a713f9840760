// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The table of light that leaves the water: seconds, size, error; and the colours that pictures
// make of it, against paths of light.
#include "bare_scene.h"
#include "bench.h"

#include <terrella/water.h>

#include <math.h>
#include <stdio.h>

enum { DEFAULT_RUNS = 3 };

trl_result bench_run_water_tables(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_result result = bench_load_scene(job, "earth.json", &scene);
    const int runs = bench_runs(job, DEFAULT_RUNS);
    for (int i = 0; result == TRL_OK && i < runs; i++) {
        trl_water_table_stats stats;
        result = trl_water_table_measure(job->app->ctx, scene, &stats);
        const char *name = result == TRL_OK ? trl_scene_name(scene) : "";
        const struct bench_sample samples[] = {
            {name, "table", "s", stats.make_s},
            {name, "size", "MB", (double)stats.bytes / 1e6},
            {name, "mean error", "%", 100 * stats.mean_error},
            {name, "largest error", "%", 100 * stats.largest_error},
            {name, "table under water", "s", stats.under_make_s},
            {name, "size of that", "MB", (double)stats.under_bytes / 1e6}};
        for (int k = 0; k < 6 && result == TRL_OK; k++) {
            result = bench_add(job->table, samples[k]);
        }
    }
    trl_scene_destroy(&scene);
    return result;
}

// Elek 2010, Figure 8, over the bed of Figure 5.
static const struct water_kind {
    const char *name, *water;
    uint64_t paths; // for each wavelength; particles that scatter forward need more
} kinds[] = {{"clear", "\"chlorophyll_mg_m3\": 0.1, \"dissolved_per_m_440\": 0.01", 20000},
             {"algal", "\"chlorophyll_mg_m3\": 10, \"dissolved_per_m_440\": 0.1", 60000},
             {"muddy", "\"chlorophyll_mg_m3\": 1, \"mud_g_m3\": 10", 40000}};
enum { KINDS = sizeof kinds / sizeof *kinds, DEPTHS = 4, SUNS = 2, EYES = 3 };
enum { PLACES = EYES * DEPTHS * SUNS };

static const double DEPTHS_M[DEPTHS] = {2, 4, 10, 100};
static const struct hour {
    const char *name;
    double sun_zenith_rad;
} hours[SUNS] = {{"noon", 0.35}, {"4 PM", 1.05}};
// In the water half way down, but no deeper than DIVE_M; up is through Snell's window.
static const double DIVE_M = 2;
static const struct eye {
    const char *name;
    bool is_under;
    double view_zenith_rad;
} eyes[EYES] = {{"from above", false, 2.5}, {"under, down", true, 2.5}, {"under, up", true, 0.5}};

// The place's number counts suns, then depths, then eyes.
static int sun_of(int place)
{
    return place % SUNS;
}

static double depth_of(int place)
{
    return DEPTHS_M[place / SUNS % DEPTHS];
}

static const struct eye *eye_of(int place)
{
    return &eyes[place / SUNS / DEPTHS];
}

static double luminance(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Largest difference of a channel over the brightest channel.
static double colour_difference(const double rgb[3], const double wanted[3])
{
    double most = 0, largest = 0;
    for (int c = 0; c < 3; c++) {
        most = fmax(most, wanted[c]);
        largest = fmax(largest, fabs(rgb[c] - wanted[c]));
    }
    return largest / most;
}

// Of two runs of paths their mean is the truth, and half of their difference its noise.
static trl_result add_errors(const struct bench_job *job, const char *place, const double rgb[3],
                             const double first[3], const double second[3])
{
    double mean[3];
    for (int c = 0; c < 3; c++) {
        mean[c] = 0.5 * (first[c] + second[c]);
    }
    const struct bench_sample samples[] = {
        {place, "luminance", "%", 100 * (luminance(rgb) / luminance(mean) - 1)},
        {place, "colour", "%", 100 * colour_difference(rgb, mean)},
        {place, "noise of that", "%", 100 * colour_difference(first, mean)}};
    trl_result result = TRL_OK;
    for (int k = 0; k < 3 && result == TRL_OK; k++) {
        result = bench_add(job->table, samples[k]);
    }
    return result;
}

static trl_result compare_places(const struct bench_job *job, const struct water_kind *kind,
                                 const trl_water_colour (*colours)[PLACES])
{
    trl_result result = TRL_OK;
    for (int i = 0; i < 2 * PLACES && result == TRL_OK; i++) {
        const int n = i / 2;
        const bool is_sky = i % 2;
        char place[BENCH_NAME_MAX];
        snprintf(place, sizeof place, "%s %s, %g m, %s", kind->name, eye_of(n)->name, depth_of(n),
                 is_sky ? "sky" : hours[sun_of(n)].name);
        if (!is_sky) {
            result = add_errors(job, place, colours[0][n].star_rgb, colours[1][n].star_rgb,
                                colours[2][n].star_rgb);
        } else if (sun_of(n) == 0) {
            result = add_errors(job, place, colours[0][n].sky_rgb, colours[1][n].sky_rgb,
                                colours[2][n].sky_rgb);
        }
    }
    bench_show(job);
    return result;
}

trl_result bench_run_water_error(const struct bench_job *job)
{
    trl_result result = TRL_OK;
    for (int k = 0; k < KINDS && result == TRL_OK; k++) {
        char keys[256];
        snprintf(keys, sizeof keys,
                 "\"ocean\": {\"water\": {%s}, \"bed\": {\"albedo\": [[400, 0.22], [500, 0.32], "
                 "[600, 0.4], [700, 0.45]]}}",
                 kinds[k].water);
        trl_scene *scene = NULL;
        result = bare_scene_make(job->app, kinds[k].name, keys, &scene);
        trl_water_query queries[PLACES];
        for (int n = 0; n < PLACES; n++) {
            const double eye_m = fmin(0.5 * depth_of(n), DIVE_M);
            queries[n] = (trl_water_query){.depth_m = depth_of(n),
                                           .eye_depth_m = eye_of(n)->is_under ? eye_m : 0,
                                           .sun_zenith_rad = hours[sun_of(n)].sun_zenith_rad,
                                           .view_zenith_rad = eye_of(n)->view_zenith_rad,
                                           .azimuth_rad = 1,
                                           .wavelength_nm = 550};
        }
        trl_water_colour colours[3][PLACES];
        for (int run = 0; run < 3 && result == TRL_OK; run++) {
            trl_water_desc desc = trl_water_desc_default();
            desc.uses_reference = run > 0;
            desc.paths = kinds[k].paths;
            desc.seed = (uint64_t)run;
            result = trl_water_colours(job->app->ctx, scene, &desc, queries, PLACES, colours[run]);
        }
        if (result == TRL_OK) {
            result = compare_places(job, &kinds[k], (const trl_water_colour(*)[PLACES])colours);
        }
        trl_scene_destroy(&scene);
    }
    return result;
}
