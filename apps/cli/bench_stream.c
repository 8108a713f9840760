// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters that do not fit into memory: how soon a complete frame stands, how fast tiles come, and
// what they take. On a generated globe of heights that is several times what rasters may take, and
// on Earth with as little.
#include "bench.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum {
    GLOBE_WIDTH = 16384, // 268 MB
    GLOBE_HEIGHT = GLOBE_WIDTH / 2,
    DEFAULT_RUNS = 2,
    FLIGHT_FRAMES = 8,
    FRAME_WIDTH = 1024,
    FRAME_HEIGHT = 576,
    PATH_SIZE = 4096
};
static const double pi = 3.14159265358979323846;

// Scene and raster in a folder of their own.
struct generated {
    char folder[PATH_SIZE], scene[PATH_SIZE + 16], raster[PATH_SIZE + 16], header[PATH_SIZE + 16];
};

static const char scene_text[] =
    "{\"terrella\": 1, \"name\": \"Generated\",\n"
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},\n"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.2},\n"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"gas\",\n"
    "   \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 2e-6, \"exponent\": "
    "-4}},\n"
    "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"isotropic\"}]},\n"
    " \"surface\": {\"layers\": [{\"elevation\": \"globe.bil\"}]},\n"
    " \"views\": {\n"
    "  \"orbit\": {\"camera\": {\"latitude_deg\": 0, \"longitude_deg\": 0, \"altitude_m\": 9e6,\n"
    "    \"heading_deg\": 0, \"pitch_deg\": -90, \"vertical_fov_deg\": 60},\n"
    "    \"sun\": {\"elevation_deg\": 40, \"azimuth_deg\": 90}},\n"
    "  \"ridge\": {\"camera\": {\"latitude_deg\": 20, \"longitude_deg\": 30, \"altitude_m\": "
    "20000,\n"
    "    \"heading_deg\": 90, \"pitch_deg\": -15, \"vertical_fov_deg\": 60},\n"
    "    \"sun\": {\"elevation_deg\": 40, \"azimuth_deg\": 180}}}}\n";

static const char header_text[] = "BYTEORDER I\nLAYOUT BIL\nNROWS %d\nNCOLS %d\nNBANDS 1\n"
                                  "NBITS 16\nPIXELTYPE SIGNEDINT\nULXMAP %.12f\nULYMAP %.12f\n"
                                  "XDIM %.12f\nYDIM %.12f\n";

// Rows of ridges in three sizes: cheap, and never alike.
static void fill_row(int y, int16_t *row)
{
    const double v = (double)y / GLOBE_HEIGHT;
    for (int x = 0; x < GLOBE_WIDTH; x++) {
        const double u = (double)x / GLOBE_WIDTH;
        row[x] = (int16_t)(2000 * sin(2 * pi * 7 * u) * sin(pi * 9 * v) +
                           700 * sin(2 * pi * 61 * u + 20 * v) +
                           200 * sin(2 * pi * 503 * u) * sin(pi * 557 * v));
    }
}

static bool write_globe(FILE *file)
{
    int16_t *row = malloc(GLOBE_WIDTH * sizeof *row);
    bool is_written = row != NULL;
    for (int y = 0; y < GLOBE_HEIGHT && is_written; y++) {
        fill_row(y, row);
        is_written = fwrite(row, sizeof *row, GLOBE_WIDTH, file) == GLOBE_WIDTH;
    }
    free(row);
    return is_written;
}

static bool write_files(const struct generated *g)
{
    const double pixel = 360.0 / GLOBE_WIDTH;
    FILE *scene = fopen(g->scene, "w");
    FILE *header = fopen(g->header, "w");
    FILE *raster = fopen(g->raster, "wb");
    bool is_written = scene && header && raster && fputs(scene_text, scene) >= 0 &&
                      fprintf(header, header_text, GLOBE_HEIGHT, GLOBE_WIDTH, -180 + pixel / 2,
                              90 - pixel / 2, pixel, pixel) > 0 &&
                      write_globe(raster);
    FILE *const files[] = {scene, header, raster};
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        is_written = (!files[i] || fclose(files[i]) == 0) && is_written;
    }
    return is_written;
}

static trl_result generate(struct generated *g)
{
    const char *temporary = getenv("TMPDIR");
    snprintf(g->folder, sizeof g->folder, "%s/terrella-bench-XXXXXX",
             temporary && *temporary ? temporary : "/tmp");
    const bool has_folder = mkdtemp(g->folder) != NULL;
    snprintf(g->scene, sizeof g->scene, "%s/scene.json", g->folder);
    snprintf(g->raster, sizeof g->raster, "%s/globe.bil", g->folder);
    snprintf(g->header, sizeof g->header, "%s/globe.hdr", g->folder);
    if (!has_folder || !write_files(g)) {
        report_error(EXIT_FAILED, "bench: %s: a raster of %d MB cannot be written", g->folder,
                     GLOBE_WIDTH / 1000 * GLOBE_HEIGHT / 1000 * 2);
        return TRL_ERROR_IO;
    }
    return TRL_OK;
}

static void remove_files(const struct generated *g)
{
    unlink(g->scene);
    unlink(g->raster);
    unlink(g->header);
    rmdir(g->folder);
}

// One scene with so much memory for rasters; one view of it.
struct stream_case {
    const struct bench_job *job;
    trl_context *ctx;
    const trl_scene *scene;
    const char *view;
    char name[BENCH_NAME_MAX];
};

static trl_result add(const struct stream_case *c, const char *metric, const char *unit,
                      double value)
{
    return bench_add(c->job->table, (struct bench_sample){c->name, metric, unit, value});
}

static trl_result draw(trl_renderer *renderer, const trl_view *view)
{
    const trl_result result = trl_renderer_draw(renderer, view, FRAME_WIDTH, FRAME_HEIGHT, 0);
    trl_renderer_wait(renderer);
    return result;
}

// The tiles of the first frame, and the time that they add to it: the same frame again has them.
static trl_result measure_first(const struct stream_case *c, trl_renderer *renderer,
                                const trl_view *view, double begun_s)
{
    const double created_s = progress_clock_s();
    trl_result result = draw(renderer, view);
    const double first_s = progress_clock_s();
    trl_tile_stats stats;
    trl_renderer_tile_stats(renderer, &stats);
    if (result == TRL_OK) {
        result = draw(renderer, view);
    }
    const double again_s = progress_clock_s() - first_s;
    const double tiles_s = first_s - created_s - again_s;
    if (result == TRL_OK) {
        result = add(c, "start", "s", created_s - begun_s);
    }
    if (result == TRL_OK) {
        result = add(c, "start and first complete frame", "s", first_s - begun_s);
    }
    if (result == TRL_OK && stats.loaded > 0) {
        result = add(c, "tiles of it", "tiles", (double)stats.loaded);
    }
    if (result == TRL_OK && stats.loaded > 0 && tiles_s > 0) {
        result = add(c, "tiles per second", "1/s", (double)stats.loaded / tiles_s);
    }
    return result == TRL_OK ? add(c, "the same frame again", "ms", 1e3 * again_s) : result;
}

// Along the ground by a fiftieth of the picture's height above it a frame, each complete.
static trl_result measure_flight(const struct stream_case *c, trl_renderer *renderer, trl_view view)
{
    trl_tile_stats before, after;
    trl_renderer_tile_stats(renderer, &before);
    const double begun_s = progress_clock_s();
    trl_result result = TRL_OK;
    for (int i = 0; i < FLIGHT_FRAMES && result == TRL_OK; i++) {
        view.longitude_rad += fmin(0.02, view.altitude_m / 6e6 / 5);
        result = draw(renderer, &view);
    }
    const double spent_s = progress_clock_s() - begun_s;
    trl_renderer_tile_stats(renderer, &after);
    if (result == TRL_OK) {
        result = add(c, "frame in flight", "ms", 1e3 * spent_s / FLIGHT_FRAMES);
    }
    if (result == TRL_OK && after.rasters > 0) {
        result = add(c, "tiles a frame in flight", "tiles",
                     (double)(after.loaded - before.loaded) / FLIGHT_FRAMES);
    }
    if (result == TRL_OK && after.loaded > 0) {
        result = add(c, "reading a tile (CPU)", "ms", 1e3 * after.read_s / (double)after.loaded);
    }
    return result == TRL_OK && after.rasters > 0 ? add(c, "held in tiles", "MB", after.held_mb)
                                                 : result;
}

static trl_result measure_run(const struct stream_case *c)
{
    trl_renderer_desc desc = bench_renderer_desc(c->job, c->scene);
    trl_renderer *renderer = NULL;
    trl_view view;
    const double begun_s = progress_clock_s();
    trl_result result = trl_scene_view(c->scene, c->view, &view);
    if (result == TRL_OK) {
        result = trl_renderer_create(c->ctx, &desc, &renderer);
    }
    if (result == TRL_OK) {
        result = measure_first(c, renderer, &view, begun_s);
    }
    if (result == TRL_OK) {
        result = measure_flight(c, renderer, view);
    }
    trl_renderer_destroy(&renderer);
    return result;
}

// Solves the air and compiles shaders.
static trl_result warm_up(const struct stream_case *c)
{
    trl_renderer_desc desc = bench_renderer_desc(c->job, c->scene);
    trl_renderer *renderer = NULL;
    trl_view view;
    trl_result result = trl_scene_view(c->scene, c->view, &view);
    if (result == TRL_OK) {
        result = trl_renderer_create(c->ctx, &desc, &renderer);
    }
    if (result == TRL_OK) {
        result = draw(renderer, &view);
    }
    trl_renderer_destroy(&renderer);
    return result;
}

struct stream_scene {
    const char *path, *name, *view;
    uint32_t memory_mb;
};

static void log_line(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    (void)user;
    if (level == TRL_LOG_ERROR) {
        trl_log_stderr(NULL, level, item, message);
    }
}

static trl_result measure_scene(const struct bench_job *job, const struct stream_scene *s)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.log = log_line; // that a raster has no overviews is known here
    desc.progress = progress_report;
    desc.progress_user = &job->app->progress;
    desc.raster_mb = s->memory_mb;
    struct stream_case c = {.job = job, .view = s->view};
    snprintf(c.name, sizeof c.name, "%.24s %.16s, %u MB", s->name, s->view ? s->view : "first view",
             s->memory_mb);
    trl_scene *scene = NULL;
    trl_result result = trl_context_create(&desc, &c.ctx);
    if (result == TRL_OK) {
        result = trl_scene_load(c.ctx, s->path, &scene);
    }
    c.scene = scene;
    if (result == TRL_OK) {
        result = warm_up(&c);
    }
    for (int i = 0; i < bench_runs(job, DEFAULT_RUNS) && result == TRL_OK; i++) {
        result = measure_run(&c);
    }
    bench_show(job);
    trl_scene_destroy(&scene);
    trl_context_destroy(&c.ctx);
    return result;
}

static trl_result measure_generated(const struct bench_job *job)
{
    struct generated g = {0};
    trl_result result = generate(&g);
    static const char *const views[] = {"orbit", "ridge"};
    for (size_t i = 0; i < 2 && result == TRL_OK; i++) {
        result = measure_scene(job, &(struct stream_scene){g.scene, "generated", views[i], 64});
    }
    remove_files(&g);
    return result;
}

trl_result bench_run_stream(const struct bench_job *job)
{
    bench_note(job->table,
               "generated: %d x %d heights of 16 bits, %d MB, without overviews, of which all is "
               "read at the start; each frame of %d x %d waits until it is complete",
               GLOBE_WIDTH, GLOBE_HEIGHT, (int)(2e-6 * GLOBE_WIDTH * GLOBE_HEIGHT), FRAME_WIDTH,
               FRAME_HEIGHT);
    if (job->scene) {
        return measure_scene(job, &(struct stream_scene){job->scene, "scene", NULL, 64});
    }
    trl_result result = measure_generated(job);
    char *earth = app_find_scene("earth.json");
    static const uint32_t memories_mb[] = {3000, 300};
    for (size_t i = 0; i < 2 && result == TRL_OK && earth; i++) {
        result = measure_scene(
            job, &(struct stream_scene){earth, "earth", "himalaya-morning", memories_mb[i]});
    }
    free(earth);
    return result;
}
