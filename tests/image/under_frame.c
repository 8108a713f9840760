// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pictures of eyes under water against the path tracer's: its own surface, facets, scattering and
// bed; of the renderer only the water's coefficients.
#include "sea_scene.h"

#include <math.h>

enum { WIDTH = 12, HEIGHT = 8, PIXELS = WIDTH * HEIGHT };
static const double PI = 3.14159265358979323846;

struct look {
    const char *name;
    double depth_m, pitch_deg, sun_elevation_deg;
};

static trl_view find_view(const struct look *look)
{
    trl_view view = trl_view_default();
    view.latitude_rad = 0.3;
    view.altitude_mode = TRL_ALTITUDE_SPHERE;
    view.altitude_m = -look->depth_m;
    view.pitch_rad = look->pitch_deg * PI / 180;
    view.vertical_fov_rad = 1;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = look->sun_elevation_deg * PI / 180;
    view.sun_longitude_or_azimuth_rad = 0.3;
    return view;
}

// Means over the picture, and over pixels how far they are apart beyond the paths' noise, relative
// to the brightest channel; the star's own window, which one path in thousands finds, left out.
static void compare(trl_context *ctx, const trl_scene *scene, trl_renderer *renderer,
                    const struct look *look)
{
    static float drawn[4 * PIXELS], traced[4 * PIXELS], error[4 * PIXELS];
    const trl_view view = find_view(look);
    assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, drawn), TRL_OK);
    trl_reference_desc desc = trl_reference_desc_default();
    desc.scene = scene;
    desc.paths = 256;
    desc.pixel_width = 0;
    assert_int_equal(trl_reference_render(ctx, &desc, &view, WIDTH, HEIGHT, traced, error), TRL_OK);
    double sum[3] = {0}, wanted[3] = {0}, noise[3] = {0}, apart = 0;
    for (int i = 0; i < PIXELS; i++) {
        double most = 0, worst = 0;
        for (int c = 0; c < 3; c++) {
            sum[c] += (double)drawn[4 * i + c];
            wanted[c] += (double)traced[4 * i + c];
            noise[c] += pow((double)error[4 * i + c], 2);
            most = fmax(most, (double)traced[4 * i + c]);
            worst = fmax(worst, fabs((double)drawn[4 * i + c] - (double)traced[4 * i + c]) -
                                    2 * (double)error[4 * i + c]);
        }
        apart += worst / most / PIXELS;
    }
    printf("%s:", look->name);
    for (int c = 0; c < 3; c++) {
        printf(" %c %.4g, traced %.4g (%+.1f %% +- %.1f)", "rgb"[c], sum[c] / PIXELS,
               wanted[c] / PIXELS, 100 * (sum[c] / wanted[c] - 1),
               100 * sqrt(noise[c]) / wanted[c]);
    }
    printf("; pixels %.1f %%\n", 100 * apart);
    const double brightest = fmax(wanted[1], wanted[2]);
    for (int c = 0; c < 3; c++) {
        assert_true(sqrt(noise[c]) < 0.08 * brightest);
        assert_true(fabs(sum[c] - wanted[c]) < 0.04 * brightest + 2 * sqrt(noise[c]));
    }
    assert_true(apart < 0.08);
}

// With the eye a metre above, in, and a metre below the surface: what is straight above it does not
// change but by what the surface and the water take, and add.
static void cross_the_surface(trl_renderer *renderer)
{
    static const double depths_m[] = {-1, -0.1, -0.001, 0.001, 0.1, 1};
    double before = 0;
    for (size_t i = 0; i < sizeof depths_m / sizeof *depths_m; i++) {
        static float drawn[4 * PIXELS];
        const struct look look = {"", depths_m[i], 89, 20};
        const trl_view view = find_view(&look);
        assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(renderer, drawn), TRL_OK);
        const double green = (double)drawn[4 * (PIXELS / 2 + WIDTH / 2) + 1];
        printf("%g m deep: %g\n", depths_m[i], green);
        assert_true(i == 0 || (green > 0.9 * before && green < 1.03 * before));
        before = green;
    }
}

// Where facets begin to mirror all, one picture row after the other, light falls without steps:
// they stand for all facets between them.
static void fade_the_window(trl_renderer *renderer)
{
    enum { ROWS = 160 };
    static float drawn[4 * ROWS];
    const struct look look = {"", 3, 41, 50}; // the window's edge is 41.7 degrees high
    trl_view view = find_view(&look);
    view.vertical_fov_rad = 0.5;
    view.heading_rad = 2;
    assert_int_equal(trl_renderer_draw(renderer, &view, 1, ROWS, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, drawn), TRL_OK);
    double largest = 0;
    for (int i = 2; i < ROWS - 1; i++) {
        const float *green = drawn + 4 * (size_t)i + 1;
        const double step = (double)green[0] - (double)green[-4];
        const double around = ((double)green[4] - (double)green[-8]) / 3;
        largest = fmax(largest, fabs(step - around));
    }
    const double range = fabs((double)drawn[1] - (double)drawn[4 * (ROWS - 1) + 1]);
    printf("the window's edge: steps of %.2f %% of %g\n", 100 * largest / range, range);
    assert_true(largest < 0.01 * range);
}

// A centimetre above the surface and below it, along it and down, without the star's disc: all is
// light of the sky and of the sea.
static void look_about_at_the_surface(trl_renderer *renderer)
{
    static const double depths_m[] = {-0.01, 0.01}, pitches_deg[] = {0, -30, -89};
    for (size_t i = 0; i < 6; i++) {
        static float drawn[4 * PIXELS];
        const struct look look = {"", depths_m[i / 3], pitches_deg[i % 3], 60};
        const trl_view view = find_view(&look);
        assert_int_equal(trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(renderer, drawn), TRL_OK);
        double least = HUGE_VAL, most = 0;
        for (int k = 0; k < PIXELS; k++) {
            const double green = (double)drawn[4 * k + 1];
            assert_true(isfinite(green) && isfinite((double)drawn[4 * k]));
            least = fmin(least, green);
            most = fmax(most, green);
        }
        printf("%g m deep, %g deg: %g to %g\n", look.depth_m, look.pitch_deg, least, most);
        assert_true(least > 0 && most < 1e3 * least);
    }
}

static void eyes_see_what_paths_find(void **state)
{
    (void)state;
    static const struct look looks[] = {{"up", 3, 60, 50},
                                        {"along", 3, 5, 50},
                                        {"down", 3, -50, 50},
                                        {"just below", 0.05, 10, 50},
                                        {"up, low sun", 3, 60, 15}};
    enum { LOOKS = sizeof looks / sizeof *looks };
    static const char *const waters[] = {
        "\"chlorophyll_mg_m3\": 0.1, \"dissolved_per_m_440\": 0.01",
        "\"chlorophyll_mg_m3\": 10, \"dissolved_per_m_440\": 0.1"};
    struct sea_scene s;
    sea_scene_begin(&s);
    for (size_t w = 0; w < 2; w++) {
        trl_scene *scene =
            sea_scene_make(&s, "\"wind_m_s\": 0, \"mean_square_slope\": 0.01", waters[w], 10);
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = scene;
        trl_renderer *renderer = NULL;
        assert_int_equal(trl_renderer_create(s.ctx, &desc, &renderer), TRL_OK);
        for (size_t i = w ? LOOKS - 2 : 0; i < LOOKS; i++) {
            compare(s.ctx, scene, renderer, &looks[i]);
        }
        if (w == 0) {
            cross_the_surface(renderer);
            fade_the_window(renderer);
            look_about_at_the_surface(renderer);
        }
        trl_renderer_destroy(&renderer);
        trl_scene_destroy(&scene);
    }
    sea_scene_end(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eyes_see_what_paths_find),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
