// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Ground that is brighter, darker or higher than the sphere of the mean albedo for which the air is
// solved: against a planet that is like that all over.
#include "fixture.h"

#include "scene/scene.h"
#include <terrella/terrella.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ALTITUDES_M[] = {4e5, 5000};
enum { WIDTH = 48, HEIGHT = 32 };
static const double DEGREE = 3.14159265358979323846 / 180;
static const double BRIGHT = 0.402;     // what the sRGB code 170 stands for
static const double RADIUS_M = 6371000; // of the ground
static const double PLATEAU_M = 4000;
static const double DARK = 0.031; // 49

static double bright_code(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 170;
}

static double dark_code(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 49;
}

static double plateau_height(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return PLATEAU_M;
}

static trl_view make_view(double altitude_m)
{
    trl_view view = trl_view_default();
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = altitude_m;
    view.pitch_rad = -60 * DEGREE;
    view.vertical_fov_rad = 40 * DEGREE;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 50 * DEGREE;
    return view;
}

struct planet {
    double mean; // albedo that the air is solved for
    double (*code)(double, double);
    double plateau_m; // altitude of all of the ground; the same planet is smaller by it
};

static void write_planet(struct fixture *f, const struct planet *p, char text[1024])
{
    char path[128];
    const struct raster_place place = {-180, 90, 2, 180, 90};
    fixture_write_bytes(f, "colour", &place, p->code, path);
    fixture_write_heights(f, "plateau", &place, plateau_height, path);
    snprintf(text, 1024,
             "{\"terrella\": 1, \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": "
             "0.27}, \"planet\": {\"radius_m\": %.0f, \"ground_albedo\": %.4f},"
             " \"atmosphere\": {\"height_m\": %.0f, \"constituents\": ["
             "  {\"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": %.9e,"
             "    \"exponent\": -4}}, \"phase\": \"rayleigh\","
             "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}},"
             "  {\"scattering_per_m\": %.9e, \"phase\": {\"henyey_greenstein\": {\"g\": 0.7}},"
             "   \"profile\": {\"exponential\": {\"scale_height_m\": 1500}}}]},"
             " \"surface\": {\"layers\": [{\"colour\": \"colour.tif\"}%s]}}",
             RADIUS_M - p->plateau_m, p->mean, 60000 + p->plateau_m,
             1.15e-5 * exp(p->plateau_m / 8000), 5e-5 * exp(p->plateau_m / 1500),
             p->plateau_m > 0 ? ", {\"elevation\": \"plateau.tif\"}" : "");
}

// Mean colours from both altitudes.
static void draw_means(struct fixture *f, const struct planet *p, double rgb[2][3])
{
    char text[1024];
    write_planet(f, p, text);
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "region", f->folder, &scene),
                     TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.wavelengths = 4;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_OK);
    static float rgba[4 * WIDTH * HEIGHT];
    for (int v = 0; v < 2; v++) {
        const trl_view view = make_view(ALTITUDES_M[v] + p->plateau_m);
        assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(renderer, rgba), TRL_OK);
        for (int k = 0; k < 3; k++) {
            rgb[v][k] = 0;
            for (int i = 0; i < WIDTH * HEIGHT; i++) {
                rgb[v][k] += (double)rgba[4 * i + k] / (WIDTH * HEIGHT);
            }
        }
    }
    trl_renderer_destroy(&renderer);
    trl_scene_destroy(&scene);
}

static void check_planet(struct fixture *f, const struct planet *p, const struct planet *same,
                         double limit)
{
    double got[2][3];
    double wanted[2][3];
    draw_means(f, p, got);
    draw_means(f, same, wanted);
    for (int v = 0; v < 2; v++) {
        double worst = 0;
        for (int k = 0; k < 3; k++) {
            worst = fmax(worst, fabs(got[v][k] / wanted[v][k] - 1));
        }
        printf("albedo %.2f instead of %.2f, %.0f m high, from %.0f km: %.1f %%\n", same->mean,
               p->mean, p->plateau_m, ALTITUDES_M[v] / 1000, 100 * worst);
        assert_true(worst < limit);
    }
}

static void air_before_a_region_takes_the_regions_light(void **state)
{
    // Two streams are good to a tenth of what they correct, which is 11 to 15 % here.
    const struct planet bright = {.mean = BRIGHT, .code = bright_code};
    const struct planet dark = {.mean = DARK, .code = dark_code};
    check_planet(*state, &(struct planet){.mean = 0.1, .code = bright_code}, &bright, 0.02);
    check_planet(*state, &(struct planet){.mean = 0.1, .code = dark_code}, &dark, 0.02);
}

// The air is solved down to the sphere, and half of it is not there.
static void air_above_a_plateau_does_not_know_the_air_that_is_below(void **state)
{
    const struct planet high = {.mean = 0.1, .code = dark_code, .plateau_m = PLATEAU_M};
    const struct planet same = {.mean = DARK, .code = dark_code};
    // 39 and 47 % without. From near, with four parts in five of the aerosol below, more is left.
    check_planet(*state, &high, &same, 0.045);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(air_before_a_region_takes_the_regions_light),
        cmocka_unit_test(air_above_a_plateau_does_not_know_the_air_that_is_below),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
