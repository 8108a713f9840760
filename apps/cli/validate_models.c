// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What the models answer: numbers, and pictures of the same views.
#include "validate.h"

#include "data_uri.h"
#include "difference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double rad_per_deg = 3.14159265358979323846 / 180.0;
static const struct number_size picture_size = {208, 117};
enum { PICTURE_SAMPLES = 2 };

// All queries of a scene, one case after the other.
static size_t gather_queries(const struct validate_scene *scene, trl_sky_query *out)
{
    size_t count = 0;
    for (int c = 0; c < scene->case_count; c++) {
        memcpy(out + count, scene->cases[c].queries, (size_t)scene->cases[c].count * sizeof *out);
        count += (size_t)scene->cases[c].count;
    }
    return count;
}

static void spread_answers(struct validate_scene *scene, int model, const double *radiance)
{
    for (int c = 0; c < scene->case_count; c++) {
        struct validate_answer *answer = &scene->cases[c].answers[model];
        const size_t count = (size_t)scene->cases[c].count;
        answer->is_there = true;
        memcpy(answer->radiance, radiance, count * sizeof *radiance);
        radiance += count;
    }
}

// A model other than the spectral one may refuse a scene; then it says why and has no answers.
static enum exit_status ask_model(struct validate *v, struct validate_scene *scene, int model)
{
    enum { MOST = VALIDATE_CASES * VALIDATE_VALUES };
    trl_sky_query queries[MOST];
    double radiance[MOST];
    const size_t count = gather_queries(scene, queries);
    trl_sky_desc desc = trl_sky_desc_default();
    desc.model = (trl_sky_model)model;
    v->app->holds_errors = model != TRL_SKY_SPECTRAL;
    const double begun_s = progress_clock_s();
    const trl_result result =
        trl_sky_radiance(v->app->ctx, scene->scene, &desc, queries, count, radiance, NULL);
    scene->solve_s[model] = progress_clock_s() - begun_s;
    v->app->holds_errors = false;
    if (result == TRL_OK) {
        spread_answers(scene, model, radiance);
    } else if (result == TRL_ERROR_INVALID && model != TRL_SKY_SPECTRAL) {
        snprintf(scene->refusal[model], sizeof scene->refusal[model], "%.190s", v->app->held_error);
    } else {
        if (model != TRL_SKY_SPECTRAL) {
            report_error(EXIT_FAILED, "%s", v->app->held_error);
        }
        return EXIT_FAILED;
    }
    return EXIT_OK;
}

// Toward the sun, but for the angle that shows both it and the sky beside it.
static trl_view make_view(const struct validate_scene *scene, const struct validate_case *c)
{
    const double radius_m = trl_scene_ground_radius_m(scene->scene);
    const double dip_rad = acos(radius_m / (radius_m + c->altitude_m));
    const bool is_outside = c->altitude_m > trl_scene_top_radius_m(scene->scene) - radius_m;
    trl_view view = trl_view_default();
    view.latitude_rad = 0;
    view.longitude_rad = 0;
    view.altitude_m = c->altitude_m;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.heading_rad = 0;
    view.roll_rad = 0;
    view.vertical_fov_rad = (is_outside ? 34 : 60) * rad_per_deg;
    view.pitch_rad = -dip_rad + (is_outside ? -8 : 14) * rad_per_deg;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = c->sun_elevation_deg * rad_per_deg;
    view.sun_longitude_or_azimuth_rad = 25 * rad_per_deg;
    view.has_fixed_exposure = false;
    view.exposure_bias_ev = 0;
    return view;
}

// The shots of one model in one scene; those of the spectral model are kept to compare with.
struct gallery {
    struct validate *v;
    struct validate_scene *scene;
    trl_renderer *renderer;
    struct shot base[VALIDATE_CASES];
};

// A frame whose programs are ready, alone.
static trl_result time_frame(const struct gallery *g, const trl_view *view,
                             struct validate_answer *answer)
{
    trl_renderer_wait(g->renderer);
    const double begun_s = progress_clock_s();
    const trl_result result =
        trl_renderer_draw(g->renderer, view, picture_size.width * PICTURE_SAMPLES,
                          picture_size.height * PICTURE_SAMPLES, 0);
    trl_renderer_wait(g->renderer);
    answer->frame_ms = 1e3 * (progress_clock_s() - begun_s);
    return result;
}

static trl_result encode_map(const struct gallery *g, struct validate_case *c,
                             struct validate_answer *answer, const struct shot *base,
                             const struct shot *shot)
{
    struct difference d;
    uint8_t *map = malloc((size_t)shot->width * shot->height * 4);
    if (!map || !difference_make(base, shot, &d)) {
        free(map);
        report_error(EXIT_FAILED, "validate: out of memory");
        return TRL_ERROR_MEMORY;
    }
    difference_draw(&d, c->map_range, map);
    answer->pictures.map = data_uri_of_picture(g->v->app->ctx, shot->width, shot->height, map);
    difference_finish(&d);
    free(map);
    return answer->pictures.map ? TRL_OK : TRL_ERROR_IO;
}

static trl_result picture_case(struct gallery *g, int model, int index)
{
    struct validate_case *c = &g->scene->cases[index];
    struct validate_answer *answer = &c->answers[model];
    trl_view view = make_view(g->scene, c);
    if (g->base[index].picture) {
        view.has_fixed_exposure = true;
        view.exposure_ev100 = g->base[index].ev100;
    }
    const struct shot_desc desc = {.renderer = g->renderer,
                                   .view = &view,
                                   .model = (trl_sky_model)model,
                                   .size = picture_size,
                                   .samples = PICTURE_SAMPLES};
    struct shot shot = {0};
    trl_result result = time_frame(g, &view, answer);
    if (result == TRL_OK) {
        result = shot_take(&desc, &shot);
    }
    if (result == TRL_OK) {
        answer->pictures.picture =
            data_uri_of_picture(g->v->app->ctx, shot.width, shot.height, shot.picture);
        result = answer->pictures.picture ? TRL_OK : TRL_ERROR_IO;
    }
    if (result == TRL_OK && g->base[index].picture) {
        result = encode_map(g, c, answer, &g->base[index], &shot);
    }
    if (result == TRL_OK && model == TRL_SKY_SPECTRAL) {
        g->base[index] = shot;
    } else {
        shot_finish(&shot);
    }
    return result;
}

// False, with *result set, when pictures cannot be made by the model: one other than the spectral
// may refuse a scene, and then there are none of it.
static bool choose_model(struct gallery *g, int model, trl_result *result)
{
    struct app *app = g->v->app;
    app->holds_errors = model != TRL_SKY_SPECTRAL;
    *result = trl_renderer_set_sky_model(g->renderer, (trl_sky_model)model);
    app->holds_errors = false;
    const bool is_chosen = *result == TRL_OK;
    if (*result == TRL_ERROR_INVALID && model != TRL_SKY_SPECTRAL) {
        *result = TRL_OK;
    } else if (!is_chosen && model != TRL_SKY_SPECTRAL) {
        report_error(EXIT_FAILED, "%s", app->held_error);
    }
    return is_chosen;
}

static trl_result picture_model(struct gallery *g, int model)
{
    trl_result result = TRL_OK;
    if (!choose_model(g, model, &result)) {
        return result;
    }
    // The driver compiles at the first frame; that of the last view leaves no maps for the first.
    const trl_view last = make_view(g->scene, &g->scene->cases[g->scene->case_count - 1]);
    result = trl_renderer_draw(g->renderer, &last, picture_size.width * PICTURE_SAMPLES,
                               picture_size.height * PICTURE_SAMPLES, 0);
    for (int c = 0; result == TRL_OK && c < g->scene->case_count; c++) {
        g->scene->cases[c].map_range = 0.5;
        result = picture_case(g, model, c);
        if (!progress_report(&g->v->app->progress, "drawing", (double)c / g->scene->case_count)) {
            report_error(EXIT_FAILED, "validate: cancelled");
            result = TRL_ERROR_CANCELLED;
        }
    }
    return result;
}

static trl_result picture_scene(struct validate *v, struct validate_scene *scene)
{
    struct gallery g = {.v = v, .scene = scene};
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene->scene;
    desc.sky_model = TRL_SKY_SPECTRAL;
    trl_result result = trl_renderer_create(v->app->ctx, &desc, &g.renderer);
    for (int m = 0; result == TRL_OK && m < VALIDATE_MODELS; m++) {
        result = picture_model(&g, m);
    }
    for (int c = 0; c < scene->case_count; c++) {
        shot_finish(&g.base[c]);
    }
    trl_renderer_destroy(&g.renderer);
    return result;
}

enum exit_status validate_ask_models(struct validate *v)
{
    enum exit_status status = EXIT_OK;
    for (int s = 0; status == EXIT_OK && s < v->scene_count; s++) {
        struct validate_scene *scene = &v->scenes[s];
        const double share = progress_clock_s() - v->app->progress.started_s;
        char stage[80];
        snprintf(stage, sizeof stage, "%.40s by the models", trl_scene_name(scene->scene));
        const double at = fmin(share / v->budget_s, 0.9);
        progress_set_part(&v->app->progress, stage, at, at + 0.01);
        for (int m = 0; status == EXIT_OK && m < VALIDATE_MODELS; m++) {
            status = ask_model(v, scene, m);
        }
        if (status == EXIT_OK && v->wants_pictures) {
            status = report_result(picture_scene(v, scene));
        }
    }
    return status;
}
