// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/sky.h"

static const struct sky_model *find_model(trl_sky_model model)
{
    switch (model) {
    case TRL_SKY_SPECTRAL:
        return &sky_spectral;
    case TRL_SKY_SINGLE:
        return &sky_single;
    case TRL_SKY_RAYLEIGH:
        return &sky_rayleigh;
    case TRL_SKY_REFERENCE:
        return NULL; // paths are traced without OpenGL
    }
    return NULL;
}

trl_result sky_init(const struct sky_desc *desc, trl_sky_model model, struct sky *out)
{
    *out = (struct sky){.model = find_model(model)};
    if (!out->model) {
        return trl_fail(desc->gpu->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "pictures are not made by sky model %d", (int)model);
    }
    return out->model->create(desc, &out->self);
}

void sky_finish(struct sky *sky)
{
    if (sky->self) {
        sky->model->destroy(&sky->self);
    }
    *sky = (struct sky){0};
}

trl_result sky_prepare(struct sky *sky, const struct sky_view *view)
{
    return sky->model->prepare(sky->self, view);
}

trl_result sky_shade(struct sky *sky, const struct sky_view *view)
{
    return sky->model->shade ? sky->model->shade(sky->self, view) : TRL_OK;
}

trl_result sky_draw(struct sky *sky, const struct sky_view *view)
{
    return sky->model->draw(sky->self, view);
}

trl_result sky_change(struct sky *sky, const struct sky_desc *desc)
{
    if (sky->model->change) {
        return sky->model->change(sky->self, desc->medium);
    }
    void *made = NULL;
    const trl_result result = sky->model->create(desc, &made);
    if (result == TRL_OK) {
        sky->model->destroy(&sky->self);
        sky->self = made;
    }
    return result;
}

struct sky_moon sky_find_moon(const struct sky *sky, const struct camera *camera, double highest_m)
{
    return sky->model->find_moon ? sky->model->find_moon(sky->self, camera, highest_m)
                                 : (struct sky_moon){0};
}

bool sky_is_settled(const struct sky *sky)
{
    return !sky->self || !sky->model->is_settled || sky->model->is_settled(sky->self);
}

struct sky_air sky_get_air(const struct sky *sky, const struct sky_view *view)
{
    return sky->model->get_air ? sky->model->get_air(sky->self, view) : (struct sky_air){0};
}
