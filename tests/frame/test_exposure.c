// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The light meter on synthetic pictures whose exposure is known.
#include "fixture.h"
#include "frame/exposure.h"

#include <math.h>

enum { WIDTH = 512, HEIGHT = 288 };

// Luminance of a white wall in sunlight at the top of Earth's atmosphere, about 130 klx / pi.
static const double WALL_CD_M2 = 41000;

// log2 of floats, summed over 160 thousand samples in float.
static const double EV_TOLERANCE = 2e-3;

static struct color grey(double luminance)
{
    return (struct color){(float)luminance, (float)luminance, (float)luminance};
}

static struct color paint_even(uint32_t x, uint32_t y, const void *user)
{
    (void)x;
    (void)y;
    return grey(*(const double *)user);
}

// A disc of 1/16 of the picture's area in black space.
static struct color paint_planet(uint32_t x, uint32_t y, const void *user)
{
    const double dx = x - WIDTH / 2.0, dy = y - HEIGHT / 2.0;
    const double radius2 = WIDTH * HEIGHT / (16 * 3.14159265);
    return grey(dx * dx + dy * dy < radius2 ? *(const double *)user : 0);
}

// The sun, of the size that it has at a field of view of 40 degrees, in a sky of 4000 cd m^-2.
static struct color paint_sun(uint32_t x, uint32_t y, const void *user)
{
    (void)user;
    const double dx = x - 300.0, dy = y - 200.0;
    return grey(dx * dx + dy * dy < 3.5 * 3.5 ? 1.6e9 : 4000);
}

// One column in fifty of a sunlit crescent, the rest is night.
static struct color paint_crescent(uint32_t x, uint32_t y, const void *user)
{
    (void)y;
    (void)user;
    return grey(x < WIDTH / 50 ? 1000 : 1e-4);
}

static struct exposure make_exposure(struct fixture *f)
{
    struct exposure exposure;
    assert_int_equal(exposure_init(f->gpu, WALL_CD_M2, &exposure), TRL_OK);
    return exposure;
}

static double update(struct exposure *exposure, const struct gpu_texture *radiance,
                     double elapsed_s)
{
    const struct exposure_request request = {.elapsed_s = elapsed_s};
    assert_int_equal(exposure_update(exposure, &request, radiance), TRL_OK);
    double ev100 = NAN;
    assert_int_equal(exposure_read(exposure, &ev100), TRL_OK);
    assert_true(isfinite(ev100));
    return ev100;
}

static double meter(struct fixture *f, picture_fn paint, double luminance)
{
    struct exposure exposure = make_exposure(f);
    struct gpu_texture radiance = fixture_paint(f, WIDTH, HEIGHT, paint, &luminance);
    const double ev100 = update(&exposure, &radiance, 0);
    gpu_texture_finish(&radiance);
    exposure_finish(&exposure);
    return ev100;
}

static void even_pictures_get_the_ev_of_a_reflected_light_meter(void **state)
{
    // L = K 2^EV / S with K = 12.5, S = 100 (ISO 2720): EV100 = log2(8 L).
    assert_true(fabs(meter(*state, paint_even, 4000) - log2(32000)) < EV_TOLERANCE);
    assert_true(fabs(meter(*state, paint_even, 4) - log2(32)) < EV_TOLERANCE);
}

static void black_space_does_not_count(void **state)
{
    assert_true(fabs(meter(*state, paint_planet, 1000) - log2(8000)) < EV_TOLERANCE);
}

static void the_suns_disc_does_not_dominate(void **state)
{
    // It covers 38 of 147456 pixels, counts as a wall of 3.4 stops more than the sky, with 3.2
    // times its weight.
    assert_true(fabs(meter(*state, paint_sun, 0) - log2(32000)) < 0.01);
}

static void a_crescent_is_exposed_for_its_day_side(void **state)
{
    // The night has the weight 49 * sqrt(1e-4 / 1000) = 1.5 % and lies 23 stops lower.
    assert_true(fabs(meter(*state, paint_crescent, 0) - log2(8000)) < 0.5);
}

static void night_is_darker_than_day_but_not_black(void **state)
{
    const double dusk = meter(*state, paint_even, 0.1), night = meter(*state, paint_even, 1e-4);
    const double dusk_stops = dusk - log2(8 * 0.1), night_stops = night - log2(8 * 1e-4);
    assert_true(dusk_stops > 0.5 && dusk_stops < night_stops);
    assert_true(night_stops < 5); // of the metered mean at 18 %: above 2 codes of 255
    assert_true(fabs(meter(*state, paint_even, 1e-9) + 10) < EV_TOLERANCE); // the least
}

static void pictures_without_light_have_an_exposure(void **state)
{
    assert_true(meter(*state, paint_even, 0) == 15);
    assert_true(meter(*state, paint_even, -1e-3) == 15); // out of gamut, nothing to see
}

static void tiny_pictures_are_metered(void **state)
{
    struct fixture *f = *state;
    const double luminance = 100;
    struct exposure exposure = make_exposure(f);
    struct gpu_texture radiance = fixture_paint(f, 1, 1, paint_even, &luminance);
    assert_true(fabs(update(&exposure, &radiance, 0) - log2(800)) < EV_TOLERANCE);
    gpu_texture_finish(&radiance);
    exposure_finish(&exposure);
}

static void adaptation_takes_a_second_whatever_the_frame_rate(void **state)
{
    struct fixture *f = *state;
    const double dark = 8, bright = 8192;
    struct gpu_texture before = fixture_paint(f, 64, 64, paint_even, &dark);
    struct gpu_texture after = fixture_paint(f, 64, 64, paint_even, &bright);
    struct exposure slow = make_exposure(f), fast = make_exposure(f);
    assert_true(fabs(update(&slow, &before, 0.02) - 6) < EV_TOLERANCE); // the first frame: at once
    assert_true(fabs(update(&fast, &before, 0.02) - 6) < EV_TOLERANCE);
    double fast_ev = 0;
    for (int i = 0; i < 50; i++) {
        const double ev = update(&fast, &after, 0.02);
        assert_true(ev > fast_ev);
        fast_ev = ev;
    }
    const double slow_ev = update(&slow, &after, 1);
    assert_true(fabs(slow_ev - fast_ev) < EV_TOLERANCE);
    assert_true(slow_ev > 15 && slow_ev < 16); // 90 % of ten stops at least
    assert_true(fabs(update(&slow, &after, 0) - 16) < EV_TOLERANCE);
    exposure_finish(&slow);
    exposure_finish(&fast);
    gpu_texture_finish(&before);
    gpu_texture_finish(&after);
}

static void fixed_exposure_is_what_was_asked_for(void **state)
{
    struct fixture *f = *state;
    const double luminance = 4000;
    struct gpu_texture radiance = fixture_paint(f, 64, 64, paint_even, &luminance);
    struct exposure exposure = make_exposure(f);
    const struct exposure_request request = {.is_fixed = true, .ev100 = 9.5, .bias_ev = 1};
    assert_int_equal(exposure_update(&exposure, &request, &radiance), TRL_OK);
    double ev100 = NAN;
    assert_int_equal(exposure_read(&exposure, &ev100), TRL_OK);
    assert_true(ev100 == 9.5);
    float value[2];
    const struct gpu_region all = gpu_texture_region(exposure_value(&exposure), 0);
    assert_int_equal(gpu_texture_read(exposure_value(&exposure), &all, value), TRL_OK);
    assert_true(fabs((double)value[1] * 1.2 * exp2(8.5) - 1) < 1e-6); // a float's rounding
    const double next = update(&exposure, &radiance, 0.1); // automatic again: goes on from there
    assert_true(next > 9.5 && next < log2(32000));
    exposure_finish(&exposure);
    gpu_texture_finish(&radiance);
}

static void bias_changes_the_picture_and_not_the_ev(void **state)
{
    struct fixture *f = *state;
    const double luminance = 4000;
    struct gpu_texture radiance = fixture_paint(f, 64, 64, paint_even, &luminance);
    struct exposure exposure = make_exposure(f);
    const struct exposure_request request = {.bias_ev = 2};
    assert_int_equal(exposure_update(&exposure, &request, &radiance), TRL_OK);
    float value[2];
    const struct gpu_region all = gpu_texture_region(exposure_value(&exposure), 0);
    assert_int_equal(gpu_texture_read(exposure_value(&exposure), &all, value), TRL_OK);
    assert_true(fabs((double)value[0] - log2(32000)) < EV_TOLERANCE);
    // 4 times the metered mean of 0.125 / 1.2, within the tolerance of the EV
    assert_true(fabs((double)value[1] * luminance / (4 * 0.125 / 1.2) - 1) < EV_TOLERANCE);
    exposure_finish(&exposure);
    gpu_texture_finish(&radiance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(even_pictures_get_the_ev_of_a_reflected_light_meter),
        cmocka_unit_test(black_space_does_not_count),
        cmocka_unit_test(the_suns_disc_does_not_dominate),
        cmocka_unit_test(a_crescent_is_exposed_for_its_day_side),
        cmocka_unit_test(night_is_darker_than_day_but_not_black),
        cmocka_unit_test(pictures_without_light_have_an_exposure),
        cmocka_unit_test(tiny_pictures_are_metered),
        cmocka_unit_test(adaptation_takes_a_second_whatever_the_frame_rate),
        cmocka_unit_test(fixed_exposure_is_what_was_asked_for),
        cmocka_unit_test(bias_changes_the_picture_and_not_the_ev),
    };
    return cmocka_run_group_tests_name("exposure", tests, fixture_set_up_gpu, fixture_tear_down);
}
