// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Pictures by the path tracer: their colours against a fine spectrum, their pixels against queries
// at single wavelengths, their standard errors against both; and what a picture promises besides.
#include "reference/palette.h"
#include "reference/path_tracer.h"
#include "reference/picture.h"
#include "reference_media.h"
#include "spectrum/cie.h"

#include <math.h>
#include <omp.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;

// A context whose memory runs out and that may be stopped.
struct fixture {
    trl_context *ctx;
    int allocations_left; // negative: any number
    int blocks;           // in use
    int reports_left;     // of progress, before it asks to stop; negative: never
};

static void *allocate(void *user, size_t bytes)
{
    struct fixture *f = user;
    if (f->allocations_left == 0) {
        return NULL;
    }
    f->allocations_left -= f->allocations_left > 0;
    ++f->blocks;
    return calloc(1, bytes);
}

static void *reallocate(void *user, void *block, size_t bytes)
{
    (void)user;
    return realloc(block, bytes);
}

static void release(void *user, void *block)
{
    struct fixture *f = user;
    f->blocks -= block != NULL;
    free(block);
}

static bool report(void *user, const char *stage, double fraction)
{
    (void)stage;
    (void)fraction;
    struct fixture *f = user;
    f->reports_left -= f->reports_left > 0;
    return f->reports_left != 0;
}

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    f->allocations_left = f->reports_left = -1;
    trl_context_desc desc = trl_context_desc_default();
    desc.cache_dir = "";
    desc.allocator = (trl_allocator){allocate, reallocate, release, f};
    desc.progress = report;
    desc.progress_user = f;
    *state = f;
    return trl_context_create(&desc, &f->ctx) == TRL_OK ? 0 : -1;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    trl_context_destroy(&f->ctx);
    const int left = f->blocks;
    free(f);
    return left;
}

static struct spectrum power_law(double value, double exponent)
{
    return (struct spectrum){.kind = SPECTRUM_POWER_LAW, .power_law = {550, value, exponent}};
}

// Blue air, grey haze, ground that gets brighter to the red, a black body's light.
static struct medium coloured_medium(void)
{
    struct medium medium = earth_like_medium(0.2);
    medium.constituents[0].scattering_per_m = power_law(1.2e-5, -4);
    medium.ground_albedo = power_law(0.15, 2);
    medium.star_irradiance =
        (struct spectrum){.kind = SPECTRUM_BLACKBODY, .blackbody = {5770, 1361}};
    medium.star_angular_radius_rad = 0.27 * pi / 180;
    return medium;
}

static double rayleigh_like(double nm)
{
    return exp(-0.1 * pow(nm / 550, -4)) * 0.3 * pow(nm / 550, -4);
}

static void bins_see_what_a_fine_spectrum_shows(void **state)
{
    (void)state;
    const struct medium medium = coloured_medium();
    struct palette palette;
    palette_make(&medium, &palette);
    struct cie_xyz xyz = {0, 0, 0};
    for (double nm = CIE_FIRST_NM; nm < CIE_LAST_NM; nm += 1) {
        const struct cie_xyz o = cie_observer_integral(nm, nm + 1);
        const double light = CIE_LUMENS_PER_WATT * rayleigh_like(nm + 0.5) *
                             spectrum_at(&medium.star_irradiance, nm + 0.5);
        xyz.x += o.x * light;
        xyz.y += o.y * light;
        xyz.z += o.z * light;
    }
    const struct cie_rgb fine = cie_rgb_of_xyz(xyz);
    const double expected[3] = {fine.r, fine.g, fine.b};
    for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (int i = 0; i < PALETTE_BINS; ++i) {
            sum += palette.rgb[i][c] * rayleigh_like(palette.nm[i]);
        }
        // The bins at the ends are some tens of nm wide.
        assert_true(fabs(sum - expected[c]) < 5e-4 * fine.b);
    }
}

static void colours_of_ground_are_seen_as_they_are(void **state)
{
    (void)state;
    const struct medium medium = coloured_medium();
    struct palette palette;
    palette_make(&medium, &palette);
    for (int colour = 0; colour < 3; ++colour) {
        for (int c = 0; c < 3; ++c) {
            double white = 0, sum = 0;
            for (int i = 0; i < PALETTE_BINS; ++i) {
                white += palette.rgb[i][c];
                sum += palette.rgb[i][c] * palette.albedo_of_colour[colour][i];
            }
            assert_true(fabs(sum / white - (c == colour)) < 1e-9);
        }
    }
    for (int i = 0; i < PALETTE_BINS; ++i) {
        const double white = palette.albedo_of_colour[0][i] + palette.albedo_of_colour[1][i] +
                             palette.albedo_of_colour[2][i];
        assert_true(fabs(white - 1) < 1e-9);
    }
}

enum { WIDTH = 8, HEIGHT = 6, PIXELS = WIDTH * HEIGHT };

// 1 km up, toward the horizon and a low star beside the picture.
static struct camera make_camera(const struct medium *medium)
{
    return (struct camera){
        .position_m = {0, 0, medium->ground_radius_m + 1e3},
        .right = {0, -1, 0},
        .up = {0, 0, 1},
        .forward = {1, 0, 0},
        .tan_half_fov_x = 0.8,
        .tan_half_fov_y = 0.6,
        .sun_direction = {cos(0.35), sin(0.35) * sin(0.9), sin(0.35) * cos(0.9)}};
}

// The spectral radiance of a pixel's middle at all wavelengths of a palette, seen in colour.
static void ask_pixel(const trl_context *ctx, const struct medium *medium,
                      const struct camera *camera, struct vec3 direction, double rgb[2][3])
{
    struct palette palette;
    palette_make(medium, &palette);
    const double toward =
        vec3_dot(camera->sun_direction, (struct vec3){direction.x, direction.y, 0});
    const double across =
        camera->sun_direction.x * direction.y - camera->sun_direction.y * direction.x;
    trl_sky_query queries[PALETTE_BINS];
    double radiance[PALETTE_BINS], error[PALETTE_BINS];
    for (int i = 0; i < PALETTE_BINS; ++i) {
        queries[i] = (trl_sky_query){1e3, acos(camera->sun_direction.z), acos(direction.z),
                                     atan2(across, toward), palette.nm[i]};
    }
    const struct reference_desc desc = {.paths = 300, .seed = 17};
    assert_int_equal(
        reference_sky_radiance(ctx, medium, queries, PALETTE_BINS, &desc, radiance, error), TRL_OK);
    for (int c = 0; c < 3; ++c) {
        rgb[0][c] = rgb[1][c] = 0;
        for (int i = 0; i < PALETTE_BINS; ++i) {
            const double weight =
                palette.rgb[i][c] / spectrum_at(&medium->star_irradiance, palette.nm[i]);
            rgb[0][c] += weight * radiance[i];
            rgb[1][c] += pow(weight * error[i], 2);
        }
        rgb[1][c] = sqrt(rgb[1][c]);
    }
}

static void trace(const struct fixture *f, const struct medium *medium, uint64_t seed, float *rgba,
                  float *error)
{
    const struct camera camera = make_camera(medium);
    const struct reference_scene scene = {.medium = medium};
    const struct reference_picture picture = {
        .camera = &camera, .width = WIDTH, .height = HEIGHT, .paths = 512, .seed = seed};
    assert_int_equal(
        reference_picture_trace(f->ctx, &scene, &picture, &(struct reference_sheets){rgba, error}),
        TRL_OK);
}

static void pixels_agree_with_queries_at_single_wavelengths(void **state)
{
    const struct fixture *f = *state;
    const struct medium medium = coloured_medium();
    const struct camera camera = make_camera(&medium);
    float rgba[4 * PIXELS], error[4 * PIXELS];
    trace(f, &medium, 3, rgba, error);
    double squares = 0;
    int count = 0;
    for (int pixel = 3; pixel < PIXELS; pixel += 5) {
        const double x = 2 * (pixel % WIDTH + 0.5) / WIDTH - 1;
        const double y = 1 - 2 * (pixel / WIDTH + 0.5) / HEIGHT;
        const struct vec3 direction = vec3_normalize(camera_ray(&camera, x, y));
        double asked[2][3];
        ask_pixel(f->ctx, &medium, &camera, direction, asked);
        for (int c = 0; c < 3; ++c) {
            const double got = (double)rgba[4 * pixel + c], noise = (double)error[4 * pixel + c];
            // Bins stand for their spectrum within 5e-4 of the largest component.
            const double z = (got - asked[0][c]) / hypot(hypot(noise, asked[1][c]), 5e-4 * got);
            // One of 30 values beyond 4 standard errors: once in 500 seeds.
            if (!(fabs(z) < 4) || !(noise < 0.12 * fmax(got, asked[0][0]))) {
                fail_msg("pixel %d, %d: %g +- %g, asked %g +- %g", pixel, c, got, noise,
                         asked[0][c], asked[1][c]);
            }
            squares += z * z;
            ++count;
        }
    }
    // The three colours of a pixel are nearly one number: the sum of squares has a third as many
    // degrees of freedom, and four of its standard deviations are allowed.
    const double spread = sqrt(2.0 * 3 / count);
    assert_true(squares / count < 1 + 4 * spread && squares / count > 1 - 3 * spread);
}

static void errors_say_how_far_pictures_differ(void **state)
{
    const struct fixture *f = *state;
    const struct medium medium = coloured_medium();
    float a[4 * PIXELS], b[4 * PIXELS], a_error[4 * PIXELS], b_error[4 * PIXELS];
    trace(f, &medium, 4, a, a_error);
    trace(f, &medium, 5, b, b_error);
    double squares = 0;
    for (int i = 0; i < PIXELS; ++i) {
        const double noise = hypot((double)a_error[4 * i + 1], (double)b_error[4 * i + 1]);
        const double z = ((double)a[4 * i + 1] - (double)b[4 * i + 1]) / noise;
        assert_true(fabs(z) < 4.5); // Bonferroni: one of 48 in 3000 pairs
        squares += z * z;
    }
    // The mean of 48 squares is 1 +- 0.2.
    assert_true(squares / PIXELS > 0.4 && squares / PIXELS < 1.8);
}

static void star_is_seen_with_its_own_radiance(void **state)
{
    const struct fixture *f = *state;
    struct medium medium = empty_medium(0);
    medium.star_angular_radius_rad = 0.02;
    struct camera camera = make_camera(&medium);
    camera.sun_direction = camera.forward;
    camera.tan_half_fov_x = camera.tan_half_fov_y = 0.03;
    float rgba[4], error[4];
    const struct reference_scene scene = {.medium = &medium};
    const struct reference_picture picture = {
        .camera = &camera, .width = 1, .height = 1, .paths = 20000, .seed = 6, .pixel_width = 1};
    // Nothing hides half of it but the ground's horizon, 1 km below: 1 degree.
    camera.position_m.z += 1e6;
    assert_int_equal(
        reference_picture_trace(f->ctx, &scene, &picture, &(struct reference_sheets){rgba, error}),
        TRL_OK);
    struct palette palette;
    palette_make(&medium, &palette);
    // Its irradiance, from solid angles within 0.03: the tangent plane's differ by 1e-3.
    const double expected = palette.luminance / pow(2 * 0.03, 2);
    const double got =
        0.2126 * (double)rgba[0] + 0.7152 * (double)rgba[1] + 0.0722 * (double)rgba[2];
    assert_true(fabs(got / expected - 1) < 4 * (double)error[1] / (double)rgba[1] + 2e-3);
    assert_true((double)error[1] < 0.02 * (double)rgba[1]);
}

static void threads_do_not_change_pictures(void **state)
{
    const struct fixture *f = *state;
    const struct medium medium = coloured_medium();
    const int before = omp_get_max_threads();
    float one[4 * PIXELS], many[4 * PIXELS], error[2][4 * PIXELS];
    omp_set_num_threads(1);
    trace(f, &medium, 8, one, error[0]);
    omp_set_num_threads(3);
    trace(f, &medium, 8, many, error[1]);
    omp_set_num_threads(before);
    assert_memory_equal(one, many, sizeof one);
    assert_memory_equal(error[0], error[1], sizeof error[0]);
}

static trl_result trace_small(const struct fixture *f)
{
    const struct medium medium = coloured_medium();
    const struct camera camera = make_camera(&medium);
    const struct reference_scene scene = {.medium = &medium};
    const struct reference_picture picture = {
        .camera = &camera, .width = 2, .height = 40, .paths = 1, .seed = 1};
    float rgba[4 * 80], error[4 * 80];
    return reference_picture_trace(f->ctx, &scene, &picture,
                                   &(struct reference_sheets){rgba, error});
}

static void pictures_can_be_stopped(void **state)
{
    struct fixture *f = *state;
    const int before = f->blocks;
    for (int reports = 1; reports <= 4; ++reports) {
        f->reports_left = reports;
        assert_int_equal(trace_small(f), TRL_ERROR_CANCELLED);
        assert_int_equal(f->blocks, before);
    }
    f->reports_left = -1;
}

static void memory_that_runs_out_leaves_nothing(void **state)
{
    struct fixture *f = *state;
    const int before = f->blocks;
    trl_result result = TRL_ERROR_MEMORY;
    int count = 0;
    for (; result == TRL_ERROR_MEMORY && count < 100; ++count) {
        f->allocations_left = count;
        result = trace_small(f);
        assert_int_equal(f->blocks, before);
    }
    f->allocations_left = -1;
    assert_int_equal(result, TRL_OK);
    assert_true(count > 5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bins_see_what_a_fine_spectrum_shows),
        cmocka_unit_test(colours_of_ground_are_seen_as_they_are),
        cmocka_unit_test(pixels_agree_with_queries_at_single_wavelengths),
        cmocka_unit_test(errors_say_how_far_pictures_differ),
        cmocka_unit_test(star_is_seen_with_its_own_radiance),
        cmocka_unit_test(threads_do_not_change_pictures),
        cmocka_unit_test(pictures_can_be_stopped),
        cmocka_unit_test(memory_that_runs_out_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
