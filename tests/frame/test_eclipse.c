// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A body before the star: the formulas against plain sums, and pictures in its shadow.
#include "fixture.h"
#include "shared/eclipse.glsl"
#include <terrella/terrella.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 32 };
static const double STAR_RAD = 0.27 * SHARED_PI / 180;

// Share of a fine grid over the star's disc that the body does not cover.
static double count_visible(double apart, double radius)
{
    enum { GRID = 1000 };
    int all = 0;
    int seen = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        const double x = 2 * (i % GRID + 0.5) / GRID - 1;
        const double y = 2 * (i / GRID + 0.5) / GRID - 1;
        if (x * x + y * y < 1) {
            all++;
            seen += (x - apart) * (x - apart) + y * y > radius * radius;
        }
    }
    return (double)seen / all;
}

static void the_visible_part_is_that_of_counted_points(void **state)
{
    (void)state;
    static const double radii[] = {0.1, 0.9, 1, 1.05, 3, 20};
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++) {
        for (int k = -5; k <= 5; k++) {
            const double apart = fabs(radii[i] + 0.23 * k);
            // A million points miss a disc's edge by about 1e-4 of the area.
            assert_true(fabs(eclipse_visible(apart, radii[i]) - count_visible(apart, radii[i])) <
                        5e-4);
        }
        assert_true(eclipse_visible(1 + radii[i], radii[i]) == 1);
    }
    assert_true(eclipse_visible(0.04, 1.05) == 0);
    assert_true(fabs(eclipse_visible(0.05, 0.9) - 0.19) < 1e-12);
}

static void the_umbra_is_as_wide_as_its_cone(void **state)
{
    (void)state;
    // Tangents to both: the sine of the cone's angle is that of the star's radius.
    const double along_m = 3.5693e8;
    const double umbra_m = 1737400 / cos(STAR_RAD) - along_m * tan(STAR_RAD);
    assert_true(umbra_m > 0);
    assert_true(eclipse_shadow(0.999 * umbra_m, along_m, 1737400, STAR_RAD) == 0);
    assert_true(eclipse_shadow(1.01 * umbra_m, along_m, 1737400, STAR_RAD) > 0);
    const double penumbra_m = 1737400 / cos(STAR_RAD) + along_m * tan(STAR_RAD);
    assert_true(eclipse_shadow(0.9999 * penumbra_m, along_m, 1737400, STAR_RAD) < 1);
    assert_true(eclipse_shadow(1.0001 * penumbra_m, along_m, 1737400, STAR_RAD) == 1);
}

// A black moon: nothing of it is seen but its shadow.
static const char WITH_MOON[] =
    ", \"bodies\": [{\"name\": \"Moon\", \"radius_m\": 1737400, \"distance_m\": 363300000,"
    " \"geometric_albedo\": 0}], \"views\": {\"view\": {\"camera\": {\"latitude_deg\": 0,"
    " \"longitude_deg\": 0, \"altitude_m\": %s, \"pitch_deg\": %s, \"vertical_fov_deg\": 60},"
    " \"sun\": {\"elevation_deg\": 50, \"azimuth_deg\": 90}, \"bodies\": {%s}}}%s}";

struct place {
    const char *altitude_m, *pitch_deg, *moon;
    bool has_clouds;
};

static void draw(const struct fixture *f, const struct place *place, float *rgba)
{
    static const char sphere[] =
        "{\"terrella\": 1, \"name\": \"sphere\","
        " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
        " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
        " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
        "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1e-5,"
        "   \"exponent\": -4}},"
        "  \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"rayleigh\"}]}";
    char text[4096];
    const int begun = snprintf(text, sizeof text, "%s", sphere);
    snprintf(text + begun, sizeof text - (size_t)begun, WITH_MOON, place->altitude_m,
             place->pitch_deg, place->moon,
             place->has_clouds
                 ? ", \"clouds\": {\"layers\": [{\"type\": \"stratus\", \"cover\": 1}]}"
                 : "");
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "moon", "/nonexistent", &scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    trl_renderer *renderer = NULL;
    const trl_result result = trl_renderer_create(f->ctx, &desc, &renderer);
    fixture_skip_without_gl(f, result);
    trl_view view = trl_view_default();
    assert_int_equal(trl_scene_view(scene, "view", &view), TRL_OK);
    assert_int_equal(trl_renderer_draw(renderer, &view, SIDE, SIDE, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, rgba), TRL_OK);
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
    for (int i = 0; i < 4 * SIDE * SIDE; i++) {
        assert_true(isfinite(rgba[i]));
    }
}

static double mean_green(const float *rgba)
{
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        sum += (double)rgba[4 * i + 1];
    }
    return sum / (SIDE * SIDE);
}

static void a_moon_elsewhere_changes_no_bit_and_before_the_star_makes_night(void **state)
{
    static float none[4 * SIDE * SIDE];
    static float moon[4 * SIDE * SIDE];
    // From the ground within the umbra; from high above all of the penumbra; within the umbra from
    // above a deck of clouds, and from below it.
    static const struct place places[][2] = {
        {{"2", "0", "\"Moon\": {\"elevation_deg\": -50, \"azimuth_deg\": 270}", false},
         {"2", "0", "\"Moon\": {\"offset_from_sun_deg\": [0, 0]}", false}},
        {{"20000000", "-90", "\"Moon\": {\"latitude_deg\": 0, \"longitude_deg\": -140}", false},
         {"20000000", "-90", "\"Moon\": {\"latitude_deg\": 0, \"longitude_deg\": 40}", false}},
        {{"4000", "-60", "\"Moon\": {\"elevation_deg\": -50, \"azimuth_deg\": 270}", true},
         {"4000", "-60", "\"Moon\": {\"offset_from_sun_deg\": [0, 0]}", true}},
        {{"2", "60", "\"Moon\": {\"elevation_deg\": -50, \"azimuth_deg\": 270}", true},
         {"2", "60", "\"Moon\": {\"offset_from_sun_deg\": [0, 0]}", true}},
    };
    static const double most[] = {0.01, 0.99, 0.01, 0.01};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        struct place place = places[i][0];
        draw(*state, &place, moon);
        place.moon = "";
        draw(*state, &place, none);
        assert_memory_equal(none, moon, sizeof none);
        draw(*state, &places[i][1], moon);
        const double share = mean_green(moon) / mean_green(none);
        assert_true(share < most[i] && share > 1e-6);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_visible_part_is_that_of_counted_points),
        cmocka_unit_test(the_umbra_is_as_wide_as_its_cone),
        cmocka_unit_test(a_moon_elsewhere_changes_no_bit_and_before_the_star_makes_night),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
