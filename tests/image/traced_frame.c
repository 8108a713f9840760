// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames against the same pictures by the path tracer: camera, star, ground, air, integration over
// wavelengths and development, of two programs that share none of it but the camera.
#include "scene_renderer.h"

#include "scene/camera.h"
#include "scene/scene.h"
#include <terrella/terrella.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

enum { WIDTH = 24, HEIGHT = 14, PIXELS = WIDTH * HEIGHT };

// What the renderer's frames may differ from the solver (tests/image/spectral_frame.c: 2 % in the
// median, 6 % in all but one of twenty pixels) and the solver from the path tracer (1 % by day, 2 %
// in twilight).
static const double MEDIAN_LIMIT = 0.02;
static const double MOST_LIMIT = 0.06;

static int set_up(void **state)
{
    static struct fixture f;
    scene_renderer_make(TRACED_FRAME_SCENE, &f);
    *state = &f;
    return 0;
}

static void trace(const struct fixture *f, const trl_view *view, float *rgba, float *error)
{
    trl_reference_desc desc = trl_reference_desc_default();
    desc.scene = f->scene;
    desc.paths = 320;
    desc.pixel_width = 0;
    assert_int_equal(trl_reference_render(f->ctx, &desc, view, WIDTH, HEIGHT, rgba, error), TRL_OK);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

// Whether a pixel touches the horizon: drawn, it is the mean of both sides, here traced through its
// middle.
static bool is_at_horizon(const struct camera *camera, double ground_radius_m, int pixel)
{
    const double x = 2 * (pixel % WIDTH + 0.5) / WIDTH - 1;
    const double y = 1 - 2 * (pixel / WIDTH + 0.5) / HEIGHT;
    const struct vec3 direction = vec3_normalize(camera_ray(camera, x, y));
    const double mu = vec3_dot(vec3_normalize(camera->position_m), direction);
    const double sine = ground_radius_m / vec3_length(camera->position_m);
    const double off_rad = fabs(acos(mu) - (M_PI - asin(fmin(1, sine))));
    return off_rad < 2 * sqrt(2) * camera->tan_half_fov_y / HEIGHT;
}

// How far two colours are apart, relative to the brighter component, beyond what noise explains.
static double find_difference(const float *drawn, const float *traced, const float *error)
{
    double largest = 0, worst = 0;
    for (int c = 0; c < 3; c++) {
        largest = fmax(largest, (double)traced[c]);
        const double apart = fabs((double)drawn[c] - (double)traced[c]);
        // Of 300 pixels one is three standard errors off.
        worst = fmax(worst, apart - 3 * (double)error[c]);
    }
    return largest > 0 ? worst / largest : 0;
}

static void check_view(const struct fixture *f, const char *name)
{
    static float drawn[4 * PIXELS], traced[4 * PIXELS], error[4 * PIXELS];
    static double apart[PIXELS];
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, name, &view), TRL_OK);
    assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(f->renderer, drawn), TRL_OK);
    trace(f, &view, traced, error);
    const double radius_m = f->scene->medium.ground_radius_m;
    const struct camera_place place = {.radius_m = radius_m};
    const struct camera camera = camera_resolve(&view, &place, (double)WIDTH / HEIGHT);
    double light = 0, light_drawn = 0, noise = 0;
    int count = 0;
    for (int i = 0; i < PIXELS; i++) {
        const double green = (double)traced[4 * i + 1];
        // Neither shows the disc as the other does: one averages over the pixel.
        const bool is_star = fmax(green, (double)drawn[4 * i + 1]) > 1e6;
        if (green > 1e-3 && !is_star && !is_at_horizon(&camera, radius_m, i)) {
            apart[count++] = find_difference(drawn + 4 * i, traced + 4 * i, error + 4 * i);
            light += green;
            light_drawn += (double)drawn[4 * i + 1];
            noise += pow((double)error[4 * i + 1], 2);
        }
    }
    qsort(apart, (size_t)count, sizeof *apart, compare_doubles);
    const double most = apart[count - 1 - count / 20];
    const double mean = light_drawn / light - 1, mean_error = sqrt(noise) / light;
    printf("%-10s %d pixels: mean %+.2f %% +- %.2f %%; beyond noise: median %.2f %%, 95 of 100 "
           "below %.2f %%, worst %.2f %%\n",
           name, count, 100 * mean, 100 * mean_error, 100 * apart[count / 2], 100 * most,
           100 * apart[count - 1]);
    assert_true(count > 50);
    assert_true(apart[count / 2] < MEDIAN_LIMIT);
    assert_true(most < MOST_LIMIT);
    assert_true(fabs(mean) < MEDIAN_LIMIT + 4 * mean_error);
}

static void day_from_the_ground(void **state)
{
    check_view(*state, "ground");
}

static void sunset_from_the_ground(void **state)
{
    check_view(*state, "sunset");
}

static void twilight_from_the_ground(void **state)
{
    check_view(*state, "twilight");
}

static void limb_from_orbit(void **state)
{
    check_view(*state, "limb");
}

static void full_disc_from_afar(void **state)
{
    check_view(*state, "full-disc");
}

// Exposure and curve on the CPU and on the GPU, of one radiance.
static void development_is_the_renderers(void **state)
{
    const struct fixture *f = *state;
    static float radiance[4 * PIXELS];
    static uint8_t drawn[4 * PIXELS], developed[4 * PIXELS];
    for (int curve = 0; curve <= TRL_TONE_EXPONENTIAL; curve++) {
        for (size_t v = 0; v < trl_scene_view_count(f->scene); v++) {
            trl_view view;
            const char *name = trl_scene_view_name(f->scene, v);
            assert_int_equal(trl_scene_view(f->scene, name, &view), TRL_OK);
            view.tone_curve = (trl_tone_curve)curve;
            assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
            assert_int_equal(trl_renderer_read_radiance(f->renderer, radiance), TRL_OK);
            assert_int_equal(trl_renderer_read_rgba8(f->renderer, drawn), TRL_OK);
            assert_int_equal(
                trl_radiance_develop(f->ctx, f->scene, &view, WIDTH, HEIGHT, radiance, developed),
                TRL_OK);
            for (int i = 0; i < 4 * PIXELS; i++) {
                // Rounding at the edge of a step.
                assert_true(abs((int)drawn[i] - (int)developed[i]) <= 1);
            }
        }
    }
}

// Callers' mistakes, each told and none followed.
static void mistakes_are_refused(void **state)
{
    const struct fixture *f = *state;
    static float rgba[4 * PIXELS];
    static uint8_t codes[4 * PIXELS];
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "ground", &view), TRL_OK);
    trl_reference_desc good = trl_reference_desc_default();
    good.scene = f->scene;
    good.paths = 1;
    trl_reference_desc bad[6];
    for (int i = 0; i < 6; i++) {
        bad[i] = good;
    }
    bad[0].canary = 0;
    bad[1].scene = NULL;
    bad[2].paths = 0;
    bad[3].max_orders = 1001;
    bad[4].pixel_width = -1;
    bad[5].pixel_width = NAN;
    for (int i = 0; i < 6; i++) {
        assert_int_equal(trl_reference_render(f->ctx, &bad[i], &view, 2, 2, rgba, NULL),
                         TRL_ERROR_INVALID);
    }
    assert_int_equal(trl_reference_render(NULL, &good, &view, 2, 2, rgba, NULL), TRL_ERROR_INVALID);
    assert_int_equal(trl_reference_render(f->ctx, NULL, &view, 2, 2, rgba, NULL),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_reference_render(f->ctx, &good, NULL, 2, 2, rgba, NULL),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_reference_render(f->ctx, &good, &view, 0, 2, rgba, NULL),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_reference_render(f->ctx, &good, &view, 2, 2, NULL, NULL),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_radiance_develop(f->ctx, f->scene, &view, 2, 2, NULL, codes),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_radiance_develop(f->ctx, NULL, &view, 2, 2, rgba, codes),
                     TRL_ERROR_INVALID);
    view.latitude_rad = 7;
    assert_int_equal(trl_reference_render(f->ctx, &good, &view, 2, 2, rgba, NULL),
                     TRL_ERROR_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(day_from_the_ground),      cmocka_unit_test(sunset_from_the_ground),
        cmocka_unit_test(twilight_from_the_ground), cmocka_unit_test(limb_from_orbit),
        cmocka_unit_test(full_disc_from_afar),      cmocka_unit_test(development_is_the_renderers),
        cmocka_unit_test(mistakes_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, scene_renderer_tear_down);
}
