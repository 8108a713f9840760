// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How far drawn clouds are from traced ones: a field of cumulus at noon, at sunset and against the
// sun, luminance pixel by pixel, and where it is off: in what is dark or bright.
#include "bench.h"

#include "bare_scene.h"
#include "cloud_check.h"

enum { PATHS_A_RUN = 64 };
static trl_result add_figures(const struct bench_job *job, int look, const struct cloud_figures *f)
{
    const char *name = cloud_look_name(look);
    const struct bench_sample rows[] = {
        {name, "mean luminance, traced", "cd m^-2", f->traced_cd_m2},
        {name, "mean luminance, drawn over traced", "", f->ratio},
        {name, "mean relative error of pixels", "%", 100 * f->size},
        {name, "of that noise of the paths, by themselves", "%", 100 * f->noise},
        {name, "mean relative error without noise, at least", "%", 100 * f->least_size},
        {name, "root mean square without noise", "%", 100 * f->rms},
        {name, "darkest third as drawn, over traced", "", f->thirds[0]},
        {name, "middle third", "", f->thirds[1]},
        {name, "brightest third", "", f->thirds[2]},
        {name, "contrast, drawn", "", f->contrast[0]},
        {name, "contrast, traced", "", f->contrast[1]}};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < sizeof rows / sizeof *rows && result == TRL_OK; i++) {
        result = bench_add(job->table, rows[i]);
    }
    bench_show(job);
    return result;
}

static trl_result check_look(const struct bench_job *job, const trl_scene *scene,
                             trl_renderer *renderer, int look)
{
    static struct cloud_check check; // too large for a stack
    const uint64_t paths = (uint64_t)(PATHS_A_RUN * bench_runs(job, 1));
    trl_result result = cloud_check_make(job->app, scene, renderer, look, paths, &check);
    if (result == TRL_OK) {
        const struct cloud_figures figures = cloud_check_judge(&check);
        result = add_figures(job, look, &figures);
    }
    cloud_check_finish(&check);
    return result;
}

trl_result bench_run_cloud_error(const struct bench_job *job)
{
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_result result = bare_scene_make_cloudy(job->app, CLOUD_COVER, &scene);
    if (result == TRL_OK) {
        const trl_renderer_desc desc = bench_renderer_desc(job, scene);
        result = trl_renderer_create(job->app->ctx, &desc, &renderer);
    }
    for (int look = 0; look < CLOUD_LOOKS && result == TRL_OK; look++) {
        result = check_look(job, scene, renderer, look);
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    bench_note(job->table,
               "Traced with %d paths a pixel, times --runs; drawn %d x %d as large and "
               "averaged.",
               PATHS_A_RUN, 2 * CLOUD_FINER, 2 * CLOUD_FINER);
    bench_note(job->table, "Paths carry light of very different strength, so their own idea of "
                           "their noise is too small where they are few. The root mean square "
                           "uses the product of what two halves of them say.");
    return result;
}
