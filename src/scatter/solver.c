// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/solver.h"

#include "scatter/krylov.h"

#include <math.h>
#include <string.h>

struct solver_settings solver_settings_choose(const struct optics *optics,
                                              enum solver_quality quality)
{
    const double depth = optics_largest_depth(optics);
    const bool is_precise = quality == SOLVER_PRECISE;
    // Light is diffuse where matter is dense: grids grow as the logarithm of the depth.
    const double thick = log1p(depth);
    const int lmax = optics->lmax;
    return (struct solver_settings){.lmax = lmax,
                                    .levels = (is_precise ? 36 : 26) + (int)(12 * thick),
                                    .suns = is_precise ? 72 : 56,
                                    .zeniths = (is_precise ? 7 : 5) + lmax / 2,
                                    .azimuths = lmax < 6 ? 5 : lmax - 1,
                                    .first_refinement = 2,
                                    .nodes_per_shell = is_precise ? 10 : 8,
                                    .first_nodes_per_shell = is_precise ? 128 : 64,
                                    .has_plane = depth > 1,
                                    .max_orders = 200,
                                    .tolerance = is_precise ? 2e-4 : 1e-3};
}

// Adds the orders one after the other.
static trl_result sum_orders(const trl_context *ctx, struct sweep *sweep, int orders,
                             struct moments *sum)
{
    struct moments order[2] = {{0}};
    trl_result result = TRL_OK;
    for (int n = 0; n < 2 && result == TRL_OK; n++) {
        result = moments_init(ctx, sum->optics, sum->lmax, sum->levels, sum->suns, &order[n]);
    }
    // The last order is integrated where it is looked at.
    for (int n = 1; n < orders && result == TRL_OK; n++) {
        result = sweep_order(sweep, n > 1 ? &order[n % 2] : NULL, (n - 1.0) / orders,
                             &order[(n + 1) % 2]);
        if (result == TRL_OK) {
            moments_add(sum, &order[(n + 1) % 2], lanes_set(1));
        }
    }
    moments_finish(ctx, &order[0]);
    moments_finish(ctx, &order[1]);
    return result;
}

// All orders: GMRES, with a rough solution as preconditioner where matter is dense.
static trl_result solve_all(const trl_context *ctx, struct sweep *sweep,
                            const struct solver_settings *settings, struct solution *out)
{
    struct plane *plane = NULL;
    trl_result result = sweep_order(sweep, NULL, 0, &out->moments);
    if (result == TRL_OK && settings->has_plane) {
        result = plane_create(ctx, out, settings, &plane);
    }
    if (result == TRL_OK) {
        result = krylov_solve(ctx, sweep, plane, settings, &out->moments, &out->orders);
    }
    plane_destroy(ctx, &plane);
    return result;
}

trl_result solution_reserve(const trl_context *ctx, const struct optics *optics,
                            const struct solver_settings *settings, struct solution *out)
{
    *out = (struct solution){.optics = optics};
    out->rules = mem_alloc(ctx, 1, sizeof *out->rules);
    trl_result result = out->rules ? sunlight_reserve(ctx, optics, &out->sun) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        ray_rules_init(out->rules);
        result = moments_init(ctx, optics, settings->lmax, settings->levels, settings->suns,
                              &out->moments);
    }
    if (result != TRL_OK) {
        solution_finish(ctx, out);
    }
    return result;
}

static trl_result check_optics(const trl_context *ctx, const struct optics *optics)
{
    for (int k = 0; k < optics->wavelength_count; k++) {
        if (!(optics->vertical_depth[k] <= SOLVER_MAX_DEPTH)) {
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SOLVER,
                            "the atmosphere is too dense to be solved: vertical optical depth %.3g "
                            "at %g nm; at most %g",
                            optics->vertical_depth[k], optics->wavelength_nm[k], SOLVER_MAX_DEPTH);
        }
    }
    if (optics->backward_peak > SOLVER_MAX_BACKWARD_PEAK) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SOLVER,
                        "a phase function has a backward peak that is too sharp to be solved: its "
                        "moment %d is -%.2f; g of -0.75 can be, and forward peaks of any sharpness",
                        optics->lmax + 1 + optics->lmax % 2, optics->backward_peak);
    }
    return TRL_OK;
}

trl_result solution_init(const trl_context *ctx, const struct optics *optics,
                         const struct solver_settings *settings, struct solution *out)
{
    trl_result result = check_optics(ctx, optics);
    if (result == TRL_OK) {
        result = solution_reserve(ctx, optics, settings, out);
    }
    if (result != TRL_OK) {
        return result;
    }
    struct sweep *sweep = NULL;
    result = sunlight_fill(ctx, out->rules, &out->sun);
    if (result == TRL_OK) {
        result = sweep_create(ctx, out, settings, &sweep);
    }
    if (result == TRL_OK && settings->orders > 0) {
        out->orders = settings->orders;
        result = sum_orders(ctx, sweep, settings->orders, &out->moments);
    } else if (result == TRL_OK) {
        result = solve_all(ctx, sweep, settings, out);
    }
    sweep_destroy(ctx, &sweep);
    if (result != TRL_OK) {
        solution_finish(ctx, out);
    }
    return result;
}

void solution_finish(const trl_context *ctx, struct solution *solution)
{
    mem_free(ctx, solution->rules);
    sunlight_finish(ctx, &solution->sun);
    moments_finish(ctx, &solution->moments);
    *solution = (struct solution){0};
}
