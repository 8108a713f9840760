// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Phase functions and profiles against closed forms, and moments against plain numerical
// integration.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>

#include "log.h"
#include "scatter/medium.h"

#define PI 3.14159265358979323846

enum { LMAX = 12, PANELS = 400000 };

// Simpson's rule in the angle; with these panels good to 1e-12 for the peaks in these tests.
static void integrate_moments(const struct phase *phase, double *moments)
{
    for (int l = 0; l <= LMAX; l++) {
        moments[l] = 0;
    }
    for (int i = 0; i <= PANELS; i++) {
        const double angle = PI * i / PANELS;
        const double weight = (i == 0 || i == PANELS ? 1 : i % 2 == 1 ? 4 : 2) * PI / (3 * PANELS);
        const double x = cos(angle);
        const double f = 2 * PI * phase_value(phase, x) * sin(angle) * weight;
        double before = 0;
        double now = 1;
        for (int l = 0; l <= LMAX; l++) {
            moments[l] += f * now;
            const double next = ((2 * l + 1) * x * now - l * before) / (l + 1);
            before = now;
            now = next;
        }
    }
}

static void assert_moments_agree(const struct phase *phase, double tolerance)
{
    double wanted[LMAX + 1];
    double got[LMAX + 1];
    integrate_moments(phase, wanted);
    phase_moments(phase, LMAX, got);
    assert_true(fabs(wanted[0] - 1) <= tolerance); // it integrates to 1
    for (int l = 0; l <= LMAX; l++) {
        if (!(fabs(got[l] - wanted[l]) <= tolerance)) {
            fail_msg("moment %d is %.15g, integration gives %.15g", l, got[l], wanted[l]);
        }
    }
}

static void analytic_phases_are_normalised_with_their_moments(void **state)
{
    (void)state;
    const double g[] = {-0.7, -0.2, 0, 0.3, 0.76, 0.95};
    assert_moments_agree(&(struct phase){.kind = PHASE_ISOTROPIC}, 1e-11);
    assert_moments_agree(&(struct phase){.kind = PHASE_RAYLEIGH}, 1e-11);
    for (size_t i = 0; i < sizeof g / sizeof g[0]; i++) {
        const struct phase hg = {.kind = PHASE_HENYEY_GREENSTEIN, .g = g[i]};
        const struct phase cs = {.kind = PHASE_CORNETTE_SHANKS, .g = g[i]};
        assert_moments_agree(&hg, 1e-11);
        assert_moments_agree(&cs, 1e-11);
    }
}

static void cornette_shanks_at_zero_is_rayleigh(void **state)
{
    (void)state;
    const struct phase cs = {.kind = PHASE_CORNETTE_SHANKS};
    const struct phase rayleigh = {.kind = PHASE_RAYLEIGH};
    for (int i = -10; i <= 10; i++) {
        assert_true(fabs(phase_value(&cs, i / 10.0) - phase_value(&rayleigh, i / 10.0)) < 1e-16);
    }
}

// Elek 2010 Eq. 5 over 4 pi as it is printed.
static void cornette_shanks_is_the_papers_formula(void **state)
{
    (void)state;
    const double g = 0.76;
    const struct phase cs = {.kind = PHASE_CORNETTE_SHANKS, .g = g};
    for (int i = -10; i <= 10; i++) {
        const double mu = i / 10.0;
        const double wanted = 3 * (1 - g * g) / (8 * PI * (2 + g * g)) * (1 + mu * mu) /
                              pow(1 + g * g - 2 * g * mu, 1.5);
        assert_true(fabs(phase_value(&cs, mu) / wanted - 1) < 1e-13); // rounding
    }
}

static void extreme_peaks_stay_finite(void **state)
{
    (void)state;
    const struct phase sharp = {.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.9999};
    // At nu = 1 the formula is (1 + g) / (4 pi (1 - g)^2).
    assert_true(fabs(phase_value(&sharp, 1) / (1.9999 / (4 * PI * 1e-8)) - 1) < 1e-9);
    assert_true(
        isfinite(phase_value(&sharp, 1.0000001))); // cosines that rounding took out of range
    assert_true(phase_value(&sharp, -1.0000001) > 0);
}

static void table_is_normalised_with_its_moments(void **state)
{
    trl_context *ctx = *state;
    const double angle[] = {0.1, 0.2, 1, 2.5};
    const double value[] = {50, 20, 1, 3};
    struct phase table;
    assert_int_equal(phase_table_init(ctx, angle, value, 4, &table), TRL_OK);
    // Simpson is first order in the kinks' panels: the step squared times the change of slope.
    assert_moments_agree(&table, 1e-8);
    assert_true(fabs(table.value[0] / table.value[3] - 50.0 / 3) < 1e-12);
    struct medium m = {.constituent_count = 1};
    m.constituents[0].phase = table;
    medium_finish(ctx, &m);
    assert_int_equal(m.constituent_count, 0);
}

static void table_of_one_knot_is_isotropic(void **state)
{
    trl_context *ctx = *state;
    struct phase table;
    assert_int_equal(phase_table_init(ctx, &(double){1}, &(double){5}, 1, &table), TRL_OK);
    double moments[LMAX + 1];
    phase_moments(&table, LMAX, moments);
    assert_true(fabs(phase_value(&table, 0.3) - 1 / (4 * PI)) < 1e-14);
    for (int l = 0; l <= LMAX; l++) {
        assert_true(fabs(moments[l] - (l == 0)) < 1e-13);
    }
    mem_free(ctx, table.angle_rad);
}

// A fine table of Cornette-Shanks has its moments up to the square of the knots' distance.
static void fine_table_approaches_what_it_samples(void **state)
{
    trl_context *ctx = *state;
    enum { KNOTS = 1801 };
    static double angle[KNOTS];
    static double value[KNOTS];
    const struct phase cs = {.kind = PHASE_CORNETTE_SHANKS, .g = 0.7};
    for (int i = 0; i < KNOTS; i++) {
        angle[i] = PI * i / (KNOTS - 1);
        value[i] = phase_value(&cs, cos(angle[i]));
    }
    struct phase table;
    double got[LMAX + 1];
    double wanted[LMAX + 1];
    assert_int_equal(phase_table_init(ctx, angle, value, KNOTS, &table), TRL_OK);
    phase_moments(&table, LMAX, got);
    phase_moments(&cs, LMAX, wanted);
    for (int l = 0; l <= LMAX; l++) {
        assert_true(fabs(got[l] - wanted[l]) < 3e-5);
    }
    mem_free(ctx, table.angle_rad);
}

static void profiles_have_their_forms(void **state)
{
    trl_context *ctx = *state;
    const struct profile uniform = {.kind = PROFILE_UNIFORM};
    const struct profile gas = {.kind = PROFILE_EXPONENTIAL, .scale_height_m = 8000};
    const struct profile layer = {.kind = PROFILE_TENT, .centre_m = 25000, .half_width_m = 15000};
    assert_true(profile_density(&uniform, 5e4) == 1);
    assert_true(profile_density(&gas, 0) == 1);
    assert_true(fabs(profile_density(&gas, 8000) - exp(-1)) < 1e-16);
    assert_true(profile_density(&layer, 25000) == 1);
    assert_true(fabs(profile_density(&layer, 32500) - 0.5) < 1e-15);
    assert_true(fabs(profile_density(&layer, 17500) - 0.5) < 1e-15);
    assert_true(profile_density(&layer, 9000) == 0 && profile_density(&layer, 41000) == 0);
    const double altitude[] = {0, 1000, 3000};
    const double density[] = {1, 0.5, 0};
    struct profile table;
    assert_int_equal(profile_table_init(ctx, altitude, density, 3, &table), TRL_OK);
    assert_true(profile_density(&table, -5) == 1 && profile_density(&table, 9000) == 0);
    assert_true(fabs(profile_density(&table, 2000) - 0.25) < 1e-15);
    mem_free(ctx, table.altitude_m);
}

static void values_out_of_range_at_a_wavelength_are_told(void **state)
{
    trl_context *ctx = *state;
    struct medium m = {.constituent_count = 1};
    m.ground_albedo = (struct spectrum){.kind = SPECTRUM_POWER_LAW, .power_law = {500, 0.5, 1}};
    m.constituents[0].absorption_per_m =
        (struct spectrum){.kind = SPECTRUM_POWER_LAW, .power_law = {500, 1, -20}};
    assert_int_equal(medium_check(ctx, &m, 800), TRL_OK);
    assert_int_equal(medium_check(ctx, &m, 1100), TRL_ERROR_INVALID); // albedo 1.1
    assert_int_equal(medium_check(ctx, &m, 300), TRL_ERROR_INVALID);  // 2.7e4 per metre
    m.ground_albedo = (struct spectrum){.constant = NAN};
    assert_int_equal(medium_check(ctx, &m, 800), TRL_ERROR_INVALID);
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
        cmocka_unit_test(analytic_phases_are_normalised_with_their_moments),
        cmocka_unit_test(cornette_shanks_at_zero_is_rayleigh),
        cmocka_unit_test(cornette_shanks_is_the_papers_formula),
        cmocka_unit_test(extreme_peaks_stay_finite),
        cmocka_unit_test(table_is_normalised_with_its_moments),
        cmocka_unit_test(table_of_one_knot_is_isotropic),
        cmocka_unit_test(fine_table_approaches_what_it_samples),
        cmocka_unit_test(profiles_have_their_forms),
        cmocka_unit_test(values_out_of_range_at_a_wavelength_are_told),
    };
    return cmocka_run_group_tests(tests, make_context, free_context);
}
