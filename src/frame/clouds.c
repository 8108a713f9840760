// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/clouds.h"

trl_result clouds_init(struct gpu *gpu, const struct trl_scene *scene, struct clouds *out)
{
    *out = (struct clouds){.ctx = gpu->ctx};
    if (scene->clouds.layer_count == 0) {
        return TRL_OK;
    }
    struct cloud_field *field = mem_alloc(gpu->ctx, 1, sizeof *field);
    if (!field) {
        return TRL_ERROR_MEMORY;
    }
    out->field = field;
    trl_result result =
        cloud_field_init(gpu->ctx, &scene->clouds, scene->medium.ground_radius_m, field);
    if (result == TRL_OK) {
        result = cloud_march_init(gpu, field, &out->march);
    }
    if (result != TRL_OK) {
        clouds_finish(out);
    }
    return result;
}

void clouds_finish(struct clouds *clouds)
{
    if (clouds->field) {
        cloud_march_finish(&clouds->march);
        cloud_field_finish(clouds->field);
        mem_free(clouds->ctx, clouds->field);
    }
    *clouds = (struct clouds){0};
}

bool clouds_are_drawn(const struct clouds *clouds, const struct sky *sky)
{
    return clouds->field && sky->model->get_air;
}

void clouds_announce(struct clouds *clouds, const struct sky *sky, struct sky_view *view)
{
    if (clouds_are_drawn(clouds, sky)) {
        view->cloud_shade = &clouds->march.shades;
        view->cloud_top_m = cloud_field_highest_m(clouds->field);
    } else if (clouds->field && !clouds->is_told) {
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

static trl_result draw(struct clouds *clouds, const struct sky *sky, const struct sky_view *view,
                       trl_result (*part)(struct cloud_march *, const struct cloud_view *))
{
    const struct air_source source = {sky_get_air(sky, view), view};
    const struct cloud_air air = {source.air.peaked_count, source.air.has_march, bind_air, &source};
    const struct cloud_view cloud_view = {view->camera, view->surface.position, view->target, &air};
    return part(&clouds->march, &cloud_view);
}

trl_result clouds_shade(struct clouds *clouds, const struct sky *sky, const struct sky_view *view)
{
    return draw(clouds, sky, view, cloud_march_shade);
}

trl_result clouds_draw(struct clouds *clouds, const struct sky *sky, const struct sky_view *view)
{
    return draw(clouds, sky, view, cloud_march_draw);
}
