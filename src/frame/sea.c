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

static void fill_colours(const struct medium *medium, const double *nm, struct sky_sea_volume *out)
{
    double weights[3][DAYLIGHT_MAX_WEIGHTS];
    daylight_weights(medium, nm, SKY_SEA_WAVELENGTHS, weights);
    for (int k = 0; k < SKY_SEA_WAVELENGTHS; k++) {
        out->nm[k] = nm[k];
        for (int c = 0; c < 3; c++) {
            out->rgb_from_spectrum[c][k] = weights[c][k];
        }
    }
}

trl_result frame_sea_make_volume(const trl_context *ctx, const struct ocean_desc *ocean,
                                 const struct medium *medium, struct sky_sea_volume **out)
{
    *out = NULL;
    double nm[VOLUME_WAVELENGTHS];
    for (int k = 0; k < VOLUME_WAVELENGTHS; k++) {
        nm[k] = FIRST_NM + STEP_NM * k;
    }
    struct volume_table *table = NULL;
    trl_result result = volume_table_get(ctx, ocean, nm, VOLUME_WAVELENGTHS, &table);
    if (result == TRL_OK) {
        *out = mem_alloc(ctx, 1, sizeof **out);
        result = *out ? TRL_OK : TRL_ERROR_MEMORY;
    }
    if (result == TRL_OK) {
        fill_colours(medium, nm, *out);
        (*out)->critical = table->critical;
#pragma omp parallel for schedule(dynamic)
        for (int i = 0; i < SKY_SEA_DEPTHS; i++) {
            fill_depth(table, i, *out);
        }
    }
    volume_table_destroy(ctx, &table);
    return result;
}

struct frame_sea frame_sea_surface(const trl_context *ctx, const struct ocean_desc *ocean)
{
    return (struct frame_sea){.ctx = ctx,
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
    const struct ocean_desc *ocean = &scene->ocean;
    *out = frame_sea_surface(ctx, ocean);
    const trl_result result =
        ocean->is_there ? frame_sea_make_volume(ctx, ocean, &scene->medium, &out->volume) : TRL_OK;
    out->sea.volume = out->volume;
    if (out->volume) {
        find_albedo(out);
    }
    return result;
}

void frame_sea_finish(struct frame_sea *sea)
{
    mem_free(sea->ctx, sea->volume);
    *sea = (struct frame_sea){0};
}
