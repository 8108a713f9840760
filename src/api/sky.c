// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <terrella/atmosphere.h>

#include "api/check.h"
#include "api/rayleigh.h"
#include "api/wavelengths.h"
#include "reference/path_tracer.h"
#include "scatter/query.h"
#include "scene/scene.h"

#include <math.h>

enum { SKY_CANARY = 0x54534b31 };

trl_sky_desc trl_sky_desc_default(void)
{
    return (trl_sky_desc){.canary = SKY_CANARY, .model = TRL_SKY_SPECTRAL, .paths = 10000};
}

static trl_result check_query(const trl_context *ctx, const struct medium *medium,
                              const trl_sky_query *q, size_t index)
{
    const char *wrong = NULL;
    if (!(q->altitude_m >= 0 && q->altitude_m <= 1e3 * medium->top_radius_m)) {
        wrong = "altitude must be from 0 to a thousand radii";
    } else if (!(q->sun_zenith_rad >= 0 && q->sun_zenith_rad <= M_PI * (1 + 1e-12))) {
        wrong = "sun zenith must be from 0 to 180 degrees";
    } else if (!(q->view_zenith_rad >= 0 && q->view_zenith_rad <= M_PI * (1 + 1e-12))) {
        wrong = "view zenith must be from 0 to 180 degrees";
    } else if (!isfinite(q->azimuth_rad)) {
        wrong = "azimuth must be a finite number";
    } else if (!(q->wavelength_nm >= 1 && q->wavelength_nm <= 1e7)) {
        wrong = "wavelength must be from 1 to 10000000 nm";
    }
    return wrong ? trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT, "query %zu: %s",
                            index + 1, wrong)
                 : TRL_OK;
}

// Queries that are answered solution by solution.
struct batch {
    const trl_context *ctx;
    const trl_sky_desc *desc;
    const trl_sky_query *queries;
    size_t count;
    double *radiance;
};

// Answers the queries at the solution's wavelengths.
static trl_result answer_batch(void *self, const struct solution *solution)
{
    const struct batch *batch = self;
    const struct optics *optics = solution->optics;
    struct query *query = NULL;
    const trl_result result = query_create(batch->ctx, solution, &query);
    for (size_t n = 0; n < batch->count && result == TRL_OK; n++) {
        const trl_sky_query *q = &batch->queries[n];
        for (int k = 0; k < optics->wavelength_count; k++) {
            if (optics->wavelength_nm[k] != q->wavelength_nm) {
                continue;
            }
            const struct query_view view =
                query_view_make(optics->ground_radius_m + q->altitude_m, q->sun_zenith_rad,
                                q->view_zenith_rad, q->azimuth_rad);
            lanes all;
            if (batch->desc->model == TRL_SKY_SINGLE) {
                query_plane_radiance(query, &view, &all);
            } else {
                query_radiance(query, &view, &all);
            }
            batch->radiance[n] =
                (double)all[k] * spectrum_at(&optics->medium->star_irradiance, q->wavelength_nm);
        }
    }
    query_destroy(batch->ctx, &query);
    return result;
}

static trl_result solve_and_answer(const trl_context *ctx, const struct medium *medium,
                                   const trl_sky_desc *desc, const trl_sky_query *queries,
                                   size_t count, double *radiance)
{
    struct batch batch = {ctx, desc, queries, count, radiance};
    const struct wavelengths_work work = {
        .use = desc->max_orders > 0 ? OPTICS_WHOLE : OPTICS_NUMBERS,
        .orders = desc->model == TRL_SKY_SINGLE ? 1 : desc->max_orders,
        .answer = answer_batch,
        .self = &batch};
    double *nm = mem_alloc(ctx, count, sizeof *nm);
    for (size_t n = 0; nm && n < count; n++) {
        nm[n] = queries[n].wavelength_nm;
    }
    const trl_result result =
        nm ? wavelengths_solve(ctx, medium, nm, wavelengths_sort(nm, count), &work)
           : TRL_ERROR_MEMORY;
    mem_free(ctx, nm);
    return result;
}

static trl_result trace(const trl_context *ctx, const struct medium *medium,
                        const trl_sky_desc *desc, const trl_sky_query *queries, size_t count,
                        double *radiance, double *standard_error)
{
    const struct reference_desc reference = {
        .paths = desc->paths, .seed = desc->seed, .max_order = (int)desc->max_orders};
    double *error = standard_error ? standard_error : mem_alloc(ctx, count, sizeof *error);
    trl_result result = error || count == 0 ? TRL_OK : TRL_ERROR_MEMORY;
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        result = medium_check(ctx, medium, queries[n].wavelength_nm);
    }
    if (result == TRL_OK) {
        result = reference_sky_radiance(ctx, medium, queries, count, &reference, radiance, error);
    }
    if (error != standard_error) {
        mem_free(ctx, error);
    }
    return result;
}

static trl_result answer(const trl_context *ctx, const struct trl_scene *scene,
                         const trl_sky_desc *desc, const trl_sky_query *queries, size_t count,
                         double *radiance, double *standard_error)
{
    const struct medium *medium = &scene->medium;
    for (size_t n = 0; standard_error && n < count; n++) {
        standard_error[n] = 0;
    }
    switch (desc->model) {
    case TRL_SKY_SPECTRAL:
    case TRL_SKY_SINGLE:
        return solve_and_answer(ctx, medium, desc, queries, count, radiance);
    case TRL_SKY_RAYLEIGH:
        return rayleigh_sky_radiance(ctx, medium,
                                     desc->rayleigh ? desc->rayleigh : &scene->rayleigh, queries,
                                     count, radiance);
    case TRL_SKY_REFERENCE:
        return trace(ctx, medium, desc, queries, count, radiance, standard_error);
    }
    return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                    "trl_sky_desc.model %d is none of trl_sky_model", (int)desc->model);
}

static trl_result check_desc(const trl_context *ctx, const trl_sky_desc *desc)
{
    TRL_REQUIRE(ctx, desc->canary == SKY_CANARY);
    TRL_REQUIRE(ctx, desc->max_orders <= TRL_SKY_MAX_ORDERS);
    const bool has_one_order = desc->model == TRL_SKY_SINGLE || desc->model == TRL_SKY_RAYLEIGH;
    if (has_one_order && desc->max_orders > 1) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "the model \"%s\" has one order of scattering, not %u",
                        trl_sky_model_name(desc->model), desc->max_orders);
    }
    TRL_REQUIRE(ctx, desc->paths >= 2 && desc->paths <= CHECK_MAX_PATHS);
    return desc->rayleigh ? check_rayleigh(ctx, desc->rayleigh) : TRL_OK;
}

trl_result trl_sky_radiance(trl_context *ctx, const trl_scene *scene, const trl_sky_desc *desc,
                            const trl_sky_query *queries, size_t count, double *radiance,
                            double *standard_error)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, count == 0 || (queries && radiance));
    const trl_sky_desc all = desc ? *desc : trl_sky_desc_default();
    trl_result result = check_desc(ctx, &all);
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        result = check_query(ctx, &scene->medium, &queries[n], n);
    }
    if (result == TRL_OK) {
        result = answer(ctx, scene, &all, queries, count, radiance, standard_error);
    }
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        if (!isfinite(radiance[n])) {
            result =
                trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SOLVER,
                         "query %zu has no finite answer: check the scene's coefficients", n + 1);
        }
    }
    return result;
}
