// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pictures of the views: by the models, by the path tracer, and maps of how they differ.
#include "validate.h"

#include "data_uri.h"
#include "validate_map.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double rad_per_deg = 3.14159265358979323846 / 180.0;

// Traced pictures are smaller by one of these factors, all of which divide both sides.
static const struct number_size picture_size = {144, 80};
static const uint32_t factors[] = {2, 4, 8};
enum { FACTORS = sizeof factors / sizeof *factors };
enum { PICTURE_SAMPLES = 2, LEAST_PATHS = 32, MOST_PATHS = 1024 };

// Share of the time that is left for traced pictures; relative noise of a pixel at which more
// pixels are better than more paths, and below which neither is needed.
static const double TIME_SHARE = 0.25;
static const double COARSE_NOISE = 0.3;
static const double FINE_NOISE = 0.02;
// A view whose smallest picture would take so many times its share of the time gets none.
static const double PATIENCE = 6;
// A path of a picture carries four wavelengths: what it costs against one of a value.
static const double PATH_COST = 1.5;

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

// The shots of a scene.
struct gallery {
    struct validate *v;
    struct validate_scene *scene;
    trl_renderer *renderer;
    struct shot shots[VALIDATE_CASES][VALIDATE_MODELS];
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

// The spectral model's exposure is that of all.
static trl_view exposed_view(const struct gallery *g, int index)
{
    trl_view view = make_view(g->scene, &g->scene->cases[index]);
    const struct shot *base = &g->shots[index][TRL_SKY_SPECTRAL];
    if (base->picture) {
        view.has_fixed_exposure = true;
        view.exposure_ev100 = base->ev100;
    }
    return view;
}

static trl_result draw_case(struct gallery *g, int model, int index)
{
    struct validate_answer *answer = &g->scene->cases[index].answers[model];
    struct shot *shot = &g->shots[index][model];
    const trl_view view = exposed_view(g, index);
    const struct shot_desc desc = {.renderer = g->renderer,
                                   .view = &view,
                                   .model = (trl_sky_model)model,
                                   .size = picture_size,
                                   .samples = PICTURE_SAMPLES};
    trl_result result = time_frame(g, &view, answer);
    if (result == TRL_OK) {
        result = shot_take(&desc, shot);
    }
    if (result == TRL_OK) {
        const struct validate_sheet sheet = {shot->width, shot->height, shot->radiance, NULL};
        validate_map_profile(&sheet, &answer->pictures.profile);
        answer->pictures.picture =
            data_uri_of_picture(g->v->app->ctx, shot->width, shot->height, shot->picture);
        result = answer->pictures.picture ? TRL_OK : TRL_ERROR_IO;
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

static trl_result draw_model(struct gallery *g, int model)
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
        result = draw_case(g, model, c);
        if (!progress_report(&g->v->app->progress, "drawing", (double)c / g->scene->case_count)) {
            report_error(EXIT_FAILED, "validate: cancelled");
            result = TRL_ERROR_CANCELLED;
        }
    }
    return result;
}

static trl_result draw_models(struct gallery *g)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = g->scene->scene;
    desc.sky_model = TRL_SKY_SPECTRAL;
    trl_result result = trl_renderer_create(g->v->app->ctx, &desc, &g->renderer);
    for (int m = 0; result == TRL_OK && m < VALIDATE_MODELS; m++) {
        result = draw_model(g, m);
    }
    trl_renderer_destroy(&g->renderer);
    return result;
}

// Mean noise of one path of the view's values, relative.
static double path_noise(const struct validate_case *c)
{
    double sum = 0;
    for (int i = 0; i < c->count; i++) {
        sum += validate_path_noise(c, i);
    }
    return c->count > 0 ? sum / c->count : 0;
}

struct plan {
    struct number_size size;
    double pixel_paths;
};

// The largest picture whose pixels are not too noisy in the time that there is for it. No paths
// when even the smallest takes far too long, unless the user has as much time as it takes.
static struct plan choose_plan(const struct validate *v, const struct validate_case *c,
                               double time_s)
{
    const double paths = time_s / (PATH_COST * validate_path_cost_s(c));
    const double noise = path_noise(c);
    struct plan plan = {.pixel_paths = 0};
    for (int f = 0; f < FACTORS; f++) {
        plan.size =
            (struct number_size){picture_size.width / factors[f], picture_size.height / factors[f]};
        plan.pixel_paths = paths / ((double)plan.size.width * plan.size.height);
        if (plan.pixel_paths >= LEAST_PATHS && noise / sqrt(plan.pixel_paths) <= COARSE_NOISE) {
            break;
        }
    }
    if (v->paths == 0 && PATIENCE * plan.pixel_paths < LEAST_PATHS) {
        plan.pixel_paths = 0;
        return plan;
    }
    const double enough = fmin(pow(noise / FINE_NOISE, 2), MOST_PATHS);
    plan.pixel_paths = fmax(fmin(plan.pixel_paths, enough), LEAST_PATHS);
    return plan;
}

struct traced {
    struct validate_sheet sheet;
    float *radiance, *error; // owned
    uint8_t *codes;          // owned
};

static void traced_finish(struct traced *traced)
{
    free(traced->radiance);
    free(traced->error);
    free(traced->codes);
}

static trl_result trace_view(const struct gallery *g, const trl_view *view, const struct plan *plan,
                             struct traced *out)
{
    const uint32_t width = plan->size.width;
    const uint32_t height = plan->size.height;
    const size_t count = (size_t)width * height * 4;
    *out = (struct traced){.radiance = malloc(count * sizeof(float)),
                           .error = malloc(count * sizeof(float)),
                           .codes = malloc(count)};
    if (!out->radiance || !out->error || !out->codes) {
        report_error(EXIT_FAILED, "validate: out of memory");
        return TRL_ERROR_MEMORY;
    }
    out->sheet = (struct validate_sheet){width, height, out->radiance, out->error};
    trl_reference_desc desc = trl_reference_desc_default();
    desc.scene = g->scene->scene;
    desc.paths = (uint64_t)plan->pixel_paths;
    trl_result result =
        trl_reference_render(g->v->app->ctx, &desc, view, width, height, out->radiance, out->error);
    if (result == TRL_OK) {
        result = trl_radiance_develop(g->v->app->ctx, g->scene->scene, view, width, height,
                                      out->radiance, out->codes);
    }
    return result;
}

// How a model's picture differs from the traced one.
static trl_result map_model(const struct gallery *g, int index, int model,
                            const struct traced *traced)
{
    const struct shot *shot = &g->shots[index][model];
    struct validate_pictures *pictures = &g->scene->cases[index].answers[model].pictures;
    if (!shot->picture) {
        return TRL_OK;
    }
    const struct shot *base = &g->shots[index][TRL_SKY_SPECTRAL];
    const struct validate_sheet drawn = {shot->width, shot->height, shot->radiance, NULL};
    const struct validate_sheet exact = {base->width, base->height, base->radiance, NULL};
    const struct validate_map desc = {.traced = &traced->sheet,
                                      .drawn = &drawn,
                                      .base = &exact,
                                      .white_cd_m2 = 1.2 * exp2(base->ev100)};
    uint8_t *map = malloc((size_t)traced->sheet.width * traced->sheet.height * 4);
    if (!map) {
        report_error(EXIT_FAILED, "validate: out of memory");
        return TRL_ERROR_MEMORY;
    }
    validate_map_draw(&desc, map, pictures);
    pictures->map =
        data_uri_of_picture(g->v->app->ctx, traced->sheet.width, traced->sheet.height, map);
    free(map);
    return pictures->map ? TRL_OK : TRL_ERROR_IO;
}

static trl_result trace_case(struct gallery *g, int index, double time_s)
{
    struct validate_case *c = &g->scene->cases[index];
    const trl_view view = exposed_view(g, index);
    const struct plan plan = choose_plan(g->v, c, time_s);
    c->traced_width = plan.size.width;
    c->traced_pixel_paths = plan.pixel_paths;
    c->pitch_rad = view.pitch_rad;
    c->vertical_fov_rad = view.vertical_fov_rad;
    if (plan.pixel_paths == 0) {
        return TRL_OK;
    }
    struct traced traced;
    trl_result result = trace_view(g, &view, &plan, &traced);
    if (result == TRL_OK) {
        validate_map_profile(&traced.sheet, &c->traced.profile);
        c->traced.picture =
            data_uri_of_picture(g->v->app->ctx, plan.size.width, plan.size.height, traced.codes);
        result = c->traced.picture ? TRL_OK : TRL_ERROR_IO;
    }
    for (int m = 0; result == TRL_OK && m < VALIDATE_MODELS; m++) {
        result = map_model(g, index, m, &traced);
    }
    traced_finish(&traced);
    return result;
}

// `views` is how many are left with those of this scene; `end_s` when all should be done.
static trl_result draw_scene(struct validate *v, struct validate_scene *scene, int views,
                             double end_s)
{
    struct gallery *g = calloc(1, sizeof *g);
    if (!g) {
        report_error(EXIT_FAILED, "validate: out of memory");
        return TRL_ERROR_MEMORY;
    }
    g->v = v;
    g->scene = scene;
    trl_result result = draw_models(g);
    for (int c = 0; result == TRL_OK && c < scene->case_count; c++) {
        const double spent_s = validate_spent_s(v);
        const double time_s = fmax(0, end_s - spent_s) / (views - c);
        char stage[80];
        snprintf(stage, sizeof stage, "%.40s, pictures", trl_scene_name(scene->scene));
        const double at = fmin(spent_s / v->budget_s, 0.95);
        progress_set_part(&v->app->progress, stage, at, at + time_s / v->budget_s);
        result = trace_case(g, c, time_s);
    }
    for (int c = 0; c < scene->case_count; c++) {
        for (int m = 0; m < VALIDATE_MODELS; m++) {
            shot_finish(&g->shots[c][m]);
        }
    }
    free(g);
    return result;
}

enum exit_status validate_draw(struct validate *v)
{
    int views = 0;
    for (int s = 0; s < v->scene_count; s++) {
        views += v->scenes[s].case_count;
    }
    const double spent_s = validate_spent_s(v);
    const double end_s = spent_s + TIME_SHARE * fmax(0, v->budget_s - spent_s);
    trl_result result = TRL_OK;
    for (int s = 0; result == TRL_OK && s < v->scene_count; s++) {
        result = draw_scene(v, &v->scenes[s], views, end_s);
        views -= v->scenes[s].case_count;
    }
    return report_result(result);
}
