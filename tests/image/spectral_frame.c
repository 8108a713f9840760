// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The GPU's frame against the CPU's spectral answer for the same pixels: every stage between the
// solved moments and the colour of a pixel (four bands, 4D table, aerial perspective, light on the
// ground, projections) at once. Reported per view: difference of the colours in linear sRGB,
// relative to the largest component of the spectral one. Failing views leave got, expected and
// difference as pictures beside the test's working folder.
#include "scatter/atmosphere.h"
#include "scatter/query.h"
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

enum { WIDTH = 96, HEIGHT = 54 };

// The target of the project; the tables are made for half of it.
static const double MEDIAN_LIMIT = 0.02;
// One pixel in twenty may be worse, up to this: where the limb or twilight changes within a texel.
static const double MOST_LIMIT = 0.06;

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
    trl_renderer *renderer;
    struct atmosphere *atmosphere;
    struct band_fit exact; // its exact matrix from all wavelengths to colour
    struct query *query;
};

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    f->ctx = NULL;
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, SPECTRAL_FRAME_SCENE, &f->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = f->scene;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &f->renderer), TRL_OK);
    const struct atmosphere_desc atmosphere = atmosphere_desc_default();
    assert_int_equal(atmosphere_create(f->ctx, &f->scene->medium, &atmosphere, &f->atmosphere),
                     TRL_OK);
    band_fit_init(&f->exact, f->atmosphere->optics);
    assert_int_equal(query_create(f->ctx, &f->atmosphere->solution, &f->query), TRL_OK);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    query_destroy(f->ctx, &f->query);
    atmosphere_destroy(&f->atmosphere);
    trl_renderer_destroy(&f->renderer);
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    free(f);
    return 0;
}

// Colour of one direction by the CPU.
static void spectral_colour(const struct fixture *f, const struct camera *camera,
                            struct vec3 direction, float rgb[3])
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const struct query_view view = {.radius_m = vec3_length(camera->position_m),
                                    .sun_mu = vec3_dot(up, camera->sun_direction),
                                    .view_mu = vec3_dot(up, direction),
                                    .nu = vec3_dot(direction, camera->sun_direction)};
    lanes radiance;
    query_radiance(f->query, &view, &radiance);
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += f->exact.rgb_from_lanes[k][i] * (double)radiance[i];
        }
        rgb[k] = (float)sum;
    }
}

static int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

// The pixels whose ray passes so near to the horizon or to the star's edge that a pixel shows both
// sides.
static bool is_edge(const struct fixture *f, const struct camera *camera, struct vec3 direction,
                    double pixel_rad)
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const double sine = f->atmosphere->optics->ground_radius_m / vec3_length(camera->position_m);
    const double horizon_rad = M_PI - asin(fmin(1, sine));
    const double zenith_rad = acos(vec3_dot(up, direction));
    const double star_rad = acos(fmin(1, vec3_dot(direction, camera->sun_direction)));
    return fabs(zenith_rad - horizon_rad) < pixel_rad ||
           star_rad < f->atmosphere->solution.sun.disc_rad + 2 * pixel_rad;
}

static void write_failure(const struct fixture *f, const char *view, const char *what,
                          const float *rgba)
{
    char path[128];
    snprintf(path, sizeof path, "spectral-frame-%s-%s.exr", view, what);
    assert_int_equal(trl_image_write_exr(f->ctx, path, WIDTH, HEIGHT, rgba), TRL_OK);
    fprintf(stderr, "left %s\n", path);
}

static void check(const struct fixture *f, const char *name, const trl_view *view)
{
    static float got[WIDTH * HEIGHT * 4];
    static float expected[WIDTH * HEIGHT * 4];
    static float difference[WIDTH * HEIGHT * 4];
    static float errors[WIDTH * HEIGHT];
    assert_int_equal(trl_renderer_draw(f->renderer, view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(f->renderer, got), TRL_OK);
    const struct camera_place place = {.radius_m = f->scene->medium.ground_radius_m};
    const struct camera camera = camera_resolve(view, &place, (double)WIDTH / HEIGHT);
    const double pixel_rad = 2 * camera.tan_half_fov_y / HEIGHT;
    size_t count = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const struct vec3 direction = vec3_normalize(
                camera_ray(&camera, 2 * (x + 0.5) / WIDTH - 1, 1 - 2 * (y + 0.5) / HEIGHT));
            float *want = &expected[4 * (y * WIDTH + x)];
            spectral_colour(f, &camera, direction, want);
            const float *have = &got[4 * (y * WIDTH + x)];
            float largest = 0;
            float worst = 0;
            for (int k = 0; k < 3; k++) {
                largest = fmaxf(largest, want[k]);
                worst = fmaxf(worst, fabsf(have[k] - want[k]));
                difference[4 * (y * WIDTH + x) + k] = have[k] - want[k];
            }
            // Below a millionth of daylight nobody sees a colour.
            if (largest > 1e-3f && !is_edge(f, &camera, direction, pixel_rad)) {
                errors[count++] = worst / largest;
            }
        }
    }
    assert_true(count > 100);
    qsort(errors, count, sizeof *errors, compare_floats);
    const double median = (double)errors[count / 2];
    const double most = (double)errors[count - 1 - count / 20];
    printf("%-12s %5zu pixels: median %.2f %%, 95 of 100 below %.2f %%, worst %.2f %%\n", name,
           count, 100 * median, 100 * most, 100 * (double)errors[count - 1]);
    if (!(median < MEDIAN_LIMIT && most < MOST_LIMIT)) {
        write_failure(f, name, "got", got);
        write_failure(f, name, "expected", expected);
        write_failure(f, name, "difference", difference);
    }
    assert_true(median < MEDIAN_LIMIT);
    assert_true(most < MOST_LIMIT);
}

static void check_view(const struct fixture *f, const char *name)
{
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, name, &view), TRL_OK);
    check(f, name, &view);
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

// Along the terminator light falls by factors from one azimuth to the next.
static void half_disc_from_afar(void **state)
{
    const struct fixture *f = *state;
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "full-disc", &view), TRL_OK);
    view.sun_mode = TRL_SUN_SUBSOLAR;
    view.sun_latitude_or_elevation_rad = 0.17;
    view.sun_longitude_or_azimuth_rad = 1.05;
    check(f, "half-disc", &view);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(day_from_the_ground),      cmocka_unit_test(sunset_from_the_ground),
        cmocka_unit_test(twilight_from_the_ground), cmocka_unit_test(limb_from_orbit),
        cmocka_unit_test(full_disc_from_afar),      cmocka_unit_test(half_disc_from_afar),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
