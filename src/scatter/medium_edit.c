// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/medium_edit.h"

#include <math.h>
#include <string.h>

static trl_result copy_spectrum(const trl_context *ctx, const struct spectrum *from,
                                struct spectrum *to)
{
    if (from->kind == SPECTRUM_TABLE) {
        return spectrum_table_init(ctx, from->table.nm, from->table.value, from->table.count, to);
    }
    *to = *from;
    return TRL_OK;
}

// Two arrays in one block, as tables of profiles and phase functions are kept.
static double *copy_pair(const trl_context *ctx, const double *first, const double *second,
                         size_t count)
{
    double *block = mem_alloc(ctx, count, 2 * sizeof *block);
    if (block) {
        memcpy(block, first, count * sizeof *block);
        memcpy(block + count, second, count * sizeof *block);
    }
    return block;
}

static trl_result copy_profile(const trl_context *ctx, const struct profile *from,
                               struct profile *to)
{
    *to = *from;
    if (from->kind == PROFILE_TABLE) {
        to->altitude_m = copy_pair(ctx, from->altitude_m, from->density, from->count);
        to->density = to->altitude_m ? to->altitude_m + from->count : NULL;
    }
    return from->kind != PROFILE_TABLE || to->altitude_m ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result copy_phase(const trl_context *ctx, const struct phase *from, struct phase *to)
{
    *to = *from;
    if (from->kind == PHASE_TABLE) {
        to->angle_rad = copy_pair(ctx, from->angle_rad, from->value, from->count);
        to->value = to->angle_rad ? to->angle_rad + from->count : NULL;
    }
    return from->kind != PHASE_TABLE || to->angle_rad ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result copy_constituent(const trl_context *ctx, const struct constituent *from,
                                   struct constituent *to)
{
    to->name = mem_strdup(ctx, from->name ? from->name : "");
    trl_result result = to->name ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = copy_spectrum(ctx, &from->scattering_per_m, &to->scattering_per_m);
    }
    if (result == TRL_OK) {
        result = copy_spectrum(ctx, &from->absorption_per_m, &to->absorption_per_m);
    }
    if (result == TRL_OK) {
        result = copy_profile(ctx, &from->profile, &to->profile);
    }
    return result == TRL_OK ? copy_phase(ctx, &from->phase, &to->phase) : result;
}

trl_result medium_copy_atmosphere(const trl_context *ctx, const struct medium *planet,
                                  const struct medium *atmosphere, struct medium *out)
{
    const double height_m = atmosphere->top_radius_m - atmosphere->ground_radius_m;
    *out = (struct medium){.ground_radius_m = planet->ground_radius_m,
                           .top_radius_m = planet->ground_radius_m + height_m,
                           .star_angular_radius_rad = planet->star_angular_radius_rad};
    trl_result result = copy_spectrum(ctx, &planet->ground_albedo, &out->ground_albedo);
    if (result == TRL_OK) {
        result = copy_spectrum(ctx, &planet->star_irradiance, &out->star_irradiance);
    }
    for (size_t i = 0; i < atmosphere->constituent_count && result == TRL_OK; i++) {
        out->constituent_count = i + 1;
        result = copy_constituent(ctx, &atmosphere->constituents[i], &out->constituents[i]);
    }
    if (result != TRL_OK) {
        medium_finish(ctx, out);
    }
    return result;
}

trl_result medium_copy(const trl_context *ctx, const struct medium *medium, struct medium *out)
{
    const trl_result result = medium_copy_atmosphere(ctx, medium, medium, out);
    out->top_radius_m = result == TRL_OK ? medium->top_radius_m : 0; // to the last bit
    return result;
}

static void scale_spectrum(struct spectrum *s, double factor)
{
    switch (s->kind) {
    case SPECTRUM_CONSTANT:
        s->constant *= factor;
        break;
    case SPECTRUM_TABLE:
        for (size_t i = 0; i < s->table.count; i++) {
            s->table.value[i] *= factor;
        }
        break;
    case SPECTRUM_POWER_LAW:
        s->power_law.value *= factor;
        break;
    case SPECTRUM_RAYLEIGH: {
        // Scattering goes as (n^2 - 1)^2.
        const double n = s->rayleigh.refractive_index;
        s->rayleigh.refractive_index = sqrt(1 + (n * n - 1) * sqrt(factor));
        break;
    }
    case SPECTRUM_BLACKBODY:
        s->blackbody.total_W_m2 *= factor;
        break;
    }
}

void constituent_scale(struct constituent *constituent, double factor)
{
    scale_spectrum(&constituent->scattering_per_m, factor);
    scale_spectrum(&constituent->absorption_per_m, factor);
}

bool constituent_set_asymmetry(struct constituent *constituent, double g)
{
    struct phase *phase = &constituent->phase;
    if (phase->kind != PHASE_HENYEY_GREENSTEIN && phase->kind != PHASE_CORNETTE_SHANKS) {
        return false;
    }
    phase->g = g;
    return true;
}
