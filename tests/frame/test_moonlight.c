// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Light of a body on ground and air: that of the star, scaled, from another direction.
#include "fixture.h"
#include "sky/body_light.h"
#include <terrella/terrella.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
enum { WIDTH = 64, HEIGHT = 48, VALUES = 3 * WIDTH * HEIGHT };
static const double RADIUS_M = 1737400, DISTANCE_M = 384400000;

struct planet {
    trl_scene *scene;
    trl_renderer *renderer;
};

struct setup {
    struct fixture *f;
    struct planet flat;     // the star has no colour
    struct planet reddened; // it is as red as the second body
    struct planet cloudy;   // the first, with clouds
};

static const char RED[] = "[[450, 0.1], [650, 0.137]]";

static const char CLOUDS[] = ", \"clouds\": {\"layers\": [{\"cover\": 0.5}]}";

static trl_result make_planet(struct fixture *f, const char *star, const char *clouds,
                              struct planet *out)
{
    char text[2048];
    snprintf(text, sizeof text,
             "{\"terrella\": 1, \"name\": \"planet\","
             " \"star\": {\"spectral_irradiance\": %s, \"angular_radius_deg\": 0.27},"
             " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.2},"
             " \"atmosphere\": {\"height_m\": 60000, \"constituents\": ["
             "  {\"name\": \"air\", \"scattering_per_m\": {\"power_law\":"
             "    {\"at_nm\": 550, \"value\": 1.2e-5, \"exponent\": -4}},"
             "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}},"
             "   \"phase\": \"rayleigh\"},"
             "  {\"name\": \"haze\", \"scattering_per_m\": 5e-5,"
             "   \"profile\": {\"exponential\": {\"scale_height_m\": 1200}},"
             "   \"phase\": {\"henyey_greenstein\": {\"g\": 0.7}}}]},"
             " \"bodies\": ["
             "  {\"name\": \"Grey\", \"radius_m\": %.10g, \"distance_m\": %.10g,"
             "   \"geometric_albedo\": 0.1},"
             "  {\"name\": \"Red\", \"radius_m\": %.10g, \"distance_m\": %.10g,"
             "   \"geometric_albedo\": %s}]%s}",
             star, RADIUS_M, DISTANCE_M, RADIUS_M, DISTANCE_M, RED, clouds);
    assert_int_equal(
        trl_scene_parse(f->ctx, text, strlen(text), "planet", "/nonexistent", &out->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = out->scene;
    desc.air = TRL_AIR_TABLE; // only the star's has shadows
    const trl_result result = trl_renderer_create(f->ctx, &desc, &out->renderer);
    fixture_skip_without_gl(f, result);
    return result;
}

static int set_up(void **state)
{
    void *f = NULL;
    struct setup *s = calloc(1, sizeof *s);
    *state = s;
    if (!s || fixture_set_up(&f)) {
        return 1;
    }
    s->f = f;
    return make_planet(s->f, "1", "", &s->flat) != TRL_OK ||
           make_planet(s->f, RED, "", &s->reddened) != TRL_OK ||
           make_planet(s->f, "1", CLOUDS, &s->cloudy) != TRL_OK;
}

static void finish(struct planet *planet)
{
    trl_renderer_destroy(&planet->renderer);
    trl_scene_destroy(&planet->scene);
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    finish(&s->flat);
    finish(&s->reddened);
    finish(&s->cloudy);
    void *f = s->f;
    free(s);
    return fixture_tear_down(&f);
}

// Sky and ground toward the east; star and body are outside the picture.
static trl_view make_view(double sun_deg, double altitude_m)
{
    trl_view view = trl_view_default();
    view.altitude_m = altitude_m;
    view.heading_rad = PI / 2;
    view.pitch_rad = altitude_m > 1e5 ? -0.35 : 0.05;
    view.vertical_fov_rad = 0.8;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = sun_deg * PI / 180;
    view.sun_longitude_or_azimuth_rad = PI;
    return view;
}

enum body { GREY, RED_ONE };

static void place_body(trl_view *view, enum body body, double elevation_deg)
{
    view->bodies[body] = (trl_body_place){TRL_BODY_LOCAL, elevation_deg * PI / 180, PI, 0};
}

// Of the star's light that comes from a body of albedo 1 at this angle from the star.
static double find_share(double elevation_deg, double sun_deg)
{
    const double eye_m = 6371000, mu = sin(elevation_deg * PI / 180);
    const double way_m = sqrt(DISTANCE_M * DISTANCE_M - eye_m * eye_m * (1 - mu * mu)) - eye_m * mu;
    const double phase_rad = PI - (elevation_deg - sun_deg) * PI / 180;
    return pow(RADIUS_M / way_m, 2) * body_phase(BODY_LOMMEL_SEELIGER, phase_rad);
}

static void draw(const struct planet *planet, const trl_view *view, double rgb[VALUES])
{
    static float rgba[4 * WIDTH * HEIGHT];
    assert_int_equal(trl_renderer_draw(planet->renderer, view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(planet->renderer, rgba), TRL_OK);
    for (int i = 0; i < VALUES; i++) {
        rgb[i] = (double)rgba[4 * (i / 3) + i % 3];
    }
}

// Largest difference, relative to the pixel's largest component, and its mean.
struct difference {
    double largest, mean;
};

static struct difference compare(const double a[VALUES], const double b[VALUES])
{
    struct difference d = {0, 0};
    for (int i = 0; i < VALUES; i++) {
        const double *p = b + i / 3 * 3;
        const double off = fabs(a[i] - b[i]) / fmax(fmax(p[0], 1e-12), fmax(p[1], p[2]));
        d.largest = fmax(d.largest, off);
        d.mean += off / VALUES;
    }
    return d;
}

// The same picture under the star, in the place of the bodies, times the body's share.
static void expect_moonlit(const struct planet *planet, const trl_view *view, double scale,
                           double rgb[VALUES])
{
    trl_view sunlit = *view;
    for (int i = 0; i < 2; i++) {
        if (view->bodies[i].mode != TRL_BODY_ABSENT) {
            sunlit.sun_latitude_or_elevation_rad = view->bodies[i].latitude_or_elevation_rad;
        }
        sunlit.bodies[i].mode = TRL_BODY_ABSENT;
    }
    draw(planet, &sunlit, rgb);
    for (int i = 0; i < VALUES; i++) {
        rgb[i] *= scale;
    }
}

// Floats add up. From orbit the body is seen in another direction than from below: up to half a
// degree.
static void moonlight_is_sunlight_scaled(void **state)
{
    const struct setup *s = *state;
    static double got[VALUES], wanted[VALUES];
    const double elevations_deg[] = {50, 12}, altitudes_m[] = {10, 400000};
    for (int i = 0; i < 4; i++) {
        trl_view view = make_view(-70, altitudes_m[i / 2]);
        place_body(&view, GREY, elevations_deg[i % 2]);
        draw(&s->flat, &view, got);
        expect_moonlit(&s->flat, &view, 0.1 * find_share(elevations_deg[i % 2], -70), wanted);
        assert_true(compare(got, wanted).largest < (i < 2 ? 1e-4 : 0.02));
    }
}

// From below and from above: clouds, and their shade on the ground.
static void moonlit_clouds_are_sunlit_ones_scaled(void **state)
{
    const struct setup *s = *state;
    static double got[VALUES], wanted[VALUES], clear[VALUES];
    const double altitudes_m[] = {10, 4000};
    for (int i = 0; i < 2; i++) {
        trl_view view = make_view(-70, altitudes_m[i]);
        view.pitch_rad = i == 0 ? 0.1 : -0.4;
        place_body(&view, GREY, 50);
        draw(&s->cloudy, &view, got);
        draw(&s->flat, &view, clear);
        expect_moonlit(&s->cloudy, &view, 0.1 * find_share(50, -70), wanted);
        assert_true(compare(got, wanted).largest < 1e-3);
        assert_true(compare(clear, wanted).mean > 0.2); // or there are none
    }
}

static void light_of_star_and_body_add_up(void **state)
{
    const struct setup *s = *state;
    static double got[VALUES], star[VALUES], wanted[VALUES];
    trl_view view = make_view(-9, 10);
    draw(&s->flat, &view, star);
    place_body(&view, GREY, 60);
    draw(&s->flat, &view, got);
    expect_moonlit(&s->flat, &view, 0.1 * find_share(60, -9), wanted);
    for (int i = 0; i < VALUES; i++) {
        wanted[i] += star[i];
    }
    assert_true(compare(got, wanted).largest < 1e-5);
    assert_true(compare(star, wanted).largest > 0.05);
}

static void by_day_moonlight_is_left_out(void **state)
{
    const struct setup *s = *state;
    static double got[VALUES], wanted[VALUES];
    trl_view view = make_view(30, 10);
    draw(&s->flat, &view, wanted);
    place_body(&view, GREY, 80);
    draw(&s->flat, &view, got);
    assert_memory_equal(got, wanted, sizeof got);
}

// The air's light is scaled as a colour, where each wavelength has a factor of its own: measured
// 0.3 % in the mean, 1 % at most.
static void moonlight_has_the_colour_of_the_body(void **state)
{
    const struct setup *s = *state;
    static double got[VALUES], wanted[VALUES];
    const double elevations_deg[] = {60, 30, 8};
    for (int i = 0; i < 3; i++) {
        trl_view view = make_view(-70, 10);
        place_body(&view, RED_ONE, elevations_deg[i]);
        draw(&s->flat, &view, got);
        expect_moonlit(&s->reddened, &view, find_share(elevations_deg[i], -70), wanted);
        const struct difference d = compare(got, wanted);
        assert_true(d.largest < 0.02 && d.mean < 0.005);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(moonlight_is_sunlight_scaled),
        cmocka_unit_test(moonlit_clouds_are_sunlit_ones_scaled),
        cmocka_unit_test(light_of_star_and_body_add_up),
        cmocka_unit_test(by_day_moonlight_is_left_out),
        cmocka_unit_test(moonlight_has_the_colour_of_the_body),
    };
    return cmocka_run_group_tests_name("moonlight", tests, set_up, tear_down);
}
