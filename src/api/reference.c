// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <terrella/atmosphere.h>
#include <terrella/reference.h>

#include "api/check.h"
#include "cloud/traced.h"
#include "frame/daylight.h"
#include "frame/develop.h"
#include "frame/relief.h"
#include "reference/picture.h"
#include "scene/camera.h"
#include "scene/scene.h"

#include <math.h>

enum { REFERENCE_CANARY = 0x54525031 };
static const double MAX_PIXEL_WIDTH = 16;

trl_reference_desc trl_reference_desc_default(void)
{
    return (trl_reference_desc){.canary = REFERENCE_CANARY, .paths = 64, .pixel_width = 1};
}

static trl_result check_desc(const trl_context *ctx, const trl_reference_desc *desc)
{
    TRL_REQUIRE(ctx, desc != NULL);
    TRL_REQUIRE(ctx, desc->canary == REFERENCE_CANARY);
    TRL_REQUIRE(ctx, desc->scene != NULL);
    TRL_REQUIRE(ctx, desc->paths >= 1 && desc->paths <= CHECK_MAX_PATHS);
    TRL_REQUIRE(ctx, desc->max_orders <= TRL_SKY_MAX_ORDERS);
    TRL_REQUIRE(ctx, desc->pixel_width >= 0 && desc->pixel_width <= MAX_PIXEL_WIDTH);
    return TRL_OK;
}

static trl_result check_picture(const trl_context *ctx, const trl_scene *scene,
                                const trl_view *view, uint32_t width, uint32_t height)
{
    const trl_result result = check_size(ctx, width, height);
    return result == TRL_OK ? check_view(ctx, view, scene) : result;
}

// What is asked for, and what it takes.
struct job {
    const trl_context *ctx;
    const trl_reference_desc *desc;
    const trl_view *view;
    uint32_t width, height;
    struct reference_sheets sheets;
    struct relief relief;
    struct cloud_field field; // zeroed without clouds
    struct camera camera;
    struct reference_occluder occluders[CAMERA_MAX_BODIES];
};

static trl_result place_camera(struct job *job)
{
    const trl_scene *scene = job->desc->scene;
    const trl_view *view = job->view;
    const struct camera_place place = {.radius_m = scene->medium.ground_radius_m,
                                       .ground_altitude_m = relief_altitude_m(
                                           &job->relief, view->latitude_rad, view->longitude_rad),
                                       .water_depth_m = relief_water_depth_m(
                                           &job->relief, view->latitude_rad, view->longitude_rad),
                                       .bodies = scene->bodies,
                                       .body_count = scene->body_count};
    const trl_result result = camera_check(job->ctx, view, &place);
    if (result != TRL_OK) {
        return result;
    }
    job->camera = camera_resolve(view, &place, (double)job->width / job->height);
    for (unsigned i = 0; i < job->camera.body_count; i++) {
        const struct camera_body *body = &job->camera.bodies[i];
        job->occluders[i] = (struct reference_occluder){body->position_m, body->radius_m};
    }
    return TRL_OK;
}

static trl_result trace(const struct job *job)
{
    const trl_reference_desc *desc = job->desc;
    struct reference_surface surface = relief_surface(&job->relief);
    if (!job->relief.is_bare) {
        surface.under = relief_under(&job->relief, &desc->scene->ocean, job->camera.position_m);
    }
    const struct reference_clouds clouds = cloud_field_traced(&job->field);
    const struct reference_scene scene = {.medium = &desc->scene->medium,
                                          .surface = job->relief.is_bare ? NULL : &surface,
                                          .clouds = job->field.desc.layer_count ? &clouds : NULL,
                                          .occluder_count = job->camera.body_count,
                                          .occluders = job->occluders};
    const struct reference_picture picture = {.camera = &job->camera,
                                              .width = job->width,
                                              .height = job->height,
                                              .paths = desc->paths,
                                              .seed = desc->seed,
                                              .max_order = (int)desc->max_orders,
                                              .pixel_width = desc->pixel_width};
    return reference_picture_trace(job->ctx, &scene, &picture, &job->sheets);
}

static trl_result make_clouds(struct job *job)
{
    const trl_scene *scene = job->desc->scene;
    if (scene->clouds.layer_count == 0) {
        return TRL_OK;
    }
    const trl_result result =
        cloud_field_init(job->ctx, &scene->clouds, scene->medium.ground_radius_m, &job->field);
    if (result == TRL_OK) {
        cloud_field_set_time(&job->field, job->view->time_s);
    }
    return result;
}

static trl_result render(struct job *job)
{
    trl_result result = relief_init(job->ctx, job->desc->scene, &job->relief);
    if (result == TRL_OK) {
        result = place_camera(job);
    }
    if (result == TRL_OK) {
        result = make_clouds(job);
    }
    if (result == TRL_OK) {
        result = trace(job);
    }
    cloud_field_finish(&job->field);
    relief_finish(&job->relief);
    return result;
}

trl_result trl_reference_render(trl_context *ctx, const trl_reference_desc *desc,
                                const trl_view *view, uint32_t width, uint32_t height, float *rgba,
                                float *error)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    trl_result result = check_desc(ctx, desc);
    if (result != TRL_OK) {
        return result;
    }
    TRL_REQUIRE(ctx, view != NULL);
    TRL_REQUIRE(ctx, rgba != NULL);
    result = check_picture(ctx, desc->scene, view, width, height);
    struct job job = {.ctx = ctx,
                      .desc = desc,
                      .view = view,
                      .width = width,
                      .height = height,
                      .sheets = {rgba, error}};
    return result == TRL_OK ? render(&job) : result;
}

trl_result trl_radiance_develop(trl_context *ctx, const trl_scene *scene, const trl_view *view,
                                uint32_t width, uint32_t height, const float *radiance,
                                uint8_t *rgba)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, view != NULL);
    TRL_REQUIRE(ctx, radiance != NULL && rgba != NULL);
    const trl_result result = check_picture(ctx, scene, view, width, height);
    if (result == TRL_OK) {
        const struct develop_source source = {.radiance = radiance,
                                              .width = width,
                                              .height = height,
                                              .wall_cd_m2 =
                                                  daylight_meter_wall_cd_m2(&scene->medium)};
        develop_picture(&source, view, rgba);
    }
    return result;
}
