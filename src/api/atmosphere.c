// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <terrella/atmosphere.h>

#include "api/check.h"
#include "scatter/atmosphere.h"
#include "scene/scene.h"

enum { ATMOSPHERE_CANARY = 0x54524131 };

struct trl_atmosphere {
    struct atmosphere *atmosphere;
};

trl_atmosphere_desc trl_atmosphere_desc_default(void)
{
    const struct atmosphere_desc desc = atmosphere_desc_default();
    return (trl_atmosphere_desc){.canary = ATMOSPHERE_CANARY,
                                 .wavelengths = desc.wavelengths,
                                 .uses_cache = desc.uses_cache};
}

trl_result trl_atmosphere_create(trl_context *ctx, const trl_scene *scene,
                                 const trl_atmosphere_desc *desc, trl_atmosphere **out)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, out != NULL);
    *out = NULL;
    TRL_REQUIRE(ctx, scene != NULL);
    TRL_REQUIRE(ctx, desc != NULL);
    TRL_REQUIRE(ctx, desc->canary == ATMOSPHERE_CANARY);
    TRL_REQUIRE(ctx, desc->wavelengths <= LANES);
    TRL_REQUIRE(ctx, desc->spectrum == TRL_SPECTRUM_FULL || desc->spectrum == TRL_SPECTRUM_RGB);
    TRL_REQUIRE(ctx, desc->max_orders <= TRL_SKY_MAX_ORDERS);
    const bool is_rgb = desc->spectrum == TRL_SPECTRUM_RGB;
    trl_atmosphere *made = mem_alloc(ctx, 1, sizeof *made);
    if (!made) {
        return TRL_ERROR_MEMORY;
    }
    const struct atmosphere_desc inner = {.wavelengths =
                                              is_rgb ? ATMOSPHERE_RGB : desc->wavelengths,
                                          .orders = desc->max_orders,
                                          .uses_cache = desc->uses_cache};
    const trl_result result = atmosphere_create(ctx, &scene->medium, &inner, &made->atmosphere);
    if (result != TRL_OK) {
        mem_free(ctx, made);
        return result;
    }
    *out = made;
    return TRL_OK;
}

void trl_atmosphere_destroy(trl_atmosphere **atmosphere)
{
    if (!atmosphere || !*atmosphere) {
        return;
    }
    const trl_context *ctx = (*atmosphere)->atmosphere->ctx;
    atmosphere_destroy(&(*atmosphere)->atmosphere);
    mem_free(ctx, *atmosphere);
    *atmosphere = NULL;
}

void trl_atmosphere_read_stats(const trl_atmosphere *atmosphere, trl_atmosphere_stats *out)
{
    const struct atmosphere_stats *stats = &atmosphere->atmosphere->stats;
    const struct bands *bands = &atmosphere->atmosphere->bands;
    *out = (trl_atmosphere_stats){.solve_s = stats->solve_s,
                                  .table_s = stats->table_s,
                                  .load_s = stats->load_s,
                                  .orders = stats->orders,
                                  .solution_bytes = stats->solution_bytes,
                                  .table_bytes = stats->table_bytes,
                                  .is_from_cache = stats->is_from_cache,
                                  .band_error_share = bands->rms_error};
    for (int b = 0; b < BAND_COUNT; b++) {
        out->band_nm[b] = bands->nm[b];
    }
}
