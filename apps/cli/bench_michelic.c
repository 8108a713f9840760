// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Michelic 2019, Table 1: milliseconds of invented ground by layers of noise and by the size of the
// grid that is projected and then tessellated. Both are set here; the scene says only what else the
// planet is like.
#include "bench.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { GRIDS = 3, ROWS = 4, DEFAULT_RUNS = 3, PATCH_CELLS = 8 };
static const struct number_size SCREEN = {1920, 1080}; // "all images are rendered in full-HD"

static const uint32_t grids[GRIDS] = {50, 100, 200};
static const int layers[ROWS] = {0, 1, 5, 10};
static const double printed_ms[ROWS][GRIDS] = {
    {0.8, 0.5, 0.9}, {1.0, 0.7, 1.3}, {1.3, 1.3, 1.9}, {1.7, 2.6, 2.6}};

static const double pi = 3.14159265358979323846;
// The map of continents: waves longer than so many texels, of so many rows (docs/physics.md, 26).
static const double map_texels = 4, map_rows = 512;

struct michelic {
    const struct bench_job *job;
    json_t *scene; // changed for each number of layers
    trl_renderer *renderer;
    trl_view view;
    double best_ms[ROWS][GRIDS]; // of whole frames, processor time
    int done;
};

static trl_result fail_scene(const char *path, const char *why)
{
    report_error(EXIT_FAILED, "bench: %s: %s", path, why);
    return TRL_ERROR_INVALID;
}

static trl_result read_scene(struct michelic *m)
{
    char *own = m->job->scene ? NULL : app_find_scene("aurelia.json");
    const char *path = m->job->scene ? m->job->scene : own;
    json_error_t error;
    m->scene = path ? json_load_file(path, 0, &error) : NULL;
    trl_result result = TRL_OK;
    if (!m->scene) {
        result = fail_scene(path ? path : "aurelia.json", path ? error.text : "not found");
    } else if (!json_is_object(json_object_get(json_object_get(m->scene, "surface"), "noise"))) {
        result = fail_scene(path, "has no ground of noise to measure");
    }
    free(own);
    return result;
}

static double read_number(const json_t *object, const char *key, double fallback)
{
    const json_t *value = json_object_get(object, key);
    return json_is_number(value) ? json_number_value(value) : fallback;
}

// So many octaves below the map of continents, which has those that are longer. None: noise without
// height, of which the shaders take no octave. And no air, which the paper's table is without, too.
static void set_layers(struct michelic *m, int count)
{
    json_t *noise = json_object_get(json_object_get(m->scene, "surface"), "noise");
    static const char *const others[] = {"atmosphere", "stars", "sky_model", "rayleigh"};
    for (size_t i = 0; i < sizeof others / sizeof *others; i++) {
        json_object_del(m->scene, others[i]);
    }
    const double radius_m = read_number(json_object_get(m->scene, "planet"), "radius_m", 6371000);
    const double longest_m = map_texels * pi * radius_m / map_rows;
    const double in_map = log(read_number(noise, "continents_m", 6e6) / longest_m) /
                          log(read_number(noise, "lacunarity", 2));
    const int octaves = (int)ceil(fmax(in_map, 0)) + (count > 0 ? count : 1);
    json_object_set_new(noise, "octaves", json_integer(octaves));
    json_object_set_new(noise, "form", json_string("plain"));
    if (count == 0) {
        json_object_set_new(noise, "amplitude_m", json_integer(0));
    }
}

static trl_result load_layers(struct michelic *m, int row, trl_scene **out)
{
    json_t *kept = m->scene;
    m->scene = json_deep_copy(kept);
    set_layers(m, layers[row]);
    char *text = m->scene ? json_dumps(m->scene, 0) : NULL;
    json_decref(m->scene);
    m->scene = kept;
    if (!text) {
        report_error(EXIT_FAILED, "bench: out of memory");
        return TRL_ERROR_MEMORY;
    }
    const trl_result result =
        trl_scene_parse(m->job->app->ctx, text, strlen(text), "michelic-table1", ".", out);
    free(text);
    return result;
}

static void name_case(char name[BENCH_NAME_MAX], int row, int grid)
{
    static const char *const words[ROWS] = {"continents", "1 layer", "5 layers", "10 layers"};
    snprintf(name, BENCH_NAME_MAX, "%s, %u x %u", words[row], grids[grid], grids[grid]);
}

static trl_result add_samples(struct michelic *m, const char *name, double frame_ms)
{
    const double vertices_ms = bench_pass_ms(m->renderer, "vertices");
    const double mesh_ms = bench_pass_ms(m->renderer, "mesh");
    const double surface_ms = bench_pass_ms(m->renderer, "surface");
    const struct bench_sample samples[] = {
        {name, "ground", "ms", vertices_ms + mesh_ms + surface_ms},
        {name, "its vertices", "ms", vertices_ms},
        {name, "its mesh", "ms", mesh_ms},
        {name, "its colours and normals", "ms", surface_ms},
        {name, "processor time of the frame", "ms", frame_ms}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof samples / sizeof *samples && result == TRL_OK; i++) {
        result = bench_add(m->job->table, samples[i]);
    }
    return result;
}

static trl_result measure_case(struct michelic *m, int row, int grid)
{
    char name[BENCH_NAME_MAX];
    name_case(name, row, grid);
    const struct bench_sample printed = {name, "ground", "ms", printed_ms[row][grid]};
    trl_result result = bench_add_paper(m->job->table, printed);
    const int runs = bench_runs(m->job, DEFAULT_RUNS);
    // The first frame of a row compiles: its ground has layers of its own.
    const int warm = grid == 0 ? 1 : 0;
    for (int i = 0; i < warm + runs && result == TRL_OK; i++) {
        // A step aside by a tenth of a degree, for which the grid is projected anew: the paper
        // does so in every frame.
        m->view.longitude_rad += (i % 2 ? -0.1 : 0.1) * pi / 180;
        const clock_t begun = clock();
        result = bench_draw(m->job, m->renderer, &m->view, SCREEN, 0.02);
        trl_renderer_wait(m->renderer);
        const double frame_ms = 1e3 * (double)(clock() - begun) / CLOCKS_PER_SEC;
        if (i >= warm && result == TRL_OK) {
            double *best_ms = &m->best_ms[row][grid];
            *best_ms = *best_ms > 0 ? fmin(*best_ms, frame_ms) : frame_ms;
            result = add_samples(m, name, frame_ms);
        }
    }
    return result;
}

static trl_result measure_grids(struct michelic *m, int row)
{
    trl_result result = TRL_OK;
    for (int grid = 0; grid < GRIDS && result == TRL_OK; grid++) {
        if (!progress_report(&m->job->app->progress, "layers and grids",
                             (double)m->done++ / (ROWS * GRIDS))) {
            report_error(EXIT_FAILED, "cancelled while drawing layers of noise");
            return TRL_ERROR_CANCELLED;
        }
        result = trl_renderer_set_hemisphere(m->renderer, grids[grid] * PATCH_CELLS);
        result = result == TRL_OK ? measure_case(m, row, grid) : result;
        bench_show(m->job);
    }
    return result;
}

static trl_result measure_row(struct michelic *m, int row)
{
    trl_scene *scene = NULL;
    trl_result result = load_layers(m, row, &scene);
    const char *name = m->job->scene ? NULL : "range";
    result = result == TRL_OK ? trl_scene_view(scene, name, &m->view) : result;
    if (result == TRL_OK) {
        trl_renderer_desc desc = bench_renderer_desc(m->job, scene);
        desc.mesher = m->job->mesher < 0 ? TRL_MESHER_TESSELLATED : (trl_mesher)m->job->mesher;
        desc.measures_time = true;
        result = trl_renderer_create(m->job->app->ctx, &desc, &m->renderer);
    }
    result = result == TRL_OK ? measure_grids(m, row) : result;
    trl_renderer_destroy(&m->renderer);
    trl_scene_destroy(&scene);
    return result;
}

static void tell_ratios(struct michelic *m)
{
    double(*best)[GRIDS] = m->best_ms;
    bench_note(m->job->table,
               "Processor time of the frame, from continents to 10 layers: %.2f, %.2f and %.2f "
               "times (the paper's ground: 2.1, 5.2, 2.9); from 50 x 50 to 200 x 200: %.2f to %.2f "
               "times (1.1 to 1.5).",
               best[3][0] / best[0][0], best[3][1] / best[0][1], best[3][2] / best[0][2],
               fmin(best[0][2] / best[0][0], best[3][2] / best[3][0]),
               fmax(best[0][2] / best[0][0], best[3][2] / best[3][0]));
    bench_note(
        m->job->table,
        "Ground: grid of so many patches projected and displaced, tessellated and drawn, and "
        "coloured with normals, at 1920 x 1080; light is in the frame only, and there is no air. "
        "Continents "
        "are "
        "a map of 1024 x 512, layers octaves of simplex noise below it, of the form plain.");
    bench_note(m->job->table, "The paper: GeForce GTX 1060.");
}

trl_result bench_run_michelic_table1(const struct bench_job *job)
{
    struct michelic m = {.job = job};
    trl_result result = TRL_OK;
    if (job->mesher == TRL_MESHER_QUADTREE || job->mesher == TRL_MESHER_PROJECTIVE) {
        report_error(EXIT_USAGE,
                     "bench: michelic-table1 is for --mesher tessellated or hemisphere");
        return TRL_ERROR_INVALID;
    }
    result = read_scene(&m);
    for (int row = 0; row < ROWS && result == TRL_OK; row++) {
        result = measure_row(&m, row);
    }
    if (result == TRL_OK) {
        tell_ratios(&m);
    }
    json_decref(m.scene);
    return result;
}
