// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Seconds from the start of the program to its first finished picture.
#include "bench.h"

#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

extern char **environ;

enum { DEFAULT_RUNS = 5 };

// Lets this program draw a picture and waits for it. False (reported) when that fails.
static bool draw_picture(const char *scene, const char *output, double *spent_s)
{
    const char *const words[] = {"terrella", "render", scene,     "--size", "1280x720",
                                 "-o",       output,   "--quiet", NULL};
    const double begun_s = progress_clock_s();
    pid_t child = 0;
    int status = 0;
    const int failure =
        posix_spawn(&child, "/proc/self/exe", NULL, NULL, (char *const *)words, environ);
    const bool is_good = failure == 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
                         WEXITSTATUS(status) == 0;
    *spent_s = progress_clock_s() - begun_s;
    if (!is_good) {
        report_error(EXIT_FAILED, "bench: terrella render %s did not succeed", scene);
    }
    return is_good;
}

static trl_result measure_scene(const struct bench_job *job, const char *scene, const char *output)
{
    const char *slash = strrchr(scene, '/');
    const char *name = slash ? slash + 1 : scene;
    const int runs = bench_runs(job, DEFAULT_RUNS);
    trl_result result = TRL_OK;
    double spent_s = 0.0;
    // The first one fills the caches.
    for (int i = 0; result == TRL_OK && i <= runs; i++) {
        if (!progress_report(&job->app->progress, "starting", (double)i / (runs + 1)) ||
            !draw_picture(scene, output, &spent_s)) {
            return TRL_ERROR_CANCELLED;
        }
        if (i > 0) {
            result =
                bench_add(job->table, (struct bench_sample){name, "first picture", "s", spent_s});
        }
    }
    bench_show(job);
    return result;
}

static bool has_all_layers(struct app *app, const char *path)
{
    trl_scene *scene = NULL;
    bool has_all = trl_scene_load(app->ctx, path, &scene) == TRL_OK;
    for (size_t i = 0; has_all && i < trl_scene_layer_count(scene); i++) {
        has_all = trl_scene_layer_is_present(scene, i);
    }
    trl_scene_destroy(&scene);
    return has_all;
}

// The bare sphere, and Earth where its data is there.
static trl_result measure_shipped(const struct bench_job *job, const char *output)
{
    static const char *const files[] = {"bare-sphere.json", "earth.json"};
    trl_result result = TRL_OK;
    for (size_t i = 0; result == TRL_OK && i < sizeof files / sizeof files[0]; i++) {
        char *path = app_find_scene(files[i]);
        if (!path) {
            report_error(EXIT_FAILED, "bench: %s is not found; give a scene with --scene",
                         files[i]);
            return TRL_ERROR_IO;
        }
        if (has_all_layers(job->app, path)) {
            result = measure_scene(job, path, output);
        }
        free(path);
    }
    return result;
}

trl_result bench_run_start(const struct bench_job *job)
{
    const char *temporary = getenv("TMPDIR");
    char output[4096];
    snprintf(output, sizeof output, "%s/terrella-bench-%ld.png",
             temporary && *temporary ? temporary : "/tmp", (long)getpid());
    const trl_result result =
        job->scene ? measure_scene(job, job->scene, output) : measure_shipped(job, output);
    unlink(output);
    return result;
}
