// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// An atmosphere changed while frames are drawn: never a wait, and in the end the same picture as a
// renderer that was made for it.
#include "fixture.h"
#include <terrella/renderer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { WIDTH = 24, HEIGHT = 16, PIXELS = WIDTH * HEIGHT };

static const char SCENE[] =
    "{\"terrella\": 1, \"name\": \"hazy\","
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": ["
    "  {\"name\": \"air\", \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": %s,"
    "    \"exponent\": -4}}, \"profile\": {\"exponential\": {\"scale_height_m\": 8000}},"
    "   \"phase\": \"rayleigh\"},"
    "  {\"name\": \"haze\", \"scattering_per_m\": 2e-5, \"profile\":"
    "   {\"exponential\": {\"scale_height_m\": 1500}}, \"phase\":"
    "   {\"henyey_greenstein\": {\"g\": %s}}}]}}";

static trl_scene *make_scene(const struct fixture *f, const char *scattering, const char *g)
{
    char text[sizeof SCENE + 32];
    snprintf(text, sizeof text, SCENE, scattering, g);
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "hazy", "/nonexistent", &scene),
                     TRL_OK);
    return scene;
}

static trl_renderer *make_renderer(const struct fixture *f, const trl_scene *scene)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    trl_renderer *renderer = NULL;
    const trl_result result = trl_renderer_create(f->ctx, &desc, &renderer);
    fixture_skip_without_gl(f, result);
    assert_int_equal(result, TRL_OK);
    return renderer;
}

// Sky with the sun in it, from the ground.
static void draw(trl_renderer *renderer, float *rgba)
{
    trl_view view = trl_view_default();
    view.altitude_m = 10;
    view.pitch_rad = 0.5;
    view.vertical_fov_rad = 1;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.5;
    view.sun_longitude_or_azimuth_rad = 0.2;
    assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, rgba), TRL_OK);
    for (int i = 0; i < 4 * PIXELS; i++) {
        assert_true(isfinite(rgba[i]));
    }
}

// Mean of the pixels' relative differences in green.
static double difference(const float *a, const float *b)
{
    double sum = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double mine = (double)a[4 * i + 1];
        const double other = (double)b[4 * i + 1];
        sum += fabs(mine - other) / fmax(other, 1e-6);
    }
    return sum / PIXELS;
}

static void settle(trl_renderer *renderer, float *rgba)
{
    // No change takes a minute, even under a sanitizer beside other work; the test's own limit is
    // two.
    const time_t begun = time(NULL);
    while (!trl_renderer_is_settled(renderer)) {
        assert_true(time(NULL) - begun < 90);
        draw(renderer, rgba);
    }
    draw(renderer, rgba);
}

static void a_changed_amount_becomes_the_picture_of_its_own_scene(void **state)
{
    struct fixture *f = *state;
    trl_scene *scene = make_scene(f, "1e-5", "0.7");
    trl_scene *doubled = make_scene(f, "2e-5", "0.7");
    trl_renderer *renderer = make_renderer(f, scene);
    trl_renderer *wanted = make_renderer(f, doubled);
    float got[4 * PIXELS];
    float before[4 * PIXELS];
    float expected[4 * PIXELS];
    draw(renderer, before);
    draw(wanted, expected);
    assert_true(trl_renderer_is_settled(renderer));
    const trl_constituent_change change = {0, 2, (double)NAN};
    assert_int_equal(trl_renderer_change_atmosphere(renderer, scene, &change, 1), TRL_OK);
    assert_false(trl_renderer_is_settled(renderer));
    settle(renderer, got);
    assert_true(difference(before, expected) > 0.1);
    // The same numbers by another way through floats.
    assert_true(difference(got, expected) < 1e-4);
    // The scene of a file that was edited: the same again, without changes.
    assert_int_equal(trl_renderer_change_atmosphere(renderer, scene, NULL, 0), TRL_OK);
    assert_int_equal(trl_renderer_change_atmosphere(renderer, doubled, NULL, 0), TRL_OK);
    settle(renderer, got);
    assert_true(difference(got, expected) < 1e-4);
    trl_renderer_destroy(&wanted);
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&doubled);
    trl_scene_destroy(&scene);
}

static void another_asymmetry_shows_at_the_next_draw(void **state)
{
    struct fixture *f = *state;
    trl_scene *scene = make_scene(f, "1e-5", "0.5");
    trl_scene *sharp = make_scene(f, "1e-5", "0.8");
    trl_renderer *renderer = make_renderer(f, scene);
    trl_renderer *wanted = make_renderer(f, sharp);
    float before[4 * PIXELS];
    float at_once[4 * PIXELS];
    float expected[4 * PIXELS];
    draw(renderer, before);
    draw(wanted, expected);
    const trl_constituent_change change = {1, 1, 0.8};
    assert_int_equal(trl_renderer_change_atmosphere(renderer, scene, &change, 1), TRL_OK);
    draw(renderer, at_once); // a draft may be done already, which is nearer still
    assert_true(difference(before, expected) > 0.1);
    // Thin haze: its second order, which still has the old asymmetry, is a few percent.
    assert_true(difference(at_once, expected) < 0.05);
    trl_renderer_destroy(&wanted); // and one that still solves
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&sharp);
    trl_scene_destroy(&scene);
}

static void changes_out_of_range_are_refused(void **state)
{
    struct fixture *f = *state;
    trl_scene *scene = make_scene(f, "1e-5", "0.5");
    trl_renderer *renderer = make_renderer(f, scene);
    const double nan = (double)NAN;
    const trl_constituent_change wrong[] = {{2, 1, nan},      {0, -1, nan}, {0, nan, nan},
                                            {0, 1e7, nan},    {1, 1, 1},    {1, 1, -1},
                                            {1, 1, INFINITY}, {0, 1, 0.5}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        fixture_expect_error(f, trl_renderer_change_atmosphere(renderer, scene, &wrong[i], 1),
                             TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT);
    }
    fixture_expect_error(f, trl_renderer_change_atmosphere(renderer, NULL, NULL, 0),
                         TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT);
    fixture_expect_error(f, trl_renderer_change_atmosphere(renderer, scene, NULL, 1),
                         TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT);
    assert_int_equal(trl_renderer_change_atmosphere(NULL, scene, NULL, 0), TRL_ERROR_INVALID);
    assert_true(trl_renderer_is_settled(renderer));
    assert_int_equal(trl_scene_constituent_count(scene), 2);
    assert_string_equal(trl_scene_constituent_name(scene, 1), "haze");
    assert_null(trl_scene_constituent_name(scene, 2));
    assert_true(isnan(trl_scene_constituent_asymmetry(scene, 0)));
    assert_true(trl_scene_constituent_asymmetry(scene, 1) == 0.5);
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_changed_amount_becomes_the_picture_of_its_own_scene,
                                        fixture_set_up, fixture_tear_down),
        cmocka_unit_test_setup_teardown(another_asymmetry_shows_at_the_next_draw, fixture_set_up,
                                        fixture_tear_down),
        cmocka_unit_test_setup_teardown(changes_out_of_range_are_refused, fixture_set_up,
                                        fixture_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
