// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames of the model rayleigh against the CPU's radiances of the same model for the same pixels
// and wavelengths: two programs of the same steps, so they differ by the float's resolution. All
// options that choose another program are drawn.
#include "frame_check.h"
#include "scatter/rayleigh.h"
#include "scene/scene.h"
#include <terrella/terrella.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 36 };

// Floats hold a height above a planet to 1e-4 of the scale height; colours are sums of ten terms,
// some of them negative.
static const double MEDIAN_LIMIT = 3e-4;
// One pixel in twenty, where the column changes with every metre of the closest point.
static const double MOST_LIMIT = 2e-3;

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
};

// One renderer and the model it should show.
struct subject {
    const struct fixture *f;
    trl_renderer *renderer;
    struct rayleigh model;
    struct rayleigh_star star;
};

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, SINGLE_FRAME_SCENE, &f->scene), TRL_OK);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    free(f);
    return 0;
}

static trl_renderer *create(const struct fixture *f, const trl_scene *scene,
                            const trl_rayleigh_desc *options)
{
    trl_renderer *renderer = NULL;
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    desc.sky_model = TRL_SKY_RAYLEIGH;
    desc.rayleigh = options;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_OK);
    return renderer;
}

static void begin(struct subject *s, const struct fixture *f, const trl_rayleigh_desc *options)
{
    s->f = f;
    s->renderer = create(f, f->scene, options);
    rayleigh_init(&s->model, &f->scene->medium, options);
    rayleigh_star_init(&s->model, &s->star);
}

static void find_colour(const void *model, const struct query_view *view, float rgb[3])
{
    const struct subject *s = model;
    double sum[3] = {0};
    for (uint32_t k = 0; k < s->model.desc.wavelengths; k++) {
        const double light = rayleigh_radiance(&s->model, view, s->star.nm[k]);
        for (int i = 0; i < 3; i++) {
            sum[i] += s->star.rgb[k][i] * s->star.luminance * light;
        }
    }
    for (int i = 0; i < 3; i++) {
        rgb[i] = (float)sum[i];
    }
}

static void check_options(const struct fixture *f, const trl_rayleigh_desc *options)
{
    struct subject s;
    begin(&s, f, options);
    const struct frame_check check = {.ctx = f->ctx,
                                      .scene = f->scene,
                                      .renderer = s.renderer,
                                      .name = "rayleigh-frame",
                                      .width = WIDTH,
                                      .height = HEIGHT,
                                      .median_limit = MEDIAN_LIMIT,
                                      .most_limit = MOST_LIMIT,
                                      .expect = find_colour,
                                      .model = &s};
    frame_check_all(&check);
    trl_renderer_destroy(&s.renderer);
}

static void frames_are_the_numbers(void **state)
{
    const trl_rayleigh_desc options = trl_rayleigh_desc_default();
    check_options(*state, &options);
}

static void frames_of_the_fit_are_the_numbers(void **state)
{
    trl_rayleigh_desc options = trl_rayleigh_desc_default();
    options.optical_depth = TRL_RAYLEIGH_FIT;
    options.samples = 13;
    options.wavelengths = 3;
    check_options(*state, &options);
}

static void frames_of_high_air_are_the_numbers(void **state)
{
    trl_rayleigh_desc options = trl_rayleigh_desc_default();
    options.height_scale = 15; // Fig. 7
    options.has_out_scattering = false;
    check_options(*state, &options);
}

static void models_are_switched_while_drawing(void **state)
{
    const struct fixture *f = *state;
    static float frames[3][WIDTH * HEIGHT * 4];
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "ground", &view), TRL_OK);
    trl_renderer *renderer = create(f, f->scene, NULL);
    const trl_sky_model models[] = {TRL_SKY_RAYLEIGH, TRL_SKY_SINGLE, TRL_SKY_RAYLEIGH};
    for (int m = 0; m < 3; m++) {
        assert_int_equal(trl_renderer_set_sky_model(renderer, models[m]), TRL_OK);
        assert_int_equal(trl_renderer_sky_model(renderer), models[m]);
        frame_check_draw(renderer, &view, WIDTH, HEIGHT, frames[m]);
    }
    assert_memory_equal(frames[0], frames[2], sizeof frames[0]);
    assert_memory_not_equal(frames[0], frames[1], sizeof frames[0]);
    trl_renderer_destroy(&renderer);
}

// Without air, and in air of which nothing is a gas.
static void every_pixel_is_finite(void **state)
{
    const struct fixture *f = *state;
    static const char *const scenes[] = {SINGLE_FRAME_SCENE, SINGLE_FRAME_SCENES "/no-air.json",
                                         SINGLE_FRAME_SCENES "/no-gas.json"};
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        trl_scene *scene = NULL;
        assert_int_equal(trl_scene_load(f->ctx, scenes[s], &scene), TRL_OK);
        trl_renderer *renderer = create(f, scene, NULL);
        frame_check_finite(renderer);
        trl_renderer_destroy(&renderer);
        trl_scene_destroy(&scene);
    }
}

static void wrong_options_are_refused(void **state)
{
    const struct fixture *f = *state;
    trl_rayleigh_desc wrong[10];
    for (int i = 0; i < 10; i++) {
        wrong[i] = trl_rayleigh_desc_default();
    }
    wrong[0].samples = 4;
    wrong[1].samples = TRL_RAYLEIGH_MAX_SAMPLES + 2;
    wrong[2].wavelengths = 2;
    wrong[3].wavelengths = TRL_RAYLEIGH_MAX_WAVELENGTHS + 1;
    wrong[4].fit_heights = 1;
    wrong[5].fit_degree = TRL_RAYLEIGH_MAX_DEGREE + 1;
    wrong[6].height_scale = 0;
    wrong[7].height_scale = NAN;
    wrong[8].star_temperature_K = 100;
    memset(&wrong[9], 0, sizeof wrong[9]); // not from trl_rayleigh_desc_default()
    for (int i = 0; i < 10; i++) {
        trl_renderer *renderer = NULL;
        trl_rayleigh_errors errors;
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = f->scene;
        desc.sky_model = TRL_SKY_RAYLEIGH;
        desc.rayleigh = &wrong[i];
        assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_ERROR_INVALID);
        assert_null(renderer);
        assert_int_equal(trl_rayleigh_errors_read(f->ctx, f->scene, &wrong[i], &errors),
                         TRL_ERROR_INVALID);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_are_the_numbers),
        cmocka_unit_test(frames_of_the_fit_are_the_numbers),
        cmocka_unit_test(frames_of_high_air_are_the_numbers),
        cmocka_unit_test(models_are_switched_while_drawing),
        cmocka_unit_test(every_pixel_is_finite),
        cmocka_unit_test(wrong_options_are_refused),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
