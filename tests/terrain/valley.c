// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The light in valleys against the path tracer, which follows all of it among the same slopes.
#include "fixture.h"

#include <terrella/terrella.h>

#include <stdio.h>
#include <string.h>

enum { WIDTH = 20, HEIGHT = 12, PIXELS = WIDTH * HEIGHT };
static const double DEGREE = 3.14159265358979323846 / 180;

// Ranges of 3 km along the meridians, 12 km apart, with spurs.
static double ranges(double latitude, double longitude)
{
    const double x = longitude / 0.68, y = latitude / 0.5;
    return 2000 - 1500 * cos(2 * M_PI * x) + 500 * sin(2 * M_PI * (y + 0.3 * x));
}

struct valley {
    double albedo, sun_elevation_deg;
    double limits[2][3]; // of errors in the shade and in the star's light: red, green, blue
};

static trl_scene *make_scene(struct fixture *f, const struct valley *v)
{
    static char text[1024];
    snprintf(text, sizeof text,
             "{\"terrella\": 1, \"star\": {\"spectral_irradiance\": 1.5, \"angular_radius_deg\": "
             "0.27}, \"planet\": {\"radius_m\": 1000000, \"ground_albedo\": %.3f},"
             " \"atmosphere\": {\"height_m\": 60000, \"constituents\": ["
             "  {\"scattering_per_m\": {\"power_law\": {\"at_nm\": 550, \"value\": 1.15e-5,"
             "    \"exponent\": -4}}, \"phase\": \"rayleigh\","
             "   \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}}]},"
             " \"surface\": {\"layers\": [{\"elevation\": \"ranges.tif\", \"feather_deg\": 0.2}]}}",
             v->albedo);
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(f->ctx, text, strlen(text), "valley", f->folder, &scene),
                     TRL_OK);
    return scene;
}

// On the western side of a valley, southward; the sun in the east, behind the range.
static trl_view make_view(const struct valley *v)
{
    trl_view view = trl_view_default();
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    view.altitude_m = 300;
    view.longitude_rad = 0.05 * DEGREE;
    view.heading_rad = 180 * DEGREE;
    view.pitch_rad = -16 * DEGREE;
    view.vertical_fov_rad = 50 * DEGREE;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = v->sun_elevation_deg * DEGREE;
    view.sun_longitude_or_azimuth_rad = 90 * DEGREE;
    return view;
}

static void draw(struct fixture *f, const trl_scene *scene, const trl_view *view, float *rgba)
{
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    trl_renderer *renderer = NULL;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_OK);
    // Means of what the path tracer's pixels average over.
    static float fine[16 * 4 * PIXELS];
    assert_int_equal(trl_renderer_draw(renderer, view, 4 * WIDTH, 4 * HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, fine), TRL_OK);
    memset(rgba, 0, 4 * PIXELS * sizeof *rgba);
    for (int i = 0; i < 16 * PIXELS; i++) {
        const int x = i % (4 * WIDTH) / 4, y = i / (4 * WIDTH) / 4;
        for (int c = 0; c < 3; c++) {
            rgba[4 * (y * WIDTH + x) + c] += fine[4 * i + c] / 16;
        }
    }
    trl_renderer_destroy(&renderer);
}

// Of pixels that show ground, in shadow or not: drawn over traced light, in three colours.
static void check_valley(struct fixture *f, const struct valley *v)
{
    static float drawn[4 * PIXELS], traced[4 * PIXELS], error[4 * PIXELS];
    char path[128];
    const struct raster_place place = {-2, 2, 0.01, 400, 400};
    fixture_write_heights(f, "ranges", &place, ranges, path);
    trl_scene *scene = make_scene(f, v);
    const trl_view view = make_view(v);
    draw(f, scene, &view, drawn);
    trl_reference_desc desc = trl_reference_desc_default();
    desc.scene = scene;
    desc.paths = 128;
    assert_int_equal(trl_reference_render(f->ctx, &desc, &view, WIDTH, HEIGHT, traced, error),
                     TRL_OK);
    double sum[2][3] = {{0}}, wanted[2][3] = {{0}};
    for (int i = 0; i < PIXELS; i++) {
        const bool is_lit = traced[4 * i + 1] > 4000; // cd m^-2
        for (int c = 0; c < 3; c++) {
            sum[is_lit][c] += (double)drawn[4 * i + c];
            wanted[is_lit][c] += (double)traced[4 * i + c];
        }
    }
    trl_scene_destroy(&scene);
    for (int k = 0; k < 2; k++) {
        for (int c = 0; c < 3; c++) {
            const double off = wanted[k][c] > 0 ? sum[k][c] / wanted[k][c] - 1 : 0;
            printf("albedo %.1f, sun %.0f, %s: %+.1f %%\n", v->albedo, v->sun_elevation_deg,
                   k ? "lit" : "dark", 100 * off);
            assert_true(fabs(off) < v->limits[k][c]);
        }
    }
}

// Noise of the means is 1 to 2 %. In the shade the sky is taken as even, which is brighter toward
// the horizon that slopes hide, and the air as lit by all of it: too bright in blue. Slopes taken
// as alone, among level ground, were 20 % too dark in red there, and 8 to 15 % under the high sun.
static void valleys_have_the_light_that_is_traced(void **state)
{
    const struct valley low = {0.8, 15, {{0.09, 0.20, 0.30}, {0.09, 0.06, 0.06}}};
    const struct valley high = {0.8, 50, {{0.07, 0.05, 0.05}, {0.07, 0.05, 0.05}}};
    check_valley(*state, &low);
    check_valley(*state, &high);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(valleys_have_the_light_that_is_traced)};
    return cmocka_run_group_tests_name("valley", tests, fixture_set_up, fixture_tear_down);
}
