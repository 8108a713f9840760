// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The kernels of the light transport on grids that are as small as they may be, for sanitizers:
// every loop of them runs, to its ends, with one wavelength and with all lanes. What comes out is
// right only roughly.
#include "reference_media.h"

#include "base/context.h"
#include "scatter/query.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

static struct solver_settings smallest_settings(const struct optics *optics, int orders)
{
    struct solver_settings settings = solver_settings_choose(optics, SOLVER_INTERACTIVE);
    settings.levels = 6;
    settings.suns = 8;
    settings.zeniths = 3;
    settings.azimuths = 3;
    settings.first_refinement = 2;
    settings.nodes_per_shell = 1;
    settings.first_nodes_per_shell = 1;
    settings.has_plane = orders == 0;
    settings.orders = orders;
    return settings;
}

// Radiance of a planet that faces star and eye, from above its air.
static double look_down(const struct medium *medium, int wavelengths, int orders)
{
    static const double NM[LANES] = {400, 420, 440, 460, 480, 500, 520, 540,
                                     560, 580, 600, 620, 640, 660, 680, 700};
    trl_context *ctx = NULL;
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    struct optics *optics = mem_alloc(ctx, 1, sizeof *optics);
    assert_non_null(optics);
    optics_init(optics, medium, NM, wavelengths);
    const struct solver_settings settings = smallest_settings(optics, orders);
    struct solution solution;
    struct query *query = NULL;
    assert_int_equal(solution_init(ctx, optics, &settings, &solution), TRL_OK);
    assert_int_equal(query_create(ctx, &solution, &query), TRL_OK);
    lanes radiance;
    const struct query_view view = query_view_make(optics->top_radius_m + 1e5, 0.3, M_PI, 0);
    query_radiance(query, &view, &radiance);
    for (int i = 0; i < LANES; i++) {
        assert_true(isfinite(radiance[i]));
    }
    query_destroy(ctx, &query);
    solution_finish(ctx, &solution);
    mem_free(ctx, optics);
    trl_context_destroy(&ctx);
    return (double)radiance[wavelengths - 1];
}

// White ground under white air is a white ball.
static void small_grids_run(void **state)
{
    (void)state;
    static const double depths[] = {0, 0.3, 6};
    for (int i = 0; i < 3; i++) {
        const struct medium medium = uniform_medium(depths[i] / 60e3, 0, 1);
        const double white = cos(0.3) / M_PI;
        const double seen = look_down(&medium, i == 1 ? LANES : 1, 0);
        assert_true(seen > 0.8 * white && seen < 1.2 * white);
        assert_true(look_down(&medium, 3, 2) <= 1.2 * white);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(small_grids_run)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
