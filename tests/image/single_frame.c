// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames of the model single against the CPU's answer of the same model for the same pixels: every
// stage between the integral and a pixel's colour (four bands, the 128^3 table and its coordinates,
// the optical depth, light on the ground) at once.
#include "frame_check.h"
#include "scene/scene.h"
#include <terrella/terrella.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 54 };

// As of the spectral model's frames: light of the ground in four bands, shadow's edge in twilight.
static const double MEDIAN_LIMIT = 0.02;
// One pixel in twenty may be worse, up to this: where the limb or twilight changes within a texel.
static const double MOST_LIMIT = 0.06;

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
    trl_renderer *renderer;
    struct optics optics;
    struct solution solution; // of one order: direct light only
    struct band_fit exact;    // its exact matrix from all wavelengths to colour
    struct query *query;
};

static int set_up(void **state)
{
    struct fixture *f = aligned_alloc(64, (sizeof *f + 63) / 64 * 64);
    memset(f, 0, sizeof *f);
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, SINGLE_FRAME_SCENE, &f->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = f->scene;
    desc.sky_model = TRL_SKY_SINGLE;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &f->renderer), TRL_OK);
    optics_init_visible(OPTICS_PICTURES, &f->scene->medium, LANES, &f->optics);
    struct solver_settings settings = solver_settings_choose(&f->optics, SOLVER_INTERACTIVE);
    settings.orders = 1;
    assert_int_equal(solution_init(f->ctx, &f->optics, &settings, &f->solution), TRL_OK);
    band_fit_init(&f->exact, &f->optics);
    assert_int_equal(query_create(f->ctx, &f->solution, &f->query), TRL_OK);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    query_destroy(f->ctx, &f->query);
    solution_finish(f->ctx, &f->solution);
    trl_renderer_destroy(&f->renderer);
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    free(f);
    return 0;
}

static void find_colour(const void *model, const struct query_view *view, float rgb[3])
{
    const struct fixture *f = model;
    lanes radiance;
    query_plane_radiance(f->query, view, &radiance);
    frame_check_colour(&f->exact, &radiance, rgb);
}

static void frames_are_the_numbers(void **state)
{
    const struct fixture *f = *state;
    const struct frame_check check = {.ctx = f->ctx,
                                      .scene = f->scene,
                                      .renderer = f->renderer,
                                      .name = "single-frame",
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .median_limit = MEDIAN_LIMIT,
                                      .most_limit = MOST_LIMIT,
                                      .expect = find_colour,
                                      .model = f};
    frame_check_all(&check);
}

// The observer outside is moved to the boundary, where the table begins: the picture goes through.
static void the_boundary_of_the_air_does_not_show(void **state)
{
    const struct fixture *f = *state;
    static float inside[WIDTH * HEIGHT * 4];
    static float outside[WIDTH * HEIGHT * 4];
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "limb", &view), TRL_OK);
    const double top_m = f->optics.top_radius_m - f->optics.ground_radius_m;
    view.pitch_rad = -0.17;
    view.altitude_m = top_m - 1;
    frame_check_draw(f->renderer, &view, WIDTH, HEIGHT, inside);
    view.altitude_m = top_m + 1;
    frame_check_draw(f->renderer, &view, WIDTH, HEIGHT, outside);
    float brightest = 0;
    float worst = 0;
    for (int k = 0; k < WIDTH * HEIGHT * 4; k++) {
        brightest = fmaxf(brightest, inside[k]);
        worst = fmaxf(worst, fabsf(inside[k] - outside[k]));
    }
    printf("boundary: %.3f %% of the brightest\n", 100 * (double)(worst / brightest));
    // Two metres move the limb by 1e-6 rad, a ten-thousandth of a pixel; floats of planet size
    // resolve half a metre of way.
    assert_true(worst < 0.005f * brightest);
}

// Away from the plane of star and zenith the table is wrong: nothing by day, much in twilight.
static void the_error_away_from_the_plane_is_as_documented(void **state)
{
    const struct fixture *f = *state;
    const struct {
        double sun_zenith_deg, azimuth_deg, least, most; // of single over exact, at 80 degrees
    } cases[] = {{60, 0, 0.999, 1.001}, {60, 90, 1, 1.01},    {60, 180, 1, 1.01},
                 {85, 90, 1, 1.1},      {85, 180, 1.01, 1.2}, {92, 0, 0.999, 1.001},
                 {92, 90, 1.1, 2.5},    {92, 180, 1.5, 1e3}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const double to_rad = M_PI / 180;
        const struct query_view view =
            query_view_make(f->optics.ground_radius_m, cases[i].sun_zenith_deg * to_rad,
                            80 * to_rad, cases[i].azimuth_deg * to_rad);
        lanes single;
        lanes exact;
        query_plane_radiance(f->query, &view, &single);
        query_radiance(f->query, &view, &exact);
        double sums[2] = {0};
        for (int k = 0; k < LANES; k++) {
            sums[0] += f->exact.xyz_from_lanes[1][k] * (double)single[k];
            sums[1] += f->exact.xyz_from_lanes[1][k] * (double)exact[k];
        }
        const double ratio = sums[0] / sums[1];
        printf("sun zenith %.0f, azimuth %3.0f: luminance %.3f of exact single scattering\n",
               cases[i].sun_zenith_deg, cases[i].azimuth_deg, ratio);
        assert_true(ratio > cases[i].least && ratio < cases[i].most);
    }
}

// Table 2's two ways of drawing show the same air as the pixels do, from where triangles are small.
static void spheres_show_the_same_air(void **state)
{
    const struct fixture *f = *state;
    static float pixels[WIDTH * HEIGHT * 4];
    static float spheres[WIDTH * HEIGHT * 4];
    static float errors[WIDTH * HEIGHT];
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "full-disc", &view), TRL_OK);
    frame_check_draw(f->renderer, &view, WIDTH, HEIGHT, pixels);
    const trl_single_drawing drawings[] = {TRL_SINGLE_SPHERES, TRL_SINGLE_VERTICES};
    // The same look-up; then 32 steps in four bands against all wavelengths.
    const float limits[] = {1e-4f, 0.03f};
    for (int d = 0; d < 2; d++) {
        assert_int_equal(trl_renderer_set_single_drawing(f->renderer, drawings[d], 96, 32), TRL_OK);
        frame_check_draw(f->renderer, &view, WIDTH, HEIGHT, spheres);
        size_t count = 0;
        for (int k = 0; k < WIDTH * HEIGHT; k++) {
            if (pixels[4 * k + 1] > 1) {
                errors[count++] = fabsf(spheres[4 * k + 1] / pixels[4 * k + 1] - 1);
            }
        }
        assert_true(count > 500);
        qsort(errors, count, sizeof *errors, compare_floats);
        printf("spheres, drawing %d: median %.4f %%\n", drawings[d],
               100 * (double)errors[count / 2]);
        assert_true(errors[count / 2] < limits[d]);
    }
    assert_int_equal(trl_renderer_set_single_drawing(f->renderer, TRL_SINGLE_PIXELS, 0, 0), TRL_OK);
    assert_int_equal(trl_renderer_set_single_drawing(f->renderer, TRL_SINGLE_SPHERES, 2, 0),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_renderer_set_single_drawing(f->renderer, TRL_SINGLE_VERTICES, 9, 0),
                     TRL_ERROR_INVALID);
}

static void models_are_switched_while_drawing(void **state)
{
    const struct fixture *f = *state;
    static float first[WIDTH * HEIGHT * 4];
    static float other[WIDTH * HEIGHT * 4];
    static float again[WIDTH * HEIGHT * 4];
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "ground", &view), TRL_OK);
    const trl_sky_model models[] = {TRL_SKY_SINGLE, TRL_SKY_SPECTRAL, TRL_SKY_SINGLE};
    float *const into[] = {first, other, again};
    for (int m = 0; m < 3; m++) {
        assert_int_equal(trl_renderer_set_sky_model(f->renderer, models[m]), TRL_OK);
        frame_check_draw(f->renderer, &view, WIDTH, HEIGHT, into[m]);
    }
    assert_memory_equal(first, again, sizeof first);
    const size_t sky = 4 * (size_t)(WIDTH / 4); // top row: more light with all orders
    assert_true(other[sky + 2] > 1.1f * first[sky + 2]);
}

static void every_pixel_is_finite(void **state)
{
    const struct fixture *f = *state;
    static const char *const scenes[] = {SINGLE_FRAME_SCENE, SINGLE_FRAME_SCENES "/no-air.json",
                                         SINGLE_FRAME_SCENES "/sixteen.json"};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        trl_scene *scene = NULL;
        trl_renderer *renderer = NULL;
        assert_int_equal(trl_scene_load(f->ctx, scenes[s], &scene), TRL_OK);
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = scene;
        desc.sky_model = TRL_SKY_SINGLE;
        assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_OK);
        frame_check_finite(renderer);
        trl_renderer_destroy(&renderer);
        trl_scene_destroy(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_the_numbers),
        cmocka_unit_test(the_boundary_of_the_air_does_not_show),
        cmocka_unit_test(the_error_away_from_the_plane_is_as_documented),
        cmocka_unit_test(spheres_show_the_same_air),
        cmocka_unit_test(models_are_switched_while_drawing),
        cmocka_unit_test(every_pixel_is_finite),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
