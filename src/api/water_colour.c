// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <terrella/water.h>

#include "api/check.h"
#include "api/water.h"
#include "frame/daylight.h"
#include "frame/sea.h"
#include "frame/under_light.h"
#include "ocean/volume.h"
#include "shared/fresnel.glsl"
#include "shared/sea.glsl"
#include "sky/sea_volume.h"

#include <math.h>

// All that is seen, more finely than tables have it.
enum { WAVELENGTHS = 41 };
_Static_assert((int)WAVELENGTHS <= (int)DAYLIGHT_MAX_WEIGHTS, "weights for each");
static const double FIRST_NM = 360, STEP_NM = 10;

static trl_result trace(const trl_context *ctx, const trl_scene *scene, const trl_water_desc *desc,
                        const trl_water_query *query, trl_water_colour *out)
{
    double nm[WAVELENGTHS], weights[3][DAYLIGHT_MAX_WEIGHTS];
    for (int k = 0; k < WAVELENGTHS; k++) {
        nm[k] = FIRST_NM + STEP_NM * k;
    }
    daylight_weights(&scene->medium, nm, WAVELENGTHS, weights);
    *out = (trl_water_colour){0};
    for (int k = 0; k < WAVELENGTHS; k++) {
        trl_water_query at = *query;
        at.wavelength_nm = nm[k];
        trl_water_desc own = *desc; // with paths of its own: noise of one is none of the others
        own.seed = desc->seed * WAVELENGTHS + (uint64_t)k;
        trl_water_light light;
        water_trace(&scene->ocean, &own, &at, &light);
        for (int c = 0; c < 3; c++) {
            out->star_rgb[c] += M_PI * weights[c][k] * light.star_per_sr;
            out->sky_rgb[c] += M_PI * weights[c][k] * light.sky_per_sr;
        }
        const trl_result result = trl_progress(ctx, "light in the water", (k + 1.0) / WAVELENGTHS);
        if (result != TRL_OK) {
            return result;
        }
    }
    return TRL_OK;
}

static trl_result look_up(struct frame_sea *sea, const trl_water_query *query,
                          trl_water_colour *out)
{
    const trl_result result = frame_sea_light(sea);
    if (result != TRL_OK) {
        return result;
    }
    const struct sea_volume_rays rays = {.sun_mu = cos(query->sun_zenith_rad),
                                         .view_mu = -cos(query->view_zenith_rad),
                                         .azimuth_cosine = cos(query->azimuth_rad)};
    struct sea_volume_light light;
    double star[3], sky[3];
    sea_volume_at(sea->volume, sea_depth_code(query->depth_m), &rays, &light);
    sea_volume_rgb(sea->volume, light.star, star);
    sea_volume_rgb(sea->volume, light.sky, sky);
    const double leaves = 1 - fresnel_reflectance(rays.view_mu, sea->sea.index);
    const double enters = 1 - fresnel_reflectance(rays.sun_mu, sea->sea.index);
    for (int c = 0; c < 3; c++) {
        out->star_rgb[c] = leaves * enters * star[c];
        out->sky_rgb[c] = leaves * sky[c];
    }
    return TRL_OK;
}

// Between the columns that pictures mix.
static trl_result look_up_under(const struct frame_sea *sea, struct under_columns *columns,
                                const trl_water_query *query, trl_water_colour *out)
{
    const trl_result result = under_columns_find(columns, query->depth_m);
    double star[VOLUME_WAVELENGTHS] = {0}, sky[VOLUME_WAVELENGTHS] = {0};
    const struct volume_view view = {.eye_depth_m = query->eye_depth_m,
                                     .sun_mu = cos(query->sun_zenith_rad),
                                     .view_mu = cos(query->view_zenith_rad),
                                     .azimuth_rad = query->azimuth_rad};
    for (int k = 0; k < VOLUME_WAVELENGTHS && result == TRL_OK; k++) {
        const struct volume_light light = under_columns_at(columns, k, query->depth_m, &view);
        star[k] = M_PI * light.star;
        sky[k] = M_PI * light.sky;
    }
    sea_volume_rgb(sea->volume, star, out->star_rgb);
    sea_volume_rgb(sea->volume, sky, out->sky_rgb);
    return result;
}

static trl_result find(const trl_context *ctx, const trl_scene *scene, const trl_water_desc *desc,
                       const trl_water_query *queries, size_t count, trl_water_colour *colours)
{
    struct frame_sea sea = {.ctx = ctx};
    struct under_columns columns = {.ctx = ctx, .ocean = &scene->ocean};
    trl_result result = desc->uses_reference ? TRL_OK : frame_sea_init(ctx, scene, &sea);
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        if (desc->uses_reference) {
            result = trace(ctx, scene, desc, &queries[n], &colours[n]);
        } else if (queries[n].eye_depth_m > 0) {
            result = look_up_under(&sea, &columns, &queries[n], &colours[n]);
        } else {
            result = look_up(&sea, &queries[n], &colours[n]);
        }
    }
    under_columns_finish(&columns);
    frame_sea_finish(&sea);
    return result;
}

trl_result trl_water_colours(trl_context *ctx, const trl_scene *scene, const trl_water_desc *desc,
                             const trl_water_query *queries, size_t count,
                             trl_water_colour *colours)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, count == 0 || (queries && colours));
    const trl_water_desc all = desc ? *desc : trl_water_desc_default();
    TRL_REQUIRE(ctx, all.canary == WATER_CANARY);
    TRL_REQUIRE(ctx, all.paths >= 2 && all.paths <= CHECK_MAX_PATHS);
    trl_result result = water_check_ocean(ctx, scene);
    for (size_t n = 0; n < count && result == TRL_OK; n++) {
        trl_water_query query = queries[n];
        query.wavelength_nm = FIRST_NM;
        result = water_check_query(ctx, &query, n);
    }
    return result == TRL_OK ? find(ctx, scene, &all, queries, count, colours) : result;
}
