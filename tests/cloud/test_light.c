// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds are as bright as paths, and flat ones as two streams, say: within what the law of light
// inside them is off.
#include "../frame/fixture.h"
#include "scene.h"
#include "shared/cloud.glsl"
#include <terrella/reference.h>
#include <terrella/renderer.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

// What is drawn is averaged over the pixels of what is traced.
enum { WIDTH = 12, HEIGHT = 8, FINE = 4, PATHS = 32, PIXELS = WIDTH * HEIGHT };
static const double DEGREE = 3.14159265358979323846 / 180;

static const char SCENE[] = CLOUD_SCENE ", \"clouds\": {\"layers\": [%s]}}";

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

// A scene, and both ways to see it.
struct judge {
    struct fixture *fixture;
    trl_scene *scene;
    trl_renderer *renderer;
    float drawn[4 * PIXELS * FINE * FINE], traced[4 * PIXELS];
};

static void start(struct judge *j, struct fixture *f, const char *layer)
{
    char text[2048];
    const int length = snprintf(text, sizeof text, SCENE, layer);
    trl_renderer_desc drawing = trl_renderer_desc_default();
    *j = (struct judge){.fixture = f};
    assert_int_equal(trl_scene_parse(f->ctx, text, (size_t)length, "cloudy", ".", &j->scene),
                     TRL_OK);
    drawing.scene = j->scene;
    drawing.wavelengths = 4;
    fixture_skip_without_gl(f, trl_renderer_create(f->ctx, &drawing, &j->renderer));
}

static void see(struct judge *j, const trl_view *view)
{
    trl_reference_desc tracing = trl_reference_desc_default();
    tracing.scene = j->scene;
    tracing.paths = PATHS;
    assert_int_equal(trl_renderer_draw(j->renderer, view, WIDTH * FINE, HEIGHT * FINE, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(j->renderer, j->drawn), TRL_OK);
    assert_int_equal(
        trl_reference_render(j->fixture->ctx, &tracing, view, WIDTH, HEIGHT, j->traced, NULL),
        TRL_OK);
}

static void finish(struct judge *j)
{
    trl_renderer_destroy(&j->renderer);
    trl_scene_destroy(&j->scene);
}

static void compare(struct fixture *f, const char *layer, const struct look *looks, int count)
{
    static struct judge j;
    start(&j, f, layer);
    for (int i = 0; i < count; i++) {
        const trl_view view = view_of(&looks[i]);
        see(&j, &view);
        check(&looks[i], j.drawn, j.traced);
    }
    finish(&j);
}

// Of a pixel's error some 0.25 is noise of its paths.
static void cumulus_is_as_bright_as_paths_say(void **state)
{
    static const struct look LOOKS[] = {{"cumulus at sunset", 3000, -10, 4, 0.25, 0.5},
                                        {"cumulus at noon, from below", 2, 30, 60, 0.2, 0.8}};
    compare(*state, "{\"cover\": 0.5}", LOOKS, 2);
}

// Too dark by a third, as in two streams below.
static void a_flat_deck_is_as_bright_as_paths_say(void **state)
{
    static const struct look LOOKS[] = {{"deck in the evening", 3000, -40, 10, 0.4, 0.8}};
    compare(*state, "{\"type\": \"stratus\", \"cover\": 1}", LOOKS, 1);
}

// Between clouds and below them, with the star's light that comes from their sides and through
// them. Places are off by a fifth, as clouds stand; in the mean of ten that is little. Cumulus is
// 0.91 of paths, the deck 0.93, and 0.64 with depths toward the star.
static void compare_ground(struct fixture *f, const char *layer, double sun_elevation_deg)
{
    enum { PLACES = 10 };
    static struct judge j;
    start(&j, f, layer);
    const struct look look = {
        .altitude_m = 300, .pitch_deg = -90, .sun_elevation_deg = sun_elevation_deg};
    double drawn = 0, traced = 0;
    for (int i = 0; i < PLACES; i++) {
        trl_view view = view_of(&look);
        view.longitude_rad = 0.02 * i; // 125 km
        see(&j, &view);
        for (int k = 0; k < PIXELS; k++) {
            drawn += drawn_green(j.drawn, k);
            traced += (double)j.traced[4 * k + 1];
        }
    }
    print_message("ground has %.3f of the light that paths say\n", drawn / traced);
    assert_true(fabs(drawn / traced - 1) < 0.15);
    finish(&j);
}

static void ground_under_clouds_is_as_bright_as_paths_say(void **state)
{
    compare_ground(*state, "{\"cover\": 0.8}", 60);
    compare_ground(*state, "{\"type\": \"stratus\", \"cover\": 1}", 10);
}

// How full a box of a side of 1/4 is, whose middle is at a height in a layer that is full.
static double fullness(double height)
{
    return fmin(fmax((1.125 - height) / 0.25, 0), 1) * fmin(fmax((height + 0.125) / 0.25, 0), 1);
}

// Radiance straight up from a flat deck without gaps, per irradiance, by the law.
static double deck_by_law(double depth, double sun_mu)
{
    enum { STEPS = 400 };
    double sum = 0, left = 1;
    for (int i = 0; i < STEPS; i++) {
        const double height = 1 - (i + 0.5) / STEPS, step = depth / STEPS;
        const struct CloudAround around = {.side = CLOUD_DIFFUSE_DEPTH * depth / 4,
                                           .whole = CLOUD_DIFFUSE_DEPTH * depth,
                                           .above = fullness(height + 0.25),
                                           .below = fullness(height - 0.25),
                                           .cover = 1};
        const double toward_star = (1 - height) * depth / sun_mu;
        const double once = cloud_phase(-sun_mu, 1) * exp(-toward_star);
        sum += left * (1 - exp(-step)) *
               (once +
                cloud_several(around, cloud_phase(-sun_mu, CLOUD_TURNED), sun_mu, toward_star, 0));
        left *= exp(-step);
    }
    return sum;
}

// Albedo by delta-Eddington without absorption: Meador and Weaver 1980 (J. Atmos. Sci. 37), Eq. 24
// and Table 1, scaled as Joseph, Wiscombe and Weinman 1976.
static double albedo_by_two_streams(double depth, double sun_mu)
{
    const double g = CLOUD_FORWARD_G * (1 - CLOUD_BACK_SHARE) + CLOUD_BACK_G * CLOUD_BACK_SHARE;
    const double narrow = g / (1 + g), t = (1 - g * g) * depth;
    const double gamma1 = 0.75 * (1 - narrow), gamma3 = (2 - 3 * narrow * sun_mu) / 4;
    return (gamma1 * t + (gamma3 - gamma1 * sun_mu) * (1 - exp(-t / sun_mu))) / (1 + gamma1 * t);
}

// The radiance of an even face.
static double deck_by_two_streams(double depth, double sun_mu)
{
    return albedo_by_two_streams(depth, sun_mu) * sun_mu / 3.14159265358979323846;
}

// A deck without gaps, for which both are the same but for a thin one's peak forward.
static void a_closed_deck_lets_through_what_two_streams_do(void **state)
{
    (void)state;
    static const double depths[] = {12, 24, 48}, suns[] = {0.05, 0.25, 0.5, 0.75, 0.95};
    for (size_t i = 0; i < 3; i++) {
        const double through = cloud_through(1 / (1 + CLOUD_DIFFUSE_DEPTH * depths[i]), 1, 0.6);
        for (size_t k = 0; k < 5; k++) {
            const double part = cloud_star_through(through, 1, suns[k]);
            const double streams = 1 - albedo_by_two_streams(depths[i], suns[k]);
            assert_true(fabs(part / streams - 1) < 0.02);
        }
    }
}

// One law for all kinds of layers, and straight up, where a low star leaves less than elsewhere: it
// is 0.67 to 1.02 of two streams.
static void a_flat_deck_is_as_bright_as_two_streams_say(void **state)
{
    (void)state;
    static const double depths[] = {12, 24, 48}, suns[] = {0.25, 0.5, 0.75, 0.95};
    for (size_t i = 0; i < 3; i++) {
        for (size_t k = 0; k < 4; k++) {
            const double law = deck_by_law(depths[i], suns[k]);
            const double streams = deck_by_two_streams(depths[i], suns[k]);
            print_message("depth %g, sine %g: %.3f of two streams\n", depths[i], suns[k],
                          law / streams);
            assert_true(fabs(law / streams - 1) < 0.35);
        }
    }
}

// As bright as exp(-|mu| / 0.2), less what makes the flux through level ground 0, times what makes
// the mean of all directions 1.
static double horizon_at(double mu)
{
    const double width = 0.2, edge = exp(-1 / width);
    const double mean = width * (1 - edge), flux = width * (width - (1 + width) * edge);
    return (exp(-fabs(mu) / width) - 2 * flux) / (mean - 2 * flux);
}

// Where light that is scattered once into a view comes from, in the mean: its part along the
// horizontal that the view points to, and how bright such a horizon is there.
static void scatter_once(double view_mu, double *along, double *level)
{
    enum { RINGS = 400, AZIMUTHS = 60 };
    const double pi = 180 * DEGREE, view_sine = sqrt(1 - view_mu * view_mu);
    *along = *level = 0;
    for (int i = 0; i < RINGS * AZIMUTHS; i++) {
        const double angle = (i / AZIMUTHS + 0.5) / RINGS * pi;
        const double around = (i % AZIMUTHS + 0.5) / AZIMUTHS * 2 * pi;
        const double part =
            cloud_phase(cos(angle), 1) * sin(angle) * 2 * pi * pi / ((double)RINGS * AZIMUTHS);
        const double side = sin(angle) * cos(around);
        *along += part * (cos(angle) * view_sine - side * view_mu);
        *level += part * horizon_at(cos(angle) * view_mu + side * view_sine);
    }
}

// Level ways are long in thin layers too, and further scatterings leave half of the horizon.
static void thin_layers_send_on_what_is_ahead(void **state)
{
    (void)state;
    for (int i = 0; i < 8; i++) {
        const double view_mu = 0.1 * i + 0.05;
        double along, level;
        scatter_once(view_mu, &along, &level);
        const double turned = cloud_turn(sqrt(1 - view_mu * view_mu), 0, 0);
        const double horizon = cloud_horizon(view_mu, 0, 0);
        print_message("sine %.2f: %.3f and %.3f along, %.2f and %.2f level\n", view_mu, turned,
                      along, horizon, level);
        assert_true(fabs(turned - along) < 0.05);
        assert_true(horizon > 0.5 * level && horizon < level + 0.3);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(thin_layers_send_on_what_is_ahead),
        cmocka_unit_test(cumulus_is_as_bright_as_paths_say),
        cmocka_unit_test(a_flat_deck_is_as_bright_as_paths_say),
        cmocka_unit_test(ground_under_clouds_is_as_bright_as_paths_say),
        cmocka_unit_test(a_closed_deck_lets_through_what_two_streams_do),
        cmocka_unit_test(a_flat_deck_is_as_bright_as_two_streams_say)};
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
