// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds for the page of validate: drawn and traced pictures of one field, and where they differ.
#include "validate.h"

#include "bare_scene.h"
#include "data_uri.h"
#include "validate_map.h"

#include <math.h>
#include <stdlib.h>

// Paths of a pixel for each second that the run has; fewer than the least tell nothing.
static const double PATHS_A_SECOND = 0.12;
static const double LEAST_PATHS = 64;

// Radiance and errors of the traced picture, and its colours and those of the map.
struct sheets {
    float radiance[CLOUD_PIXELS * 4], error[CLOUD_PIXELS * 4];
    uint8_t colours[CLOUD_PIXELS * 4], map[CLOUD_PIXELS * 4];
};

static trl_result show_traced(const struct validate *v, const trl_scene *scene,
                              const struct cloud_check *check, struct sheets *sheets,
                              struct validate_cloud_look *out)
{
    trl_view view = check->view;
    view.has_fixed_exposure = true;
    view.exposure_ev100 = check->drawn.ev100;
    const trl_result result = trl_radiance_develop(v->app->ctx, scene, &view, CLOUD_WIDTH,
                                                   CLOUD_HEIGHT, sheets->radiance, sheets->colours);
    if (result == TRL_OK) {
        out->traced = data_uri_of_picture(v->app->ctx, CLOUD_WIDTH, CLOUD_HEIGHT, sheets->colours);
    }
    return result;
}

static void show_map(const struct validate *v, const struct cloud_check *check,
                     struct sheets *sheets, struct validate_cloud_look *out)
{
    const struct shot *shot = &check->drawn;
    const struct validate_sheet drawn = {shot->width, shot->height, shot->radiance, NULL};
    const struct validate_sheet traced = {CLOUD_WIDTH, CLOUD_HEIGHT, sheets->radiance,
                                          sheets->error};
    const struct validate_map map = {
        .traced = &traced, .drawn = &drawn, .base = &drawn, .white_cd_m2 = 1.2 * exp2(shot->ev100)};
    struct validate_pictures unused;
    validate_map_draw(&map, sheets->map, &unused);
    out->map = data_uri_of_picture(v->app->ctx, CLOUD_WIDTH, CLOUD_HEIGHT, sheets->map);
}

static trl_result show_look(const struct validate *v, const trl_scene *scene,
                            const struct cloud_check *check, struct validate_cloud_look *out)
{
    struct sheets *sheets = malloc(sizeof *sheets);
    if (!sheets) {
        report_error(EXIT_FAILED, "validate: out of memory");
        return TRL_ERROR_MEMORY;
    }
    const struct shot *shot = &check->drawn;
    cloud_check_join(check, sheets->radiance, sheets->error);
    out->figures = cloud_check_judge(check);
    out->drawn = data_uri_of_picture(v->app->ctx, shot->width, shot->height, shot->picture);
    trl_result result = show_traced(v, scene, check, sheets, out);
    show_map(v, check, sheets, out);
    free(sheets);
    return result == TRL_OK && !(out->drawn && out->traced && out->map) ? TRL_ERROR_IO : result;
}

static trl_result check_looks(struct validate *v, const trl_scene *scene, trl_renderer *renderer)
{
    struct cloud_check *check = malloc(sizeof *check);
    trl_result result = check ? TRL_OK : TRL_ERROR_MEMORY;
    if (!check) {
        report_error(EXIT_FAILED, "validate: out of memory");
    }
    for (int look = 0; look < CLOUD_LOOKS && result == TRL_OK; look++) {
        const double at = fmin(validate_spent_s(v) / v->budget_s, 0.9);
        progress_set_part(&v->app->progress, "clouds", at, at + 0.03);
        result = cloud_check_make(v->app, scene, renderer, look, v->clouds.paths, check);
        if (result == TRL_OK) {
            result = show_look(v, scene, check, &v->clouds.looks[look]);
        }
        cloud_check_finish(check);
    }
    free(check);
    return result;
}

enum exit_status validate_check_clouds(struct validate *v)
{
    const double paths = floor(PATHS_A_SECOND * v->budget_s);
    if (paths < LEAST_PATHS) {
        return EXIT_OK;
    }
    v->clouds.paths = (uint64_t)paths;
    trl_scene *scene = NULL;
    trl_renderer *renderer = NULL;
    trl_result result = bare_scene_make_cloudy(v->app, CLOUD_COVER, &scene);
    if (result == TRL_OK) {
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = scene;
        result = trl_renderer_create(v->app->ctx, &desc, &renderer);
    }
    if (result == TRL_OK) {
        result = check_looks(v, scene, renderer);
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    return report_result(result);
}
