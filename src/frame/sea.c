// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/sea.h"

#include "frame/daylight.h"
#include "ocean/sea.h"
#include "ocean/volume.h"
#include "ocean/water.h"
#include "shared/sea.glsl"

#include <math.h>

_Static_assert((int)SKY_SEA_ANGLES == (int)VOLUME_ANGLES, "angles are the table's");
_Static_assert((int)SKY_SEA_ORDERS == (int)VOLUME_ORDERS, "orders are the table's");
_Static_assert((int)SKY_SEA_WAVELENGTHS == (int)VOLUME_WAVELENGTHS, "wavelengths are the table's");

// Of the table's wavelengths, and where the eye sees most.
static const double MIDDLE_NM = 560;

// Where the water's spectra are known.
static const double FIRST_NM = 400, STEP_NM = 20;

static void store(const struct volume_table *table, const double spectrum[VOLUME_WAVELENGTHS],
                  float *out)
{
    for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
        const double index = table->column[k].index;
        out[k] = (float)(spectrum[k] * M_PI / (index * index));
    }
}

static void fill_depth(const struct volume_table *table, int depth, struct sky_sea_volume *out)
{
    // The code 0 stands for all that is deeper.
    const double depth_m = depth > 0 ? sea_code_depth((double)depth / (SKY_SEA_DEPTHS - 1)) : 1e6;
    for (int pair = 0; pair < SKY_SEA_ANGLES * SKY_SEA_ANGLES; pair++) {
        const int view = pair / SKY_SEA_ANGLES, sun = pair % SKY_SEA_ANGLES;
        struct volume_entry entry;
        volume_table_entry(table, depth_m, sun, view, &entry);
        for (int m = 0; m < SKY_SEA_ORDERS; m++) {
            store(table, entry.star[m], out->spectrum[view][m * SKY_SEA_ANGLES + sun][depth]);
        }
        store(table, entry.sky, out->spectrum[view][SKY_SEA_ROWS - 1][depth]);
    }
}

// Without spectra.
static trl_result describe(const trl_context *ctx, const struct medium *medium,
                           struct sky_sea_volume **out)
{
    struct sky_sea_volume *volume = mem_alloc(ctx, 1, sizeof *volume);
    *out = volume;
    if (!volume) {
        return TRL_ERROR_MEMORY;
    }
    double weights[3][DAYLIGHT_MAX_WEIGHTS];
    for (int k = 0; k < SKY_SEA_WAVELENGTHS; k++) {
        volume->nm[k] = FIRST_NM + STEP_NM * k;
    }
    daylight_weights(medium, volume->nm, SKY_SEA_WAVELENGTHS, weights);
    for (int i = 0; i < 3 * SKY_SEA_WAVELENGTHS; i++) {
        volume->rgb_from_spectrum[i % 3][i / 3] = weights[i % 3][i / 3];
    }
    return TRL_OK;
}

static trl_result light_up(const trl_context *ctx, const struct ocean_desc *ocean,
                           struct sky_sea_volume *volume)
{
    struct volume_table *table = NULL;
    const trl_result result = volume_table_get(ctx, ocean, volume->nm, VOLUME_WAVELENGTHS, &table);
    if (result == TRL_OK) {
        volume->critical = table->critical;
#pragma omp parallel for schedule(dynamic)
        for (int i = 0; i < SKY_SEA_DEPTHS; i++) {
            fill_depth(table, i, volume);
        }
    }
    volume_table_destroy(ctx, &table);
    return result;
}

trl_result frame_sea_make_volume(const trl_context *ctx, const struct ocean_desc *ocean,
                                 const struct medium *medium, struct sky_sea_volume **out)
{
    trl_result result = describe(ctx, medium, out);
    if (result == TRL_OK) {
        result = light_up(ctx, ocean, *out);
    }
    if (result != TRL_OK) {
        mem_free(ctx, *out);
        *out = NULL;
    }
    return result;
}

struct frame_sea frame_sea_surface(const trl_context *ctx, const struct ocean_desc *ocean)
{
    return (struct frame_sea){.ctx = ctx,
                              .ocean = ocean,
                              .sea = {.is_there = ocean->is_there,
                                      .mean_square_slope = sea_mean_square_slope(&ocean->waves),
                                      .index = water_refractive_index(&ocean->water, MIDDLE_NM),
                                      .white_share = sea_whitecap_share(&ocean->waves),
                                      .white_albedo = SEA_WHITECAP_ALBEDO}};
}

static void find_albedo(struct frame_sea *sea)
{
    const struct sky_sea_volume *v = sea->volume;
    const double surface = sea_diffuse_reflectance(sea->sea.index);
    for (int c = 0; c < 3; c++) {
        double below = 0; // from straight up to grazing it hardly differs
        for (int k = 0; k < SKY_SEA_WAVELENGTHS; k++) {
            below += v->rgb_from_spectrum[c][k] *
                     (double)v->spectrum[SKY_SEA_ANGLES / 2][SKY_SEA_ROWS - 1][0][k];
        }
        // A colour beside those of sRGB, or of water that loses nothing, has others.
        const double clear = surface + fmax(0, fmin(1, below)) * (1 - surface);
        sea->albedo[c] = (float)(clear + sea->sea.white_share * (sea->sea.white_albedo - clear));
    }
}

trl_result frame_sea_init(const trl_context *ctx, const struct trl_scene *scene,
                          struct frame_sea *out)
{
    *out = frame_sea_surface(ctx, &scene->ocean);
    const trl_result result =
        scene->ocean.is_there ? describe(ctx, &scene->medium, &out->volume) : TRL_OK;
    out->sea.volume = out->volume;
    return result;
}

trl_result frame_sea_light(struct frame_sea *sea)
{
    if (!sea->volume || sea->is_lit) {
        return TRL_OK;
    }
    const trl_result result = light_up(sea->ctx, sea->ocean, sea->volume);
    sea->is_lit = result == TRL_OK;
    if (sea->is_lit) {
        find_albedo(sea);
    }
    return result;
}

void frame_sea_finish(struct frame_sea *sea)
{
    mem_free(sea->ctx, sea->volume);
    *sea = (struct frame_sea){0};
}
