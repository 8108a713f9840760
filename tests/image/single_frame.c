// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames of the model single against the CPU's answer of the same model for the same pixels: every
// stage between the integral and a pixel's colour (four bands, the 128^3 table and its coordinates,
// the optical depth, light on the ground) at once. Reported per view: difference of the colours in
// linear sRGB, relative to the largest component of the CPU's.
#include "scatter/bands.h"
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

static void to_colour(const struct fixture *f, const lanes *radiance, float rgb[3])
{
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += f->exact.rgb_from_lanes[k][i] * (double)(*radiance)[i];
        }
        rgb[k] = (float)sum;
    }
}

// Colour of one direction by the CPU.
static void expected_colour(const struct fixture *f, const struct camera *camera,
                            struct vec3 direction, float rgb[3])
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const struct query_view view = {.radius_m = vec3_length(camera->position_m),
                                    .sun_mu = vec3_dot(up, camera->sun_direction),
                                    .view_mu = vec3_dot(up, direction),
                                    .nu = vec3_dot(direction, camera->sun_direction)};
    lanes radiance;
    query_plane_radiance(f->query, &view, &radiance);
    to_colour(f, &radiance, rgb);
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
    const double sine = f->optics.ground_radius_m / vec3_length(camera->position_m);
    const double horizon_rad = M_PI - asin(fmin(1, sine));
    const double zenith_rad = acos(fmin(fmax(vec3_dot(up, direction), -1), 1));
    const double star_rad = acos(fmin(1, vec3_dot(direction, camera->sun_direction)));
    return fabs(zenith_rad - horizon_rad) < pixel_rad ||
           star_rad < f->solution.sun.disc_rad + 2 * pixel_rad;
}

static void write_failure(const struct fixture *f, const char *view, const char *what,
                          const float *rgba)
{
    char path[128];
    snprintf(path, sizeof path, "single-frame-%s-%s.exr", view, what);
    assert_int_equal(trl_image_write_exr(f->ctx, path, WIDTH, HEIGHT, rgba), TRL_OK);
    fprintf(stderr, "left %s\n", path);
}

static struct vec3 pixel_direction(const struct camera *camera, int x, int y)
{
    return vec3_normalize(
        camera_ray(camera, 2 * (x + 0.5) / WIDTH - 1, 1 - 2 * (y + 0.5) / HEIGHT));
}

static void check_view(const struct fixture *f, const char *name, const trl_view *view)
{
    static float got[WIDTH * HEIGHT * 4];
    static float expected[WIDTH * HEIGHT * 4];
    static float errors[WIDTH * HEIGHT];
    assert_int_equal(trl_renderer_draw(f->renderer, view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(f->renderer, got), TRL_OK);
    const struct camera_place place = {.radius_m = f->scene->medium.ground_radius_m};
    const struct camera camera = camera_resolve(view, &place, (double)WIDTH / HEIGHT);
    const double pixel_rad = 2 * camera.tan_half_fov_y / HEIGHT;
    size_t count = 0;
    for (int y = 0; y < HEIGHT; y++) {
        for (int x = 0; x < WIDTH; x++) {
            const struct vec3 direction = pixel_direction(&camera, x, y);
            float *want = &expected[4 * (y * WIDTH + x)];
            expected_colour(f, &camera, direction, want);
            want[3] = 1;
            const float *have = &got[4 * (y * WIDTH + x)];
            float largest = 0;
            float worst = 0;
            for (int k = 0; k < 3; k++) {
                largest = fmaxf(largest, want[k]);
                worst = fmaxf(worst, fabsf(have[k] - want[k]));
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
    printf("%-16s %5zu pixels: median %.2f %%, 95 of 100 below %.2f %%, worst %.2f %%\n", name,
           count, 100 * median, 100 * most, 100 * (double)errors[count - 1]);
    if (!(median < MEDIAN_LIMIT && most < MOST_LIMIT)) {
        write_failure(f, name, "got", got);
        write_failure(f, name, "expected", expected);
    }
    assert_true(median < MEDIAN_LIMIT);
    assert_true(most < MOST_LIMIT);
}

static void check_named_view(const struct fixture *f, const char *name)
{
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, name, &view), TRL_OK);
    check_view(f, name, &view);
}

static void day_from_the_ground(void **state)
{
    check_named_view(*state, "ground");
}

static void sunset_from_the_ground(void **state)
{
    check_named_view(*state, "sunset");
}

static void twilight_from_the_ground(void **state)
{
    check_named_view(*state, "twilight");
}

static void limb_from_orbit(void **state)
{
    check_named_view(*state, "limb");
}

static void full_disc_from_afar(void **state)
{
    check_named_view(*state, "full-disc");
}

static void ground_from_an_aircraft(void **state)
{
    const struct fixture *f = *state;
    trl_view view;
    assert_int_equal(trl_scene_view(f->scene, "ground", &view), TRL_OK);
    view.altitude_m = 11000;
    view.pitch_rad = -0.4;
    check_view(f, "aircraft", &view);
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
    assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(f->renderer, inside), TRL_OK);
    view.altitude_m = top_m + 1;
    assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(f->renderer, outside), TRL_OK);
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
    assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(f->renderer, pixels), TRL_OK);
    const trl_single_drawing drawings[] = {TRL_SINGLE_SPHERES, TRL_SINGLE_VERTICES};
    // The same look-up; then 32 steps in four bands against all wavelengths.
    const float limits[] = {1e-4f, 0.03f};
    for (int d = 0; d < 2; d++) {
        assert_int_equal(trl_renderer_set_single_drawing(f->renderer, drawings[d], 96, 32), TRL_OK);
        assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(f->renderer, spheres), TRL_OK);
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
        assert_int_equal(trl_renderer_draw(f->renderer, &view, WIDTH, HEIGHT, 0), TRL_OK);
        assert_int_equal(trl_renderer_read_radiance(f->renderer, into[m]), TRL_OK);
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
    static const double altitudes_m[] = {-1000, 0, 1e5, 1e5 + 1e-3, 4e5, 1e9};
    static const double pitches_rad[] = {-M_PI_2, -0.3, 0, M_PI_2};
    static const double suns_rad[] = {M_PI_2, 0, -0.2, -M_PI_2};
    static float got[32 * 24 * 4];
    for (size_t s = 0; s < sizeof scenes / sizeof *scenes; s++) {
        trl_scene *scene = NULL;
        trl_renderer *renderer = NULL;
        assert_int_equal(trl_scene_load(f->ctx, scenes[s], &scene), TRL_OK);
        trl_renderer_desc desc = trl_renderer_desc_default();
        desc.scene = scene;
        desc.sky_model = TRL_SKY_SINGLE;
        assert_int_equal(trl_renderer_create(f->ctx, &desc, &renderer), TRL_OK);
        for (int k = 0; k < 6 * 4 * 4 * 2; k++) {
            trl_view view = trl_view_default();
            view.altitude_mode = TRL_ALTITUDE_SPHERE;
            view.latitude_rad = k % 2 ? M_PI_2 : 0.3;
            view.altitude_m = altitudes_m[k / 2 % 6];
            view.pitch_rad = pitches_rad[k / 12 % 4];
            view.sun_mode = TRL_SUN_LOCAL;
            view.sun_latitude_or_elevation_rad = suns_rad[k / 48 % 4];
            assert_int_equal(trl_renderer_draw(renderer, &view, 32, 24, 0), TRL_OK);
            assert_int_equal(trl_renderer_read_radiance(renderer, got), TRL_OK);
            for (int i = 0; i < 32 * 24 * 4; i++) {
                assert_true(isfinite(got[i]));
            }
        }
        trl_renderer_destroy(&renderer);
        trl_scene_destroy(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(day_from_the_ground),
        cmocka_unit_test(sunset_from_the_ground),
        cmocka_unit_test(twilight_from_the_ground),
        cmocka_unit_test(limb_from_orbit),
        cmocka_unit_test(full_disc_from_afar),
        cmocka_unit_test(ground_from_an_aircraft),
        cmocka_unit_test(the_boundary_of_the_air_does_not_show),
        cmocka_unit_test(the_error_away_from_the_plane_is_as_documented),
        cmocka_unit_test(spheres_show_the_same_air),
        cmocka_unit_test(models_are_switched_while_drawing),
        cmocka_unit_test(every_pixel_is_finite),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
