// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <terrella/water.h>

#include "api/check.h"
#include "api/water.h"
#include "api/wavelengths.h"
#include "ocean/volume_under.h"
#include "reference/water.h"
#include "scene/scene.h"

#include <math.h>
#include <time.h>

// Level lines of sight never leave a layer.
static const double LEAST_COSINE = 1e-6;

trl_water_desc trl_water_desc_default(void)
{
    return (trl_water_desc){.canary = WATER_CANARY, .paths = 100000};
}

trl_result water_check_query(const trl_context *ctx, const trl_water_query *q, size_t index)
{
    const char *wrong = NULL;
    const double view = cos(q->view_zenith_rad);
    if (!(q->depth_m >= 0)) {
        wrong = "the water's depth must be 0 or more";
    } else if (!(q->eye_depth_m >= 0 && q->eye_depth_m <= q->depth_m && isfinite(q->eye_depth_m))) {
        wrong = "the eye's depth must be from 0 to the water's";
    } else if (!(q->sun_zenith_rad >= 0 && cos(q->sun_zenith_rad) >= LEAST_COSINE)) {
        wrong = "sun zenith must be from 0 to below 90 degrees";
    } else if (!(q->view_zenith_rad >= 0 && q->view_zenith_rad <= M_PI * (1 + 1e-12))) {
        wrong = "view zenith must be from 0 to 180 degrees";
    } else if (!(fabs(view) >= LEAST_COSINE)) {
        wrong = "a view along the level has no answer";
    } else if (q->eye_depth_m <= 0 && view > 0) {
        wrong = "an eye above the water must look down: view zenith above 90 degrees";
    } else if (!isfinite(q->azimuth_rad)) {
        wrong = "azimuth must be a finite number";
    } else if (!(q->wavelength_nm >= 1 && q->wavelength_nm <= 1e7)) {
        wrong = "wavelength must be from 1 to 10000000 nm";
    }
    return wrong ? trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT, "query %zu: %s",
                            index + 1, wrong)
                 : TRL_OK;
}

static struct volume_view view_of(const trl_water_query *q)
{
    return (struct volume_view){.eye_depth_m = q->eye_depth_m,
                                .sun_mu = cos(q->sun_zenith_rad),
                                .view_mu = cos(q->view_zenith_rad),
                                .azimuth_rad = q->azimuth_rad};
}

static trl_result solve(const trl_context *ctx, const struct ocean_desc *ocean,
                        const trl_water_query *q, trl_water_light *out)
{
    const struct volume_column column = volume_column_make(ocean, q->depth_m, q->wavelength_nm);
    const struct volume_view view = view_of(q);
    struct volume_light light;
    const trl_result result = volume_radiance(ctx, &column, &view, &light);
    if (result == TRL_OK) {
        *out = (trl_water_light){.star_per_sr = light.star, .sky_per_sr = light.sky};
    }
    return result;
}

void water_trace(const struct ocean_desc *ocean, const trl_water_desc *desc,
                 const trl_water_query *q, trl_water_light *out)
{
    const struct volume_column column = volume_column_make(ocean, q->depth_m, q->wavelength_nm);
    const struct water_phase phase = water_phase_make(&column.optics);
    const struct reference_water water = {.absorption_per_m = column.optics.absorption_per_m,
                                          .clear_per_m = column.optics.clear_per_m,
                                          .particles_per_m = column.optics.particles_per_m,
                                          .particle_index = phase.index,
                                          .particle_slope = phase.slope,
                                          .index = column.index,
                                          .depth_m = q->depth_m,
                                          .bed_albedo = column.bed_albedo};
    const struct volume_view view = view_of(q);
    const struct reference_water_view same = {.eye_depth_m = view.eye_depth_m,
                                              .sun_mu = view.sun_mu,
                                              .view_mu = view.view_mu,
                                              .azimuth_rad = view.azimuth_rad};
    struct reference_water_light light;
    reference_water_radiance(&water, &same, desc->paths, desc->seed, &light);
    *out = (trl_water_light){.star_per_sr = light.star,
                             .sky_per_sr = light.sky,
                             .star_error = light.star_error,
                             .sky_error = light.sky_error};
}

// Queries that are lit solution by solution.
struct batch {
    const trl_water_query *queries;
    size_t count;
    trl_water_light *lights;
};

// Irradiance of level water at the solution's wavelengths, and what the water makes of it.
static trl_result light_batch(void *self, const struct solution *solution)
{
    const struct batch *batch = self;
    const struct optics *optics = solution->optics;
    for (size_t n = 0; n < batch->count; n++) {
        const trl_water_query *q = &batch->queries[n];
        for (int k = 0; k < optics->wavelength_count; k++) {
            if (optics->wavelength_nm[k] != q->wavelength_nm) {
                continue;
            }
            const double mu = cos(q->sun_zenith_rad);
            const double star = spectrum_at(&optics->medium->star_irradiance, q->wavelength_nm);
            lanes direct;
            sunlight_ground_at(&solution->sun, mu, &direct);
            const lanes diffuse = moments_irradiance(&solution->moments, mu);
            trl_water_light *l = &batch->lights[n];
            l->star_irradiance = star * (double)direct[k];
            l->sky_irradiance = star * (double)diffuse[k];
            l->radiance = l->star_per_sr * l->star_irradiance + l->sky_per_sr * l->sky_irradiance;
        }
    }
    return TRL_OK;
}

static trl_result light_up(const trl_context *ctx, const struct medium *medium,
                           const trl_water_query *queries, size_t count, trl_water_light *lights)
{
    struct batch batch = {queries, count, lights};
    const struct wavelengths_work work = {
        .use = OPTICS_NUMBERS, .answer = light_batch, .self = &batch};
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

trl_result water_check_ocean(const trl_context *ctx, const trl_scene *scene)
{
    return scene->ocean.is_there
               ? TRL_OK
               : trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT, "the scene has no ocean");
}

trl_result trl_water_radiance(trl_context *ctx, const trl_scene *scene, const trl_water_desc *desc,
                              const trl_water_query *queries, size_t count, trl_water_light *lights)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, count == 0 || (queries && lights));
    const trl_water_desc all = desc ? *desc : trl_water_desc_default();
    TRL_REQUIRE(ctx, all.canary == WATER_CANARY);
    TRL_REQUIRE(ctx, all.paths >= 2 && all.paths <= CHECK_MAX_PATHS);
    trl_result result = water_check_ocean(ctx, scene);
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        result = water_check_query(ctx, &queries[n], n);
    }
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        result = trl_progress(ctx, "light in the water", (double)n / (double)count);
        if (result == TRL_OK && all.uses_reference) {
            water_trace(&scene->ocean, &all, &queries[n], &lights[n]);
        } else if (result == TRL_OK) {
            result = solve(ctx, &scene->ocean, &queries[n], &lights[n]);
        }
    }
    return result == TRL_OK ? light_up(ctx, &scene->medium, queries, count, lights) : result;
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// One place between the table's entries, at three wavelengths.
static trl_result compare_at(const trl_context *ctx, const struct ocean_desc *ocean,
                             const struct volume_table *table, int place, double error[3])
{
    static const double depths_m[] = {1.3, 5, 10, 70}, suns[] = {0.95, 0.55, 0.17},
                        views[] = {-0.98, -0.61, -0.23};
    const double depth_m = depths_m[place % 4];
    const struct volume_view view = {.sun_mu = suns[place / 4 % 3],
                                     .view_mu = views[place / 12],
                                     .azimuth_rad = place % 2 ? 0.4 : 2.5};
    struct volume_light read[VOLUME_WAVELENGTHS];
    volume_table_at(table, depth_m, &view, read);
    trl_result result = TRL_OK;
    for (int k = 0; k < 3 && result == TRL_OK; k++) {
        const int lane = 2 + 5 * k;
        const struct volume_column column = volume_column_make(ocean, depth_m, table->nm[lane]);
        struct volume_light solved;
        result = volume_radiance(ctx, &column, &view, &solved);
        if (result == TRL_OK) {
            error[k] = fmax(fabs(read[lane].star / solved.star - 1),
                            fabs(read[lane].sky / solved.sky - 1));
        }
    }
    return result;
}

trl_result trl_water_table_measure(trl_context *ctx, const trl_scene *scene,
                                   trl_water_table_stats *out)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, scene != NULL && out != NULL);
    trl_result result = water_check_ocean(ctx, scene);
    double nm[VOLUME_WAVELENGTHS];
    for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
        nm[k] = 400 + 20 * k;
    }
    struct volume_table *table = NULL;
    const double start = seconds();
    if (result == TRL_OK) {
        result = volume_table_make(ctx, &scene->ocean, nm, VOLUME_WAVELENGTHS, &table);
    }
    enum { PLACES = 36 };
    *out = (trl_water_table_stats){.make_s = seconds() - start, .bytes = sizeof *table};
    for (int place = 0; place < PLACES && result == TRL_OK; place++) {
        double error[3];
        result = compare_at(ctx, &scene->ocean, table, place, error);
        for (int k = 0; k < 3 && result == TRL_OK; k++) {
            out->mean_error += error[k] / (3 * PLACES);
            out->largest_error = fmax(out->largest_error, error[k]);
        }
    }
    volume_table_destroy(ctx, &table);
    struct volume_under *under = NULL;
    const double under_start = seconds();
    if (result == TRL_OK) {
        result = volume_under_make(ctx, &scene->ocean, nm, VOLUME_WAVELENGTHS, 10, &under);
        out->under_make_s = seconds() - under_start;
        out->under_bytes = sizeof *under;
    }
    volume_under_destroy(ctx, &under);
    return result;
}
