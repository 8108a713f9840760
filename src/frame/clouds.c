// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/clouds.h"

void clouds_init(struct gpu *gpu, const struct trl_scene *scene, struct clouds *out)
{
    *out = (struct clouds){.ctx = gpu->ctx, .gpu = gpu, .scene = scene};
}

static trl_result make_field(const struct clouds *clouds, struct cloud_field **out)
{
    struct cloud_field *field = mem_alloc(clouds->ctx, 1, sizeof *field);
    const trl_result result = field ? cloud_field_init(clouds->ctx, &clouds->scene->clouds,
                                                       clouds->scene->medium.ground_radius_m, field)
                                    : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        mem_free(clouds->ctx, field);
        field = NULL;
    }
    *out = field;
    return result;
}

static void finish_field(struct clouds *clouds)
{
    if (clouds->field) {
        cloud_march_finish(&clouds->march);
        cloud_field_finish(clouds->field);
        mem_free(clouds->ctx, clouds->field);
        clouds->field = NULL;
    }
}

trl_result clouds_make(struct clouds *clouds, const struct sky *sky)
{
    if (clouds->field || clouds->scene->clouds.layer_count == 0 || !sky->model->get_air) {
        return TRL_OK;
    }
    trl_result result = make_field(clouds, &clouds->field);
    if (result == TRL_OK) {
        result = cloud_march_init(clouds->gpu, clouds->field, &clouds->march);
    }
    if (result != TRL_OK) {
        finish_field(clouds);
    }
    return result;
}

void clouds_finish(struct clouds *clouds)
{
    finish_field(clouds);
    *clouds = (struct clouds){0};
}

bool clouds_are_drawn(const struct clouds *clouds, const struct sky *sky)
{
    return clouds->field && sky->model->get_air;
}

void clouds_announce(struct clouds *clouds, const struct sky *sky, double time_s,
                     struct sky_view *view)
{
    clouds->time_s = time_s;
    if (clouds_are_drawn(clouds, sky)) {
        cloud_field_set_time(clouds->field, time_s);
        view->cloud_shade = &clouds->march.shade.left;
        view->cloud_deck = &clouds->march.deck.map;
        view->cloud_deck_place = clouds->march.deck.place;
        view->cloud_top_m = cloud_field_highest_m(clouds->field);
    } else if (clouds->scene->clouds.layer_count > 0 && !clouds->is_told) {
        clouds->is_told = true;
        trl_log(clouds->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_SCENE,
                "this model of the sky draws no clouds; spectral does");
    }
}

// What the march asks for, answered by the sky.
struct air_source {
    struct sky_air air;
    const struct sky_view *view;
};

static void bind_air(const void *self, bool whole, struct gpu_program *program)
{
    const struct air_source *source = self;
    source->air.bind(source->air.self, source->view, whole, program);
}

static void bind_moon(const void *self, struct gpu_program *program)
{
    const struct air_source *source = self;
    source->air.bind_moon(source->air.self, source->view, program);
}

static trl_result draw(struct clouds *clouds, const struct sky *sky, const struct sky_view *view,
                       trl_result (*part)(struct cloud_march *, const struct cloud_view *))
{
    const struct air_source source = {sky_get_air(sky, view), view};
    const struct cloud_air air = {.peaked_count = source.air.peaked_count,
                                  .has_march = source.air.has_march,
                                  .has_eclipse = source.air.has_eclipse,
                                  .bind = bind_air,
                                  .bind_moon = source.air.bind_moon ? bind_moon : NULL,
                                  .self = &source};
    const struct cloud_view cloud_view = {.camera = view->camera,
                                          .position = view->surface.position,
                                          .target = view->target,
                                          .air = &air,
                                          .time_s = clouds->time_s,
                                          .is_moonlit = view->moon.is_main,
                                          .accumulates = clouds->accumulates};
    return part(&clouds->march, &cloud_view);
}

trl_result clouds_find_deck(struct clouds *clouds, const struct sky *sky,
                            const struct sky_view *view)
{
    return draw(clouds, sky, view, cloud_march_deck);
}

trl_result clouds_draw(struct clouds *clouds, const struct sky *sky, struct sky_view *view)
{
    view->hidden = &clouds->march.hidden;
    return draw(clouds, sky, view, cloud_march_draw);
}

trl_result clouds_shade(struct clouds *clouds, const struct sky *sky, const struct sky_view *view)
{
    return draw(clouds, sky, view, cloud_march_shade);
}

trl_result clouds_join(struct clouds *clouds, const struct sky *sky, const struct sky_view *view)
{
    return draw(clouds, sky, view, cloud_march_join);
}
