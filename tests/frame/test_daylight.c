// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// White walls and bare ground in the light of a star.
#include "frame/daylight.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static void a_wall_reflects_all_lumens_into_a_half_space(void **state)
{
    (void)state;
    struct medium medium = {.star_irradiance = {.constant = 1.5}};
    // The integral of ybar over wavelength is 106.857 nm (CIE 1931 table at 5 nm), to its rounding.
    const double expected = 683.002 * 1.5 * 106.857 / PI;
    assert_true(fabs(daylight_wall_cd_m2(&medium) / expected - 1) < 1e-4);
    medium.star_irradiance.constant = 0;
    assert_true(daylight_wall_cd_m2(&medium) == 0);
}

static void grey_ground_is_grey_under_any_star(void **state)
{
    (void)state;
    const struct medium medium = {
        .ground_albedo = {.constant = 0.3},
        .star_irradiance = {.kind = SPECTRUM_BLACKBODY,
                            .blackbody = {.temperature_K = 3000, .total_W_m2 = 1000}}};
    float rgb[3];
    daylight_ground_albedo(&medium, rgb);
    for (int i = 0; i < 3; i++) {
        assert_true(fabsf(rgb[i] - 0.3f) < 1e-6f); // rounding of a float
    }
}

static void coloured_ground_has_its_colour_within_range(void **state)
{
    (void)state;
    // Reflects from 600 nm on: red beyond what the primaries can show, so green is cut at 0.
    double nm[] = {599, 600}, value[] = {0, 1};
    const struct medium medium = {
        .ground_albedo = {.kind = SPECTRUM_TABLE, .table = {nm, value, 2}},
        .star_irradiance = {.constant = 1}};
    float rgb[3];
    daylight_ground_albedo(&medium, rgb);
    assert_true(rgb[0] > 0.5f && rgb[0] <= 1);
    assert_true(rgb[1] >= 0 && rgb[1] < 0.1f);
    assert_true(rgb[2] >= 0 && rgb[2] < 0.1f);
}

static void without_a_star_there_is_no_colour(void **state)
{
    (void)state;
    const struct medium medium = {.ground_albedo = {.constant = 0.3}};
    float rgb[3];
    daylight_ground_albedo(&medium, rgb);
    assert_true(rgb[0] == 0 && rgb[1] == 0 && rgb[2] == 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_wall_reflects_all_lumens_into_a_half_space),
        cmocka_unit_test(grey_ground_is_grey_under_any_star),
        cmocka_unit_test(coloured_ground_has_its_colour_within_range),
        cmocka_unit_test(without_a_star_there_is_no_colour),
    };
    return cmocka_run_group_tests_name("daylight", tests, NULL, NULL);
}
