// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/atmosphere.h"

#include "scatter/cache.h"
#include "scatter/medium_edit.h"

#include <time.h>

struct atmosphere_desc atmosphere_desc_default(void)
{
    return (struct atmosphere_desc){.wavelengths = LANES, .uses_cache = true};
}

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

// A draft has about two thirds of the grid each way, and knows fewer moments and directions.
static struct solver_settings choose_settings(const struct optics *optics,
                                              enum atmosphere_quality quality)
{
    struct solver_settings s = solver_settings_choose(optics, SOLVER_INTERACTIVE);
    if (quality == ATMOSPHERE_DRAFT) {
        s.lmax = s.lmax > 4 ? 4 : s.lmax;
        s.levels = s.levels * 5 / 8;
        s.suns = s.suns * 5 / 8;
        s.zeniths = s.zeniths > 5 ? 5 : s.zeniths;
        s.azimuths = 5;
        s.first_nodes_per_shell *= 0.5;
        s.tolerance *= 10;
    }
    return s;
}

// Red, green and blue: those of Bruneton and Neyret 2008, whose tables hold three wavelengths;
// Elek 2010 compares with three and does not print his.
static void choose_wavelengths(struct atmosphere *a, const struct atmosphere_desc *desc)
{
    // Single orders would lack what counts as not scattered.
    const enum optics_use use = desc->orders > 0 ? OPTICS_WHOLE : OPTICS_PICTURES;
    static const double rgb_nm[] = {440, 550, 680};
    if (desc->wavelengths == ATMOSPHERE_RGB) {
        optics_init_for(use, &a->medium, rgb_nm, 3, a->optics);
    } else {
        optics_init_visible(use, &a->medium, (int)desc->wavelengths, a->optics);
    }
}

static void choose_bands(struct atmosphere *a)
{
    struct band_fit fit;
    band_fit_init(&fit, a->optics);
    band_fit_add_products(&fit, &a->solution);
    band_fit_choose(&fit, &a->bands);
    trl_log(a->ctx, TRL_LOG_DEBUG, TRL_LOG_ITEM_SOLVER,
            "bands at %.0f, %.0f, %.0f, %.0f nm reproduce colours to %.2f %%", a->bands.nm[0],
            a->bands.nm[1], a->bands.nm[2], a->bands.nm[3], 100 * a->bands.rms_error);
}

static trl_result compute(struct atmosphere *a, const struct solver_settings *settings)
{
    const double start = seconds();
    trl_result result = solution_init(a->ctx, a->optics, settings, &a->solution);
    const double solved = seconds();
    if (result == TRL_OK) {
        choose_bands(a);
        result = table_init(a->ctx, &a->solution, &a->peaked, &a->bands, &a->table);
    }
    a->stats.solve_s = solved - start;
    a->stats.table_s = seconds() - solved;
    return result;
}

// Reserves what the cache fills. Anything less than success leaves the arrays empty again.
static bool load(struct atmosphere *a, const struct solver_settings *settings)
{
    const double start = seconds();
    struct solution *s = &a->solution;
    const struct table_size size = a->table.size;
    const bool is_loaded =
        solution_reserve(a->ctx, a->optics, settings, s) == TRL_OK &&
        table_reserve(a->ctx, &s->moments, 1 + a->peaked.count, &a->table) == TRL_OK &&
        cache_load(a, settings);
    if (!is_loaded) {
        solution_finish(a->ctx, s);
        table_finish(a->ctx, &a->table);
        a->table.size = size;
    }
    a->stats.load_s = is_loaded ? seconds() - start : 0;
    a->stats.is_from_cache = is_loaded;
    return is_loaded;
}

static void measure(struct atmosphere *a)
{
    const struct moments *m = &a->solution.moments;
    a->stats.orders = a->solution.orders;
    a->stats.solution_bytes =
        ((size_t)m->levels * (size_t)m->suns * (size_t)harmonic_count(m->lmax) +
         (size_t)a->solution.sun.levels * (size_t)a->solution.sun.columns) *
        sizeof(lanes);
    a->stats.table_bytes = table_texels(&a->table) * sizeof(float);
}

// Solved, loaded, or neither (TRL_OK, without a table) where only the cache was asked.
static trl_result obtain(struct atmosphere *a, const struct atmosphere_desc *desc)
{
    struct solver_settings settings = choose_settings(a->optics, desc->quality);
    settings.orders = (int)desc->orders;
    const bool is_fine = desc->quality == ATMOSPHERE_FINE;
    const bool has_cache = desc->uses_cache && is_fine && a->ctx->cache_dir[0] != '\0';
    a->peaked = peaked_choose(a->optics);
    a->table.size = is_fine ? table_size_default() : table_size_draft();
    if ((has_cache && load(a, &settings)) || desc->only_from_cache) {
        return TRL_OK;
    }
    const trl_result result = compute(a, &settings);
    if (result == TRL_OK && has_cache) {
        cache_store(a, &settings);
    }
    return result;
}

trl_result atmosphere_create(const trl_context *ctx, const struct medium *medium,
                             const struct atmosphere_desc *desc, struct atmosphere **out)
{
    *out = NULL;
    if (desc->wavelengths < 1 || desc->wavelengths > ATMOSPHERE_RGB) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "%u wavelengths cannot be solved: from 1 to %d", desc->wavelengths, LANES);
    }
    struct atmosphere *a = mem_alloc(ctx, 1, sizeof *a);
    if (!a) {
        return TRL_ERROR_MEMORY;
    }
    a->ctx = ctx;
    trl_result result = medium_copy(ctx, medium, &a->medium);
    a->optics = mem_alloc(ctx, 1, sizeof *a->optics);
    if (!a->optics) {
        result = TRL_ERROR_MEMORY;
    }
    if (result == TRL_OK) {
        choose_wavelengths(a, desc);
        result = obtain(a, desc);
    }
    if (result != TRL_OK || !a->table.texels) {
        atmosphere_destroy(&a);
        return result;
    }
    measure(a);
    *out = a;
    return TRL_OK;
}

void atmosphere_destroy(struct atmosphere **atmosphere)
{
    struct atmosphere *a = *atmosphere;
    if (!a) {
        return;
    }
    const trl_context *ctx = a->ctx;
    table_finish(ctx, &a->table);
    solution_finish(ctx, &a->solution);
    mem_free(ctx, a->optics);
    medium_finish(ctx, &a->medium);
    mem_free(ctx, a);
    *atmosphere = NULL;
}
