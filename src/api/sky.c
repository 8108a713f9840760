// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <terrella/atmosphere.h>

#include "api/check.h"
#include "api/rayleigh.h"
#include "reference/path_tracer.h"
#include "scatter/query.h"
#include "scene/scene.h"

#include <math.h>
#include <stdlib.h>

enum { SKY_CANARY = 0x54534b31 };
static const uint64_t MAX_PATHS = 1000000000000;

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

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

// The different wavelengths of the queries, ascending; returns how many.
static size_t list_wavelengths(const trl_sky_query *queries, size_t count, double *nm)
{
    for (size_t n = 0; n < count; n++) {
        nm[n] = queries[n].wavelength_nm;
    }
    qsort(nm, count, sizeof *nm, compare_doubles);
    size_t kept = 0;
    for (size_t n = 0; n < count; n++) {
        if (kept == 0 || nm[n] != nm[kept - 1]) {
            nm[kept++] = nm[n];
        }
    }
    return kept;
}

// Answers the queries at the solution's wavelengths.
static trl_result answer_batch(const trl_context *ctx, const struct solution *solution,
                               const trl_sky_desc *desc, const trl_sky_query *queries, size_t count,
                               double *radiance)
{
    const struct optics *optics = solution->optics;
    struct query *query = NULL;
    const trl_result result = query_create(ctx, solution, &query);
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        const trl_sky_query *q = &queries[n];
        for (int k = 0; k < optics->wavelength_count; k++) {
            if (optics->wavelength_nm[k] != q->wavelength_nm) {
                continue;
            }
            const struct query_view view =
                query_view_make(optics->ground_radius_m + q->altitude_m, q->sun_zenith_rad,
                                q->view_zenith_rad, q->azimuth_rad);
            lanes all;
            if (desc->model == TRL_SKY_SINGLE) {
                query_plane_radiance(query, &view, &all);
            } else {
                query_radiance(query, &view, &all);
            }
            radiance[n] =
                (double)all[k] * spectrum_at(&optics->medium->star_irradiance, q->wavelength_nm);
        }
    }
    query_destroy(ctx, &query);
    return result;
}

static trl_result solve_and_answer(const trl_context *ctx, const struct medium *medium,
                                   const trl_sky_desc *desc, const trl_sky_query *queries,
                                   size_t count, double *radiance)
{
    double *nm = mem_alloc(ctx, count, sizeof *nm);
    struct optics *optics = mem_alloc(ctx, 1, sizeof *optics);
    trl_result result = nm && optics ? TRL_OK : TRL_ERROR_MEMORY;
    const size_t different = result == TRL_OK ? list_wavelengths(queries, count, nm) : 0;
    for (size_t first = 0; first < different && result == TRL_OK; first += LANES) {
        const size_t left = different - first;
        for (size_t k = first; k < different && k < first + LANES && result == TRL_OK; k++) {
            result = medium_check(ctx, medium, nm[k]);
        }
        if (result != TRL_OK) {
            break;
        }
        optics_init_for(desc->max_orders > 0 ? OPTICS_WHOLE : OPTICS_NUMBERS, medium, nm + first,
                        left < LANES ? (int)left : LANES, optics);
        struct solver_settings settings = solver_settings_choose(optics, SOLVER_PRECISE);
        settings.orders = desc->model == TRL_SKY_SINGLE ? 1 : (int)desc->max_orders;
        struct solution solution;
        result = solution_init(ctx, optics, &settings, &solution);
        if (result == TRL_OK) {
            result = answer_batch(ctx, &solution, desc, queries, count, radiance);
            solution_finish(ctx, &solution);
        }
    }
    mem_free(ctx, nm);
    mem_free(ctx, optics);
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
    TRL_REQUIRE(ctx, desc->paths >= 2 && desc->paths <= MAX_PATHS);
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
