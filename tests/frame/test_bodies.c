// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Bodies in pictures: their light at each phase and size, their lit side, and what hides them.
#include "fixture.h"
#include "sky/body_light.h"
#include <terrella/terrella.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
enum { SIDE = 128, BODIES = 3 };
static const double SINE = 0.001, ALBEDO = 0.2;
static const enum body_law LAWS[BODIES] = {BODY_LOMMEL_SEELIGER, BODY_LAMBERT, BODY_LUNAR};
// Of 1 W m^-2 nm^-1: 683 lm/W times the integral of the observer's y, 106.857 nm.
static const double STAR_LX = 683 * 106.857;

struct setup {
    struct fixture *f;
    trl_scene *scene;
    trl_renderer *renderer;
};

// A black planet below air that absorbs alike at all wavelengths, with bodies of any size.
static trl_result make_renderer(struct setup *s, double per_m)
{
    char text[2048];
    snprintf(
        text, sizeof text,
        "{\"terrella\": 1, \"name\": \"dark\", \"star\": {\"spectral_irradiance\": 1},"
        " \"planet\": {\"radius_m\": 1e6, \"ground_albedo\": 0},"
        " \"atmosphere\": {\"height_m\": 1e4, \"constituents\": ["
        "   {\"absorption_per_m\": %g, \"profile\": \"uniform\"}]}, \"bodies\": ["
        " {\"name\": \"a\", \"radius_m\": 1e6, \"distance_m\": 1e9, \"geometric_albedo\": 0.2},"
        " {\"name\": \"b\", \"radius_m\": 1e6, \"distance_m\": 1e9, \"geometric_albedo\": 0.2,"
        "  \"phase_law\": \"lambert\"},"
        " {\"name\": \"c\", \"radius_m\": 1e6, \"distance_m\": 1e9, \"geometric_albedo\": 0.2,"
        "  \"phase_law\": \"lunar\"}]}",
        per_m);
    assert_int_equal(
        trl_scene_parse(s->f->ctx, text, strlen(text), "dark", "/nonexistent", &s->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    return trl_renderer_create(s->f->ctx, &desc, &s->renderer);
}

static void make_sky(struct setup *s, double per_m)
{
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    const trl_result result = make_renderer(s, per_m);
    fixture_skip_without_gl(s->f, result);
    assert_int_equal(result, TRL_OK);
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
    make_sky(s, 0);
    return 0;
}

static int tear_down(void **state)
{
    struct setup *s = *state;
    trl_renderer_destroy(&s->renderer);
    trl_scene_destroy(&s->scene);
    void *f = s->f;
    free(s);
    return fixture_tear_down(&f);
}

// From the equator to the north, at a body whose disc has a radius of so many pixels. The star is
// above it, on the same meridian, where it gives the phase.
struct sight {
    int body;
    double phase_deg, radius_px, elevation_deg;
};

static trl_view make_view(const struct sight *sight)
{
    trl_view view = trl_view_default();
    view.altitude_m = 1;
    view.pitch_rad = sight->elevation_deg * PI / 180;
    view.vertical_fov_rad = 2 * atan(SINE * SIDE / 2 / sight->radius_px);
    const double turn_deg = sight->elevation_deg + 180 - sight->phase_deg;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = (turn_deg > 90 ? 180 - turn_deg : turn_deg) * PI / 180;
    view.sun_longitude_or_azimuth_rad = turn_deg > 90 ? PI : 0;
    // Where the camera sees it at the distance that makes the sine.
    const double eye_m = 1e6 + 1, mu = sin(view.pitch_rad), far_m = 1e6 / SINE;
    view.bodies[sight->body] =
        (trl_body_place){TRL_BODY_LOCAL, view.pitch_rad, 0,
                         sqrt(eye_m * eye_m + far_m * far_m + 2 * eye_m * far_m * mu)};
    return view;
}

// Light through the picture, lx in linear sRGB, and its middle in pixels above the picture's.
struct found {
    double lx, rgb[3], up;
};

static struct found draw(const struct setup *s, const trl_view *view)
{
    static float rgba[4 * SIDE * SIDE];
    assert_int_equal(trl_renderer_draw(s->renderer, view, SIDE, SIDE, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(s->renderer, rgba), TRL_OK);
    const double half = tan(0.5 * view->vertical_fov_rad);
    struct found found = {0, {0, 0, 0}, 0};
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = half * (2 * (i % SIDE + 0.5) / SIDE - 1);
        const double y = half * (1 - 2 * (i / SIDE + 0.5) / SIDE);
        const double solid_angle = pow(2 * half / SIDE, 2) / pow(1 + x * x + y * y, 1.5);
        const float *p = rgba + 4 * (size_t)i;
        const double lx =
            solid_angle * (0.2126 * (double)p[0] + 0.7152 * (double)p[1] + 0.0722 * (double)p[2]);
        for (int c = 0; c < 3; c++) {
            found.rgb[c] += solid_angle * (double)p[c];
        }
        found.lx += lx;
        found.up += lx * y / half * SIDE / 2;
    }
    found.up /= found.lx > 0 ? found.lx : 1;
    return found;
}

static double expect_lx(const struct sight *sight)
{
    const double phase = body_phase(LAWS[sight->body], sight->phase_deg * PI / 180);
    return STAR_LX * ALBEDO * SINE * SINE * phase;
}

// 64 samples on the radius: the lit part of a crescent at 150 degrees is nine of them wide, and
// light falls as a root at its edge.
static void a_disc_has_the_light_of_its_phase(void **state)
{
    const double phases_deg[] = {0, 30, 60, 90, 120, 150};
    const double radii_px[] = {2.1, 3.3, 11, 40};
    for (int i = 0; i < BODIES * 6 * 4; i++) {
        const struct sight sight = {i % BODIES, phases_deg[i / BODIES % 6],
                                    radii_px[i / BODIES / 6], 50};
        const trl_view view = make_view(&sight);
        const double error = draw(*state, &view).lx / expect_lx(&sight) - 1;
        assert_true(fabs(error) < (sight.phase_deg > 120 ? 0.015 : 0.004));
    }
}

static void a_point_has_the_light_of_its_phase(void **state)
{
    const double phases_deg[] = {0, 90, 150, 160};
    const double radii_px[] = {0.5, 1, 1.9};
    for (int i = 0; i < BODIES * 4 * 3; i++) {
        const struct sight sight = {i % BODIES, phases_deg[i / BODIES % 4],
                                    radii_px[i / BODIES / 4], 50};
        trl_view view = make_view(&sight);
        view.roll_rad = i;
        // Pixels of the spread see it under solid angles of their own when the field is wide.
        const double limit = sight.radius_px < 1 ? 0.01 : 1e-3;
        assert_true(fabs(draw(*state, &view).lx / expect_lx(&sight) - 1) < limit);
    }
}

// The middle of the light of Lambert's half disc is 3 pi / 16 of the radius from the centre.
static void the_lit_side_is_toward_the_star(void **state)
{
    const struct sight half = {1, 90, 40, 50};
    trl_view view = make_view(&half);
    assert_true(fabs(draw(*state, &view).up / half.radius_px - 3 * PI / 16) < 0.01);
    view.roll_rad = PI;
    assert_true(fabs(draw(*state, &view).up / half.radius_px + 3 * PI / 16) < 0.01);
    const struct sight full = {0, 0, 40, 50};
    view = make_view(&full);
    assert_true(fabs(draw(*state, &view).up) < 0.1);
}

static void ground_hides_what_is_below_the_horizon(void **state)
{
    // The horizon of an eye at 1 m is a chord of the disc, y radii below its centre.
    const double y = 0.3, dip_rad = acos(1e6 / (1e6 + 1));
    struct sight sight = {0, 0, 40, (y * SINE - dip_rad) * 180 / PI};
    trl_view view = make_view(&sight);
    const double share = 0.5 + (asin(y) + y * sqrt(1 - y * y)) / PI;
    assert_true(fabs(draw(*state, &view).lx / expect_lx(&sight) / share - 1) < 0.02);
    const double radii_px[] = {40, 1};
    for (int i = 0; i < 2; i++) {
        sight = (struct sight){0, 0, radii_px[i], -3};
        view = make_view(&sight);
        assert_true(draw(*state, &view).lx < 1e-9);
    }
}

// Uniform air of 10 km takes exp(-k s), s the way to its top.
static void air_dims_discs_and_points(void **state)
{
    struct setup *s = *state;
    const double per_m = 2e-5, eye_m = 1e6 + 1, top_m = 1.01e6;
    make_sky(s, per_m);
    const double elevations_deg[] = {80, 20, 5};
    for (int i = 0; i < 6; i++) {
        const struct sight sight = {0, 0, i % 2 ? 30 : 1, elevations_deg[i / 2]};
        const double mu = sin(sight.elevation_deg * PI / 180);
        const double way_m =
            sqrt(pow(eye_m * mu, 2) + (top_m - eye_m) * (top_m + eye_m)) - eye_m * mu;
        const trl_view view = make_view(&sight);
        const double left = draw(s, &view).lx / expect_lx(&sight);
        // At 5 degrees the air differs by a fifth from one edge of the disc to the other.
        assert_true(fabs(left / exp(-per_m * way_m) - 1) < 0.02);
    }
    make_sky(s, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_disc_has_the_light_of_its_phase),
        cmocka_unit_test(a_point_has_the_light_of_its_phase),
        cmocka_unit_test(the_lit_side_is_toward_the_star),
        cmocka_unit_test(ground_hides_what_is_below_the_horizon),
        cmocka_unit_test(air_dims_discs_and_points),
    };
    return cmocka_run_group_tests_name("bodies", tests, set_up, tear_down);
}
