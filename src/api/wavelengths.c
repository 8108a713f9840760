// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "api/wavelengths.h"

#include <stdlib.h>

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

size_t wavelengths_sort(double *nm, size_t count)
{
    qsort(nm, count, sizeof *nm, compare_doubles);
    size_t kept = 0;
    for (size_t n = 0; n < count; n++) {
        if (kept == 0 || nm[n] != nm[kept - 1]) {
            nm[kept++] = nm[n];
        }
    }
    return kept;
}

static trl_result solve_some(const trl_context *ctx, const struct optics *optics,
                             const struct wavelengths_work *work)
{
    struct solver_settings settings = solver_settings_choose(optics, SOLVER_PRECISE);
    settings.orders = (int)work->orders;
    struct solution solution;
    trl_result result = solution_init(ctx, optics, &settings, &solution);
    if (result == TRL_OK) {
        result = work->answer(work->self, &solution);
        solution_finish(ctx, &solution);
    }
    return result;
}

trl_result wavelengths_solve(const trl_context *ctx, const struct medium *medium, const double *nm,
                             size_t count, const struct wavelengths_work *work)
{
    struct optics *optics = mem_alloc(ctx, 1, sizeof *optics);
    trl_result result = optics ? TRL_OK : TRL_ERROR_MEMORY;
    for (size_t first = 0; first < count && result == TRL_OK; first += LANES) {
        const size_t left = count - first, some = left < LANES ? left : LANES;
        for (size_t k = first; k < first + some && result == TRL_OK; k++) {
            result = medium_check(ctx, medium, nm[k]);
        }
        if (result == TRL_OK) {
            optics_init_for(work->use, medium, nm + first, (int)some, optics);
            result = solve_some(ctx, optics, work);
        }
    }
    mem_free(ctx, optics);
    return result;
}
