// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Four bands for sixteen wavelengths.
#include "reference_media.h"

#include "base/context.h"
#include "scatter/bands.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

// Air over an absorber of blue light whose vertical optical depth is `depth` at 400 and a tenth of
// it at 700 nm: the star is red at the ground, and faint.
static struct medium deep_medium(double depth)
{
    const double scale_height_m = 2000;
    struct medium medium = earth_like_medium(0.1);
    medium.constituents[1] = make_constituent(0, 0, exponential_profile(scale_height_m),
                                              (struct phase){.kind = PHASE_ISOTROPIC});
    medium.constituents[1].absorption_per_m = (struct spectrum){
        .kind = SPECTRUM_POWER_LAW,
        .power_law = {.value = depth / scale_height_m, .at_nm = 400, .exponent = -4.1}};
    return medium;
}

// Clouds above such air have the star's light as it comes, in the colours that all wavelengths give
// it within `most` of its luminance.
static void check_white(double depth, double most)
{
    const trl_context_desc desc = trl_context_desc_default();
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    const struct medium medium = deep_medium(depth);
    struct optics *optics = mem_alloc(ctx, 1, sizeof *optics);
    assert_non_null(optics);
    optics_init_visible(OPTICS_PICTURES, &medium, 16, optics);
    const struct solver_settings settings = solver_settings_choose(optics, SOLVER_INTERACTIVE);
    struct solution solution;
    assert_int_equal(solution_init(ctx, optics, &settings, &solution), TRL_OK);

    struct band_fit fit;
    band_fit_init(&fit, optics);
    band_fit_add_products(&fit, &solution);
    struct bands bands;
    band_fit_choose(&fit, &bands);
    for (int k = 0; k < 3; k++) {
        double exact = 0;
        double got = 0;
        for (int i = 0; i < optics->wavelength_count; i++) {
            exact += fit.rgb_from_lanes[k][i];
        }
        for (int r = 0; r < BAND_COUNT; r++) {
            got += (double)bands.rgb_from_bands[k][r];
        }
        if (!(fabs(got - exact) <= most * fit.star_luminance)) {
            fail_msg("depth %g: white's colour %d is %g of %g", depth, k, got, exact);
        }
    }
    solution_finish(ctx, &solution);
    mem_free(ctx, optics);
    trl_context_destroy(&ctx);
}

// Where the star at the ground is too dark to be seen it has no say: 1 % is two steps of 255.
static void light_above_opaque_air_is_white(void **state)
{
    (void)state;
    check_white(300, 0.01);
}

// Where it can be seen its reds are shown too, with the same four; white from above the air counts
// as much as all of them. 5 %: 4 measured; 30 without that.
static void light_above_deep_air_is_nearly_white(void **state)
{
    (void)state;
    check_white(30, 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(light_above_opaque_air_is_white),
                                       cmocka_unit_test(light_above_deep_air_is_nearly_white)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
