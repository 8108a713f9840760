// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Spectra against closed forms, the observer against the numbers of its standard.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>

#include "log.h"
#include "spectrum/cie.h"
#include "spectrum/spectrum.h"

// What double arithmetic loses in a dozen operations.
#define ROUNDING 1e-14

static void assert_near(double got, double wanted, double relative)
{
    if (!(fabs(got - wanted) <= relative * fabs(wanted))) {
        fail_msg("got %.17g, wanted %.17g within %g of it", got, wanted, relative);
    }
}

static void zeroed_spectrum_is_black(void **state)
{
    (void)state;
    const struct spectrum s = {0};
    assert_true(spectrum_at(&s, 550) == 0 && spectrum_mean(&s, 360, 830) == 0);
}

static void table_is_linear_inside_and_constant_outside(void **state)
{
    trl_context *ctx = *state;
    const double nm[] = {400, 500, 700};
    const double value[] = {1, 3, 2};
    struct spectrum s;
    assert_int_equal(spectrum_table_init(ctx, nm, value, 3, &s), TRL_OK);
    assert_near(spectrum_at(&s, 300), 1, 0);
    assert_near(spectrum_at(&s, 400), 1, 0);
    assert_near(spectrum_at(&s, 450), 2, ROUNDING);
    assert_near(spectrum_at(&s, 500), 3, ROUNDING);
    assert_near(spectrum_at(&s, 600), 2.5, ROUNDING);
    assert_near(spectrum_at(&s, 700), 2, 0);
    assert_near(spectrum_at(&s, 9000), 2, 0);
    spectrum_finish(ctx, &s);
    assert_true(s.kind == SPECTRUM_CONSTANT && s.constant == 0);
    spectrum_finish(ctx, &s);
}

static void mean_of_table_is_exact(void **state)
{
    trl_context *ctx = *state;
    const double nm[] = {400, 500, 700};
    const double value[] = {1, 3, 2};
    struct spectrum s;
    assert_int_equal(spectrum_table_init(ctx, nm, value, 3, &s), TRL_OK);
    assert_near(spectrum_mean(&s, 300, 800), (100 + 200 + 500 + 200) / 500.0, ROUNDING);
    assert_near(spectrum_mean(&s, 450, 600), (50 * 2.5 + 100 * 2.75) / 150, ROUNDING);
    assert_near(spectrum_mean(&s, 100, 200), 1, ROUNDING);
    assert_near(spectrum_mean(&s, 800, 900), 2, ROUNDING);
    spectrum_finish(ctx, &s);
}

static void single_knot_is_constant(void **state)
{
    trl_context *ctx = *state;
    struct spectrum s;
    assert_int_equal(spectrum_table_init(ctx, &(double){500}, &(double){7}, 1, &s), TRL_OK);
    assert_near(spectrum_at(&s, 499), 7, 0);
    assert_near(spectrum_mean(&s, 400, 600), 7, ROUNDING);
    spectrum_finish(ctx, &s);
}

static void power_law_follows_its_exponent(void **state)
{
    (void)state;
    const struct spectrum s = {.kind = SPECTRUM_POWER_LAW, .power_law = {550, 2, -1.3}};
    assert_near(spectrum_at(&s, 550), 2, 0);
    assert_near(spectrum_at(&s, 1100), 2 * pow(2, -1.3), ROUNDING);
    // Simpson's error is (step / nm)^4 times some ten: the step is 7 nm.
    const double exact = 2 / pow(550, -1.3) * (pow(830, -0.3) - pow(360, -0.3)) / -0.3 / 470;
    assert_near(spectrum_mean(&s, 360, 830), exact, 1e-7);
}

static void rayleigh_is_the_number_of_the_formula(void **state)
{
    (void)state;
    const struct spectrum s = {.kind = SPECTRUM_RAYLEIGH, .rayleigh = {1.00027, 2.5e25}};
    // 8 pi^3 (1.00027^2 - 1)^2 / (3 2.5e25 (550e-9)^4), worked out with 30 digits.
    assert_near(spectrum_at(&s, 550), 1.0542226794701448e-05, 1e-11); // n^2 - 1 loses four digits
    assert_near(spectrum_at(&s, 275), 16 * spectrum_at(&s, 550), ROUNDING);
}

static void blackbody_sums_to_its_total(void **state)
{
    (void)state;
    const struct spectrum s = {.kind = SPECTRUM_BLACKBODY, .blackbody = {5778, 1361}};
    // All but 1e-7 of the light lies between 50 nm and 0.2 mm; in steps of 1 % the integrand is
    // smooth.
    double sum = 0;
    for (double nm = 50; nm < 2e5; nm *= 1.01) {
        sum += spectrum_mean(&s, nm, nm * 1.01) * nm * 0.01;
    }
    assert_near(sum, 1361, 1e-6);
}

static void blackbody_peaks_where_wien_says(void **state)
{
    (void)state;
    const struct spectrum s = {.kind = SPECTRUM_BLACKBODY, .blackbody = {6000, 1}};
    const double peak_nm = 2.897771955e6 / 6000; // CODATA 2018
    assert_true(spectrum_at(&s, peak_nm) > spectrum_at(&s, peak_nm * 1.001));
    assert_true(spectrum_at(&s, peak_nm) > spectrum_at(&s, peak_nm / 1.001));
    assert_true(spectrum_at(&s, 1e-3) == 0);
}

static void observer_has_the_values_of_the_standard(void **state)
{
    (void)state;
    const struct cie_xyz green = cie_observer(555);
    assert_near(green.x, 0.51205010, 1e-8); // the standard's digits
    assert_near(green.y, 1, 1e-8);
    const struct cie_xyz between = cie_observer(552.5);
    assert_near(between.y, (0.9949501 + 1) / 2, 1e-8);
    assert_true(cie_observer(359.9).x == 0 && cie_observer(830.1).x == 0);
    assert_true(cie_observer(830).x > 0 && cie_observer(NAN).y == 0);
}

static void observer_integral_is_that_of_equal_energy_white(void **state)
{
    (void)state;
    const struct cie_xyz sum = cie_observer_integral(100, 2000);
    // The standard's ybar at 1 nm sums to 106.856895; those of 5 nm differ in the seventh digit.
    // Equal energy is white: the three sums are the same to a few parts in ten thousand.
    assert_near(sum.y, 106.856895, 2e-6);
    assert_near(sum.x, sum.y, 5e-4);
    assert_near(sum.z, sum.y, 5e-4);
    double y = 0;
    for (int i = 0; i < 100; i++) {
        y += cie_observer_integral(333 + i * 5.37, 333 + (i + 1) * 5.37).y;
    }
    assert_near(y, sum.y, 1e-13);
}

static void matrix_maps_white_and_primaries(void **state)
{
    (void)state;
    const struct cie_rgb white =
        cie_rgb_of_xyz((struct cie_xyz){0.3127 / 0.3290, 1, (1 - 0.3127 - 0.3290) / 0.3290});
    assert_near(white.r, 1, ROUNDING);
    assert_near(white.g, 1, ROUNDING);
    assert_near(white.b, 1, ROUNDING);
    const struct cie_rgb red = cie_rgb_of_xyz((struct cie_xyz){0.64, 0.33, 0.03});
    assert_true(fabs(red.g / red.r) < 1e-15 && fabs(red.b / red.r) < 1e-15);
    const struct cie_rgb any = cie_rgb_of_xyz((struct cie_xyz){0.3, 0.4, 0.5});
    assert_near(cie_luminance(any), 0.4, ROUNDING);
    assert_near(cie_luminance((struct cie_rgb){1, 1, 1}), 1, ROUNDING);
}

static int make_context(void **state)
{
    static struct test_log log;
    *state = test_context(&log);
    return *state == NULL;
}

static int free_context(void **state)
{
    trl_context_destroy((trl_context **)state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(zeroed_spectrum_is_black),
        cmocka_unit_test(table_is_linear_inside_and_constant_outside),
        cmocka_unit_test(mean_of_table_is_exact),
        cmocka_unit_test(single_knot_is_constant),
        cmocka_unit_test(power_law_follows_its_exponent),
        cmocka_unit_test(rayleigh_is_the_number_of_the_formula),
        cmocka_unit_test(blackbody_sums_to_its_total),
        cmocka_unit_test(blackbody_peaks_where_wien_says),
        cmocka_unit_test(observer_has_the_values_of_the_standard),
        cmocka_unit_test(observer_integral_is_that_of_equal_energy_white),
        cmocka_unit_test(matrix_maps_white_and_primaries),
    };
    return cmocka_run_group_tests(tests, make_context, free_context);
}
