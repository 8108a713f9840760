// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The star's disc: drawn only where it can be, and there with all of its light.
#include "fixture.h"
#include <terrella/terrella.h>

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SIDE = 256 };
static const double PI = 3.14159265358979323846;

struct setup {
    struct fixture *f;
    trl_scene *scene;
    trl_renderer *renderer;
};

static trl_scene *parse(const struct fixture *f)
{
    static const char text[] =
        "{\"terrella\": 1, \"name\": \"sphere\","
        " \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": 2.5},"
        " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.3},"
        " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
        "  \"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1e-6,"
        "   \"exponent\": -4}},"
        "  \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"rayleigh\"}]}}";
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "star", "/nonexistent", &scene),
                     TRL_OK);
    return scene;
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
    s->scene = parse(s->f);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = s->scene;
    const trl_result result = trl_renderer_create(s->f->ctx, &desc, &s->renderer);
    fixture_skip_without_gl(s->f, result);
    return result == TRL_OK ? 0 : 1;
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

// Up from high above the air, with the star 60 degrees above the horizontal in the north.
static trl_view view_of_space(double heading_deg, double pitch_deg, double fov_deg)
{
    trl_view view = trl_view_default();
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = 2e7;
    view.heading_rad = heading_deg * PI / 180;
    view.pitch_rad = pitch_deg * PI / 180;
    view.vertical_fov_rad = fov_deg * PI / 180;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = PI / 3;
    view.sun_longitude_or_azimuth_rad = 0;
    return view;
}

// Light that comes in through the picture, lx: luminance times the solid angle of each pixel.
static double draw_light(const struct setup *s, const trl_view *view)
{
    static float rgba[4 * SIDE * SIDE];
    assert_int_equal(trl_renderer_draw(s->renderer, view, SIDE, SIDE, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(s->renderer, rgba), TRL_OK);
    const double half = tan(0.5 * view->vertical_fov_rad);
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = half * (2 * (i % SIDE + 0.5) / SIDE - 1);
        const double y = half * (2 * (i / SIDE + 0.5) / SIDE - 1);
        const double solid_angle = pow(2 * half / SIDE, 2) / pow(1 + x * x + y * y, 1.5);
        const float *p = rgba + 4 * (size_t)i;
        sum +=
            solid_angle * (0.2126 * (double)p[0] + 0.7152 * (double)p[1] + 0.0722 * (double)p[2]);
    }
    return sum;
}

static void the_disc_has_all_the_light_wherever_it_is_in_the_picture(void **state)
{
    // 683 lm/W times 1.5 W m^-2 nm^-1 times the area of CIE 1931 y(lambda), 106.857 nm.
    const double illuminance_lx = 683 * 1.5 * 106.857;
    static const double places[][3] = {
        {0, 60, 20},   {8, 55, 20},    {-8, 66, 20},   {0, 60, 120},
        {60, 30, 120}, {-60, 30, 120}, {120, 80, 120}, {180, 75, 120},
    };
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const trl_view view = view_of_space(places[i][0], places[i][1], places[i][2]);
        const double light_lx = draw_light(*state, &view);
        // The disc's edge is blurred over a pixel of the picture's middle: at 120 degrees the disc
        // is six pixels wide there, and a percent or two of its area are lost or won.
        assert_true(fabs(light_lx / illuminance_lx - 1) < 0.03);
    }
}

static void a_star_beside_or_behind_the_picture_is_not_seen(void **state)
{
    static const double places[][3] = {{0, 45, 20},    {30, 60, 20},   {180, -60, 20},
                                       {180, -20, 20}, {180, 10, 120}, {180, 40, 20}};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        trl_view view = view_of_space(places[i][0], places[i][1], places[i][2]);
        view.altitude_m = 2e9; // the planet is less than a pixel
        // That pixel reflects a few lux at most.
        assert_true(draw_light(*state, &view) < 10);
    }
}

// The tables end in deep twilight: what is left there must not stay for the night. Of a sky that
// gives some 1e4 lx by day, and of starlight's 5e-4 lx.
static void twilight_goes_out(void **state)
{
    const double altitudes_m[] = {10, 400000};
    for (int i = 0; i < 2; i++) {
        trl_view view = view_of_space(0, i ? -19 : 20, 60);
        view.altitude_m = altitudes_m[i];
        view.sun_latitude_or_elevation_rad = -80 * PI / 180;
        assert_true(draw_light(*state, &view) < 1e-6);
        view.sun_latitude_or_elevation_rad = -10 * PI / 180;
        assert_true(draw_light(*state, &view) > 0.1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_disc_has_all_the_light_wherever_it_is_in_the_picture),
        cmocka_unit_test(a_star_beside_or_behind_the_picture_is_not_seen),
        cmocka_unit_test(twilight_goes_out),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
