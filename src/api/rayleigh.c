// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "api/rayleigh.h"

#include "api/check.h"
#include "scatter/rayleigh.h"
#include "scene/scene.h"

trl_result check_rayleigh(const trl_context *ctx, const trl_rayleigh_desc *desc)
{
    TRL_REQUIRE(ctx, desc->canary == trl_rayleigh_desc_default().canary);
    const char *wrong = rayleigh_desc_wrong(desc);
    return wrong ? trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                            "trl_rayleigh_desc.%s is out of range", wrong)
                 : TRL_OK;
}

trl_result rayleigh_sky_radiance(const trl_context *ctx, const struct medium *medium,
                                 const trl_rayleigh_desc *desc, const trl_sky_query *queries,
                                 size_t count, double *radiance)
{
    struct rayleigh *model = mem_alloc(ctx, 1, sizeof *model);
    if (!model) {
        return TRL_ERROR_MEMORY;
    }
    rayleigh_init(model, medium, desc);
    trl_result result = TRL_OK;
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        const trl_sky_query *q = &queries[n];
        result = medium_check(ctx, medium, q->wavelength_nm);
        const struct query_view view =
            query_view_make(medium->ground_radius_m + q->altitude_m, q->sun_zenith_rad,
                            q->view_zenith_rad, q->azimuth_rad);
        radiance[n] = rayleigh_radiance(model, &view, q->wavelength_nm) *
                      spectrum_at(&medium->star_irradiance, q->wavelength_nm);
    }
    mem_free(ctx, model);
    return result;
}

trl_result trl_rayleigh_errors_read(trl_context *ctx, const trl_scene *scene,
                                    const trl_rayleigh_desc *desc, trl_rayleigh_errors *out)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, out != NULL);
    const trl_rayleigh_desc all = desc ? *desc : scene->rayleigh;
    const trl_result checked = check_rayleigh(ctx, &all);
    if (checked != TRL_OK) {
        return checked;
    }
    struct rayleigh *model = mem_alloc(ctx, 1, sizeof *model);
    if (!model) {
        return TRL_ERROR_MEMORY;
    }
    rayleigh_init(model, &scene->medium, &all);
    const struct rayleigh_errors errors = rayleigh_depth_errors(&model->depth);
    *out = (trl_rayleigh_errors){errors.mean, errors.largest};
    mem_free(ctx, model);
    return TRL_OK;
}
