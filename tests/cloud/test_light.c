// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds are as bright as paths say: within what the law of light inside them is off.
#include "../frame/fixture.h"
#include <terrella/reference.h>
#include <terrella/renderer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// What is drawn is averaged over the pixels of what is traced.
enum { WIDTH = 12, HEIGHT = 8, FINE = 4, PATHS = 32, PIXELS = WIDTH * HEIGHT };
static const double DEGREE = 3.14159265358979323846 / 180;

static const char SCENE[] =
    "{\"terrella\": 1, \"name\": \"cloudy\","
    " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 0.27},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
    "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1e-5,"
    "   \"exponent\": -4}}, \"profile\": {\"exponential\": {\"scale_height_m\": 8000}},"
    "  \"phase\": \"rayleigh\"}]}, \"clouds\": {\"layers\": [%s]}}";

struct look {
    const char *name;
    double altitude_m, pitch_deg, sun_elevation_deg;
    double mean, pixel; // errors at most, of the mean and of a pixel, over the mean
};

static trl_view view_of(const struct look *look)
{
    trl_view view = trl_view_default();
    view.altitude_m = look->altitude_m;
    view.latitude_rad = 10 * DEGREE;
    view.pitch_rad = look->pitch_deg * DEGREE;
    view.vertical_fov_rad = 50 * DEGREE;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = look->sun_elevation_deg * DEGREE;
    view.sun_longitude_or_azimuth_rad = 90 * DEGREE;
    return view;
}

static double drawn_green(const float *rgba, int pixel)
{
    double sum = 0;
    for (int i = 0; i < FINE * FINE; i++) {
        const int x = pixel % WIDTH * FINE + i % FINE;
        const int y = pixel / WIDTH * FINE + i / FINE;
        sum += (double)rgba[4 * (y * WIDTH * FINE + x) + 1] / (FINE * FINE);
    }
    return sum;
}

static void check(const struct look *look, const float *drawn, const float *traced)
{
    double sum = 0;
    double all = 0;
    double error = 0;
    for (int i = 0; i < PIXELS; i++) {
        all += (double)traced[4 * i + 1] / PIXELS;
        sum += drawn_green(drawn, i) / PIXELS;
        error += fabs(drawn_green(drawn, i) - (double)traced[4 * i + 1]) / PIXELS;
    }
    print_message("%s: %.3f of what paths say, a pixel off by %.3f\n", look->name, sum / all,
                  error / all);
    assert_true(fabs(sum / all - 1) < look->mean);
    assert_true(error / all < look->pixel);
}

static void compare(struct fixture *f, const char *layer, const struct look *looks, int count)
{
    char text[2048];
    const int length = snprintf(text, sizeof text, SCENE, layer);
    trl_renderer_desc drawing = trl_renderer_desc_default();
    trl_reference_desc tracing = trl_reference_desc_default();
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, (size_t)length, "cloudy", ".", &scene), TRL_OK);
    drawing.scene = tracing.scene = scene;
    drawing.wavelengths = 4;
    tracing.paths = PATHS;
    trl_renderer *renderer = NULL;
    fixture_skip_without_gl(f, trl_renderer_create(f->ctx, &drawing, &renderer));
    for (int i = 0; i < count; i++) {
        static float drawn[4 * PIXELS * FINE * FINE], traced[4 * PIXELS];
        const trl_view view = view_of(&looks[i]);
        assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH * FINE, HEIGHT * FINE, 0),
                         TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(renderer, drawn), TRL_OK);
        assert_int_equal(trl_reference_render(f->ctx, &tracing, &view, WIDTH, HEIGHT, traced, NULL),
                         TRL_OK);
        check(&looks[i], drawn, traced);
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
}

// Of a pixel's error some 0.25 is noise of its paths.
static void cumulus_is_as_bright_as_paths_say(void **state)
{
    static const struct look LOOKS[] = {{"cumulus at sunset", 3000, -10, 4, 0.25, 0.5},
                                        {"cumulus at noon, from below", 2, 30, 60, 0.2, 0.8}};
    compare(*state, "{\"cover\": 0.5}", LOOKS, 2);
}

static void a_flat_deck_is_as_bright_as_paths_say(void **state)
{
    static const struct look LOOKS[] = {{"deck in the evening", 3000, -40, 10, 0.2, 0.8}};
    compare(*state, "{\"type\": \"stratus\", \"cover\": 1}", LOOKS, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(cumulus_is_as_bright_as_paths_say),
                                       cmocka_unit_test(a_flat_deck_is_as_bright_as_paths_say)};
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
