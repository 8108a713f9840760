// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/medium_edit.h"

#include <math.h>
#include <string.h>

static trl_result copy_phase(const trl_context *ctx, const struct phase *from, struct phase *to)
{
    *to = *from;
    if (from->kind == PHASE_TABLE) {
        // Two arrays in one block; they are normalised already.
        const size_t bytes = from->count * sizeof *from->value;
        to->angle_rad = mem_alloc(ctx, 2, bytes);
        to->value = to->angle_rad ? to->angle_rad + from->count : NULL;
        if (to->value) {
            memcpy(to->angle_rad, from->angle_rad, bytes);
            memcpy(to->value, from->value, bytes);
        }
    }
    return from->kind != PHASE_TABLE || to->angle_rad ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result copy_constituent(const trl_context *ctx, const struct constituent *from,
                                   struct constituent *to)
{
    to->name = mem_strdup(ctx, from->name ? from->name : "");
    trl_result result = to->name ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = spectrum_copy(ctx, &from->scattering_per_m, &to->scattering_per_m);
    }
    if (result == TRL_OK) {
        result = spectrum_copy(ctx, &from->absorption_per_m, &to->absorption_per_m);
    }
    if (result == TRL_OK) {
        result = profile_copy(ctx, &from->profile, &to->profile);
    }
    return result == TRL_OK ? copy_phase(ctx, &from->phase, &to->phase) : result;
}

trl_result medium_copy_atmosphere(const trl_context *ctx, const struct medium *planet,
                                  const struct medium *atmosphere, struct medium *out)
{
    const double height_m = atmosphere->top_radius_m - atmosphere->ground_radius_m;
    *out = (struct medium){.ground_radius_m = planet->ground_radius_m,
                           .top_radius_m = planet->ground_radius_m + height_m,
                           .star_angular_radius_rad = planet->star_angular_radius_rad,
                           .star_corona = planet->star_corona};
    trl_result result = spectrum_copy(ctx, &planet->ground_albedo, &out->ground_albedo);
    if (result == TRL_OK) {
        result = spectrum_copy(ctx, &planet->star_irradiance, &out->star_irradiance);
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
