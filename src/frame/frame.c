// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/frame.h"

#include "frame/daylight.h"
#include "frame/sea.h"
#include "scatter/medium_edit.h"

#include <inttypes.h>
#include <math.h>
#include <unistd.h>

// Seen along the horizon air is bright up to about three times the mean height of what scatters.
static const double GLOW_HEIGHTS = 3;

static trl_result open_gpu(const struct frame_desc *desc, struct gpu **gpu)
{
    return desc->gl == TRL_GL_CURRENT ? gpu_create_current(desc->ctx, gpu)
                                      : gpu_create_headless(desc->ctx, gpu);
}

static trl_result make_passes(struct frame *frame, const struct frame_desc *desc)
{
    const struct medium *medium = &frame->scene->medium;
    trl_result result = trl_progress(frame->ctx, "building programs", 0);
    if (result == TRL_OK) {
        result = edges_init(frame->gpu, &frame->edges);
    }
    if (result == TRL_OK) {
        result = exposure_init(frame->gpu, daylight_meter_wall_cd_m2(medium), &frame->exposure);
    }
    if (result == TRL_OK) {
        result = tone_init(frame->gpu, &frame->tone);
    }
    if (result == TRL_OK) {
        result = frame_clock_init(frame->gpu, desc->measures_time, &frame->clock);
    }
    return result == TRL_OK ? trl_progress(frame->ctx, "building programs", 1) : result;
}

static void describe_bodies(struct frame *frame)
{
    for (size_t i = 0; i < frame->scene->body_count; i++) {
        const struct scene_body *body = &frame->scene->bodies[i];
        frame->bodies[i] = (struct body_desc){&body->geometric_albedo, body->phase_law};
    }
}

static struct sky_desc describe_sky(const struct frame *frame)
{
    return (struct sky_desc){.gpu = frame->gpu,
                             .medium = &frame->medium,
                             .wavelengths = frame->wavelengths,
                             .orders = frame->orders,
                             .rayleigh = &frame->rayleigh,
                             .sea = &frame->sea.sea,
                             .body_count = frame->scene->body_count,
                             .bodies = frame->bodies};
}

trl_result frame_set_sky_model(struct frame *frame, trl_sky_model model)
{
    if ((unsigned)model >= SKY_MODELS) {
        return trl_fail(frame->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "pictures are not made by the sky model \"%s\"",
                        model == TRL_SKY_REFERENCE ? "reference" : "?");
    }
    const struct sky_desc desc = describe_sky(frame);
    struct sky *sky = &frame->skies[model];
    trl_result result = sky->self ? TRL_OK : sky_init(&desc, model, sky);
    if (result == TRL_OK) {
        result = clouds_make(&frame->clouds, sky);
    }
    frame->sky_model = result == TRL_OK ? model : frame->sky_model;
    return result;
}

static double find_glow_m(const struct medium *medium)
{
    return GLOW_HEIGHTS * medium_scattering_height(medium);
}

// The models that were made go over one by one; one that cannot keeps its tables.
trl_result frame_change_atmosphere(struct frame *frame, const struct medium *medium)
{
    struct medium changed;
    trl_result result = medium_copy(frame->ctx, medium, &changed);
    if (result != TRL_OK) {
        return result;
    }
    struct medium old = frame->medium;
    frame->medium = changed;
    frame->glow_m = find_glow_m(&changed);
    const struct sky_desc desc = describe_sky(frame);
    for (int m = 0; m < SKY_MODELS && result == TRL_OK; m++) {
        if (frame->skies[m].self) {
            result = sky_change(&frame->skies[m], &desc);
        }
    }
    space_change(&frame->space);
    under_forget(&frame->under);
    medium_finish(frame->ctx, &old);
    return result;
}

bool frame_is_settled(const struct frame *frame)
{
    return sky_is_settled(&frame->skies[frame->sky_model]) &&
           surface_is_settled(&frame->ground.surface);
}

// What is beyond the air. A catalogue that may be missing is left out when it is.
static trl_result make_space(struct frame *frame)
{
    const struct trl_scene *scene = frame->scene;
    const struct scene_stars *stars = &scene->stars;
    const bool is_left_out = stars->is_optional && stars->path && access(stars->path, F_OK) != 0;
    struct space_desc desc = {.gpu = frame->gpu,
                              .medium = &frame->medium,
                              .catalogue_path = is_left_out ? NULL : stars->path,
                              .limit_magnitude = stars->limit_magnitude,
                              .pole_right_ascension_rad = stars->pole_right_ascension_rad,
                              .pole_declination_rad = stars->pole_declination_rad,
                              .background_cd_m2 = stars->background_cd_m2,
                              .airglow_share = stars->airglow_share,
                              .body_count = scene->body_count,
                              .bodies = frame->bodies};
    daylight_ground_albedo(&scene->medium, desc.ground_albedo);
    if (is_left_out) {
        trl_log(frame->ctx, TRL_LOG_INFO, TRL_LOG_ITEM_SCENE, "no stars: there is no file %s",
                stars->path);
    }
    return space_init(&desc, &frame->space);
}

trl_result frame_init(const struct frame_desc *desc, struct frame *out)
{
    *out = (struct frame){.ctx = desc->ctx,
                          .scene = desc->scene,
                          .air = desc->air,
                          .wavelengths = desc->wavelengths,
                          .orders = desc->orders,
                          .rayleigh = desc->rayleigh};
    describe_bodies(out);
    trl_result result = frame_sea_init(desc->ctx, desc->scene, &out->sea);
    if (result == TRL_OK) {
        result = medium_copy(desc->ctx, &desc->scene->medium, &out->medium);
    }
    if (result == TRL_OK) {
        out->glow_m = find_glow_m(&out->medium);
        result = open_gpu(desc, &out->gpu);
    }
    if (result == TRL_OK) {
        const struct ground_desc ground = {desc->scene, desc->meshing, desc->waits_for_rasters};
        result = ground_init(out->gpu, &ground, &out->ground);
    }
    if (result == TRL_OK) {
        clouds_init(out->gpu, desc->scene, &out->clouds);
        under_init(out->gpu, desc->scene, &out->sea, &out->ground, &out->under);
        result = frame_set_sky_model(out, desc->sky_model);
    }
    if (result == TRL_OK) {
        result = make_space(out);
    }
    if (result == TRL_OK) {
        result = make_passes(out, desc);
    }
    if (result != TRL_OK) {
        frame_finish(out);
    }
    return result;
}

static void finish_targets(struct frame *frame)
{
    edges_forget(&frame->edges);
    gpu_target_finish(&frame->radiance_target);
    gpu_target_finish(&frame->picture_target);
    gpu_texture_finish(&frame->radiance);
    gpu_texture_finish(&frame->kinds);
    gpu_texture_finish(&frame->picture);
    frame->is_drawn = false;
}

void frame_finish(struct frame *frame)
{
    if (frame->gpu && gpu_make_current(frame->gpu) == TRL_OK) {
        finish_targets(frame);
        frame_clock_finish(&frame->clock);
        tone_finish(&frame->tone);
        exposure_finish(&frame->exposure);
        edges_finish(&frame->edges);
        for (int m = 0; m < SKY_MODELS; m++) {
            sky_finish(&frame->skies[m]);
        }
        space_finish(&frame->space);
        clouds_finish(&frame->clouds);
        under_finish(&frame->under);
        ground_finish(&frame->ground);
    }
    gpu_destroy(&frame->gpu);
    frame_sea_finish(&frame->sea);
    medium_finish(frame->ctx, &frame->medium);
    *frame = (struct frame){0};
}

static trl_result make_radiance(struct frame *frame, uint32_t width, uint32_t height)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "radiance";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = width;
    desc.height = height;
    trl_result result = gpu_texture_init(frame->gpu, &desc, &frame->radiance);
    if (result == TRL_OK) {
        desc.label = "kinds";
        desc.format = GPU_FORMAT_DEPTH32F;
        result = gpu_texture_init(frame->gpu, &desc, &frame->kinds);
    }
    const struct gpu_target_desc target = {.label = "radiance",
                                           .color_count = 1,
                                           .colors[0].texture = &frame->radiance,
                                           .depth.texture = &frame->kinds};
    if (result == TRL_OK) {
        result = gpu_target_init(frame->gpu, &target, &frame->radiance_target);
    }
    return result == TRL_OK ? edges_resize(&frame->edges, &frame->kinds) : result;
}

static trl_result make_picture(struct frame *frame, uint32_t width, uint32_t height)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "picture";
    desc.width = width;
    desc.height = height;
    const trl_result result = gpu_texture_init(frame->gpu, &desc, &frame->picture);
    const struct gpu_target_desc target = {
        .label = "picture", .color_count = 1, .colors[0].texture = &frame->picture};
    return result == TRL_OK ? gpu_target_init(frame->gpu, &target, &frame->picture_target) : result;
}

static trl_result fit_targets(struct frame *frame, uint32_t width, uint32_t height)
{
    const uint32_t most = frame->gpu->caps.max_texture_size;
    if (width > most || height > most) {
        return trl_fail(frame->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "a picture of %" PRIu32 " x %" PRIu32
                        " is larger than this GL can draw: at most %" PRIu32 " a side",
                        width, height, most);
    }
    if (frame->picture.width == width && frame->picture.height == height) {
        return TRL_OK;
    }
    finish_targets(frame);
    trl_result result = make_radiance(frame, width, height);
    if (result == TRL_OK) {
        result = make_picture(frame, width, height);
    }
    if (result == TRL_OK) {
        result = ground_resize(&frame->ground, width, height);
    }
    if (result != TRL_OK) {
        finish_targets(frame); // so that the next frame does not take half of them for whole
    }
    return result;
}

struct camera_place frame_place(const struct frame *frame, const trl_view *view)
{
    const double latitude_rad = view->latitude_rad, longitude_rad = view->longitude_rad;
    const bool rides = view->altitude_mode == TRL_ALTITUDE_WAVES;
    const bool dives = frame->skies[frame->sky_model].model->get_air;
    return (struct camera_place){
        .radius_m = frame->scene->medium.ground_radius_m,
        .ground_altitude_m = ground_altitude_m(&frame->ground, latitude_rad, longitude_rad),
        .water_depth_m =
            dives ? ground_water_depth_m(&frame->ground, latitude_rad, longitude_rad) : 0,
        .wave_m =
            rides ? ground_wave_m(&frame->ground, latitude_rad, longitude_rad, view->time_s) : 0,
        .bodies = frame->scene->bodies,
        .body_count = frame->scene->body_count};
}

// Of an eye under water: ground and clouds are not seen there.
static trl_result draw_under(struct frame *frame, const struct camera *camera,
                             const trl_view *shown, const struct under_eye *eye)
{
    struct sky *sky = &frame->skies[frame->sky_model];
    const struct sky_view view = {
        .camera = camera, .air = TRL_AIR_TABLE, .target = &frame->radiance_target};
    frame_clock_part(&frame->clock, "sky maps");
    trl_result result = sky_prepare(sky, &view);
    if (result == TRL_OK) {
        frame_clock_part(&frame->clock, "sky");
        result = under_draw(&frame->under, sky, &view, eye, shown->time_s);
    }
    return result;
}

// Before all that they may hide.
static trl_result draw_clouds(struct frame *frame, struct sky *sky, struct sky_view *view)
{
    trl_result result = TRL_OK;
    const bool is_cloudy = clouds_are_drawn(&frame->clouds, sky);
    if (is_cloudy) {
        frame_clock_part(&frame->clock, "clouds' deck");
        result = clouds_find_deck(&frame->clouds, sky, view);
    }
    if (result == TRL_OK) {
        frame_clock_part(&frame->clock, "shadows in the air");
        result = sky_shade(sky, view);
    }
    if (result == TRL_OK && is_cloudy) {
        frame_clock_part(&frame->clock, "clouds");
        result = clouds_draw(&frame->clouds, sky, view);
    }
    return result;
}

static trl_result draw_radiance(struct frame *frame, const struct camera *camera,
                                const trl_view *shown)
{
    struct sky *sky = &frame->skies[frame->sky_model];
    const double highest_m = ground_highest_m(&frame->ground);
    const struct sky_moon moon = sky_find_moon(sky, camera, highest_m);
    struct camera shading = *camera;
    if (moon.is_main) {
        shading.sun_direction = moon.sight.direction;
    }
    const struct ground_extras extras = {.has_sky_view = sky->model->reads_sky_view,
                                         .sea_albedo = frame->sea.albedo,
                                         .time_s = shown->time_s};
    trl_result result = frame_sea_light(&frame->sea);
    if (result == TRL_OK) {
        result = ground_draw_shape(&frame->ground, &shading, &extras, &frame->clock);
    }
    struct sky_view view = {.camera = camera,
                            .highest_m = highest_m,
                            .surface = ground_surface(&frame->ground),
                            .spheres = frame->spheres,

                            .shadow = ground_shadow(&frame->ground),
                            .moon = moon,
                            // Only the star's shadow is marched through the air.
                            .air = moon.is_main ? TRL_AIR_TABLE : frame->air,
                            .target = &frame->radiance_target};
    clouds_announce(&frame->clouds, sky, shown->time_s, &view);
    if (result == TRL_OK) {
        frame_clock_part(&frame->clock, "sky maps");
        result = sky_prepare(sky, &view);
    }
    if (result == TRL_OK) {
        result = draw_clouds(frame, sky, &view);
    }
    if (result == TRL_OK) {
        result = ground_draw_look(&frame->ground, &shading, &extras, view.hidden, &frame->clock);
    }
    if (result == TRL_OK && clouds_are_drawn(&frame->clouds, sky)) {
        frame_clock_part(&frame->clock, "clouds' shade");
        result = clouds_shade(&frame->clouds, sky, &view);
    }
    if (result == TRL_OK) {
        frame_clock_part(&frame->clock, "sky");
        result = sky_draw(sky, &view);
    }
    if (result == TRL_OK) {
        frame_clock_part(&frame->clock, "stars");
        result = space_draw(&frame->space, &view, shown->sidereal_rad);
    }
    if (result == TRL_OK && clouds_are_drawn(&frame->clouds, sky)) {
        frame_clock_part(&frame->clock, "clouds joined");
        result = clouds_join(&frame->clouds, sky, &view);
    }
    if (result == TRL_OK) {
        const struct edges_source source = {.view = &view,
                                            .radiance = &frame->radiance,
                                            .ground_radius_m = frame->medium.ground_radius_m,
                                            .top_radius_m = frame->medium.top_radius_m,
                                            .glow_m = frame->glow_m};
        frame_clock_part(&frame->clock, "edges");
        result = edges_draw(&frame->edges, &source);
    }
    return result;
}

static trl_result develop(struct frame *frame, const struct frame_request *request)
{
    const trl_view *view = request->view;
    const struct exposure_request exposure = {.is_fixed = view->has_fixed_exposure,
                                              .ev100 = view->exposure_ev100,
                                              .bias_ev = view->exposure_bias_ev,
                                              .elapsed_s = request->elapsed_s};
    frame_clock_part(&frame->clock, "exposure");
    trl_result result = exposure_update(&frame->exposure, &exposure, &frame->radiance);
    if (result == TRL_OK) {
        frame_clock_part(&frame->clock, "tone");
        const struct tone_source source = {&frame->radiance, exposure_value(&frame->exposure),
                                           view->tone_curve};
        result = tone_draw(&frame->tone, &source, &frame->picture_target);
    }
    return result;
}

trl_result frame_draw(struct frame *frame, const struct frame_request *request)
{
    const trl_view *view = request->view;
    struct camera_place place = frame_place(frame, view);
    trl_result result = camera_check(frame->ctx, view, &place);
    if (result == TRL_OK) {
        result = gpu_make_current(frame->gpu);
    }
    if (result == TRL_OK) {
        result = fit_targets(frame, request->width, request->height);
    }
    if (result != TRL_OK) {
        return result;
    }
    const double aspect = (double)request->width / request->height;
    struct camera camera = camera_resolve(view, &place, aspect);
    frame->is_drawn = false;
    frame_clock_start(&frame->clock);
    struct under_eye eye;
    const bool is_under =
        under_find(&frame->under, &frame->skies[frame->sky_model], &camera, view->time_s, &eye);
    if (!is_under) {
        place.water_depth_m = 0; // in a trough: what is drawn from the air is seen from above it
        camera = camera_resolve(view, &place, aspect);
    }
    result =
        is_under ? draw_under(frame, &camera, view, &eye) : draw_radiance(frame, &camera, view);
    if (result == TRL_OK) {
        result = develop(frame, request);
    }
    frame_clock_stop(&frame->clock);
    frame->is_drawn = result == TRL_OK;
    return result;
}
