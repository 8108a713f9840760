// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames of the model rayleigh against the CPU's radiances of the same model for the same pixels
// and wavelengths: two programs of the same steps, so they differ by the float's resolution. All
// options that choose another program are drawn. Reported per view: difference of the colours in
// linear sRGB, relative to the largest component of the CPU's.
#include "scatter/rayleigh.h"
#include "scene/camera.h"
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

static void expected_colour(const struct subject *s, const struct camera *camera,
                            struct vec3 direction, float rgb[4])
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const struct query_view view = {.radius_m = vec3_length(camera->position_m),
                                    .sun_mu = vec3_dot(up, camera->sun_direction),
                                    .view_mu = vec3_dot(up, direction),
                                    .nu = vec3_dot(direction, camera->sun_direction)};
    double sum[3] = {0};
    for (uint32_t k = 0; k < s->model.desc.wavelengths; k++) {
        const double light = rayleigh_radiance(&s->model, &view, s->star.nm[k]);
        for (int i = 0; i < 3; i++) {
            sum[i] += s->star.rgb[k][i] * s->star.luminance * light;
        }
    }
    for (int i = 0; i < 3; i++) {
        rgb[i] = (float)sum[i];
    }
    rgb[3] = 1;
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

// The ray passes so near to the horizon or to the star that a pixel shows both sides.
static bool is_edge(const struct subject *s, const struct camera *camera, struct vec3 direction)
{
    const double pixel_rad = 2 * camera->tan_half_fov_y / HEIGHT;
    const struct vec3 up = vec3_normalize(camera->position_m);
    const double sine = s->f->scene->medium.ground_radius_m / vec3_length(camera->position_m);
    const double horizon_rad = M_PI - asin(fmin(1, sine));
    const double zenith_rad = acos(fmin(fmax(vec3_dot(up, direction), -1), 1));
    const double star_rad = acos(fmin(1, vec3_dot(direction, camera->sun_direction)));
    return fabs(zenith_rad - horizon_rad) < pixel_rad ||
           star_rad < s->f->scene->medium.star_angular_radius_rad + 2 * pixel_rad;
}

static void draw(trl_renderer *renderer, const trl_view *view, float *out)
{
    assert_int_equal(trl_renderer_draw(renderer, view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, out), TRL_OK);
}

static void check_view(const struct subject *s, const char *name, const trl_view *view)
{
    static float got[WIDTH * HEIGHT * 4];
    static float errors[WIDTH * HEIGHT];
    draw(s->renderer, view, got);
    const struct camera_place place = {.radius_m = s->f->scene->medium.ground_radius_m};
    const struct camera camera = camera_resolve(view, &place, (double)WIDTH / HEIGHT);
    size_t count = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const struct vec3 direction = vec3_normalize(
                camera_ray(&camera, 2 * (x + 0.5) / WIDTH - 1, 1 - 2 * (y + 0.5) / HEIGHT));
            float want[4];
            expected_colour(s, &camera, direction, want);
            const float *have = &got[4 * (y * WIDTH + x)];
            float largest = 0;
            float worst = 0;
            for (int k = 0; k < 3; k++) {
                largest = fmaxf(largest, want[k]);
                worst = fmaxf(worst, fabsf(have[k] - want[k]));
            }
            // Below a millionth of daylight nobody sees a colour.
            if (largest > 1e-3f && !is_edge(s, &camera, direction)) {
                errors[count++] = worst / largest;
            }
        }
    }
    assert_true(count > 100);
    qsort(errors, count, sizeof *errors, compare_floats);
    const double median = (double)errors[count / 2];
    const double most = (double)errors[count - 1 - count / 20];
    printf("%-10s %5zu pixels: median %.4f %%, 95 of 100 below %.4f %%, worst %.2f %%\n", name,
           count, 100 * median, 100 * most, 100 * (double)errors[count - 1]);
    assert_true(median < MEDIAN_LIMIT);
    assert_true(most < MOST_LIMIT);
}

static void check_options(const struct fixture *f, const trl_rayleigh_desc *options)
{
    static const char *const names[] = {"ground", "sunset", "twilight", "limb", "full-disc"};
    static struct subject s;
    begin(&s, f, options);
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        trl_view view;
        assert_int_equal(trl_scene_view(f->scene, names[i], &view), TRL_OK);
        check_view(&s, names[i], &view);
        if (i == 0) {
            view.altitude_m = 11000;
            view.pitch_rad = -0.4;
            check_view(&s, "aircraft", &view);
        }
    }
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
        draw(renderer, &view, frames[m]);
    }
    assert_memory_equal(frames[0], frames[2], sizeof frames[0]);
    assert_memory_not_equal(frames[0], frames[1], sizeof frames[0]);
    trl_renderer_destroy(&renderer);
}

// Poles, underground, the top of the air, far outside; no air, and air of which nothing is a gas.
static void every_pixel_is_finite(void **state)
{
    const struct fixture *f = *state;
    static const char *const scenes[] = {SINGLE_FRAME_SCENE, SINGLE_FRAME_SCENES "/no-air.json",
                                         SINGLE_FRAME_SCENES "/no-gas.json"};
    static const double altitudes_m[] = {-1000, 0, 1e5, 1e5 + 1e-3, 4e5, 1e9};
    static const double pitches_rad[] = {-M_PI_2, -0.3, 0, M_PI_2};
    static const double suns_rad[] = {M_PI_2, 0, -0.2, -M_PI_2};
    static float got[WIDTH * HEIGHT * 4];
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        trl_scene *scene = NULL;
        assert_int_equal(trl_scene_load(f->ctx, scenes[s], &scene), TRL_OK);
        trl_renderer *renderer = create(f, scene, NULL);
        for (int k = 0; k < 6 * 4 * 4 * 2; k++) {
            trl_view view = trl_view_default();
            view.altitude_mode = TRL_ALTITUDE_SPHERE;
            view.latitude_rad = k % 2 ? M_PI_2 : 0.3;
            view.altitude_m = altitudes_m[k / 2 % 6];
            view.pitch_rad = pitches_rad[k / 12 % 4];
            view.sun_mode = TRL_SUN_LOCAL;
            view.sun_latitude_or_elevation_rad = suns_rad[k / 48 % 4];
            draw(renderer, &view, got);
            for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
                assert_true(isfinite(got[i])); // red light may have negative blue
            }
        }
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
