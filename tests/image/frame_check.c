// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame_check.h"

#include "scene/camera.h"
#include "scene/scene.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

int compare_floats(const void *a, const void *b)
{
    const float x = *(const float *)a;
    const float y = *(const float *)b;
    return (x > y) - (x < y);
}

void frame_check_colour(const struct band_fit *exact, const lanes *radiance, float rgb[3])
{
    for (int k = 0; k < 3; k++) {
        double sum = 0;
        for (int i = 0; i < LANES; i++) {
            sum += exact->rgb_from_lanes[k][i] * (double)(*radiance)[i];
        }
        rgb[k] = (float)sum;
    }
}

void frame_check_draw(trl_renderer *renderer, const trl_view *view, uint32_t width, uint32_t height,
                      float *rgba)
{
    assert_int_equal(trl_renderer_draw(renderer, view, width, height, 0), TRL_OK);
    assert_int_equal(trl_renderer_read_radiance(renderer, rgba), TRL_OK);
}

struct pictures {
    float *got, *expected, *difference; // RGBA
    float *errors;                      // of the pixels that are compared
    size_t compared;
};

static struct pictures create_pictures(size_t pixels)
{
    struct pictures p = {calloc(pixels, 4 * sizeof(float)), calloc(pixels, 4 * sizeof(float)),
                         calloc(pixels, 4 * sizeof(float)), calloc(pixels, sizeof(float)), 0};
    assert_true(p.got && p.expected && p.difference && p.errors);
    return p;
}

static void destroy_pictures(struct pictures *p)
{
    free(p->got);
    free(p->expected);
    free(p->difference);
    free(p->errors);
}

// The ray passes so near to the horizon or to the star's edge that a pixel shows both sides.
static bool is_edge(const struct frame_check *c, const struct camera *camera,
                    const struct query_view *view)
{
    const double pixel_rad = 2 * camera->tan_half_fov_y / c->height;
    const double sine = c->scene->medium.ground_radius_m / view->radius_m;
    const double horizon_rad = M_PI - asin(fmin(1, sine));
    const double zenith_rad = acos(fmin(fmax(view->view_mu, -1), 1));
    const double star_rad = acos(fmin(1, view->nu));
    return fabs(zenith_rad - horizon_rad) < pixel_rad ||
           star_rad < c->scene->medium.star_angular_radius_rad + 2 * pixel_rad;
}

static struct query_view pixel_view(const struct frame_check *c, const struct camera *camera,
                                    uint32_t x, uint32_t y)
{
    const struct vec3 up = vec3_normalize(camera->position_m);
    const struct vec3 direction = vec3_normalize(
        camera_ray(camera, 2 * (x + 0.5) / c->width - 1, 1 - 2 * (y + 0.5) / c->height));
    return (struct query_view){.radius_m = vec3_length(camera->position_m),
                               .sun_mu = vec3_dot(up, camera->sun_direction),
                               .view_mu = vec3_dot(up, direction),
                               .nu = vec3_dot(direction, camera->sun_direction)};
}

static void compare_pixel(const struct frame_check *c, const struct camera *camera,
                          struct pictures *p, uint32_t place)
{
    const struct query_view view = pixel_view(c, camera, place % c->width, place / c->width);
    const float *got = p->got + 4 * (size_t)place;
    float *expected = p->expected + 4 * (size_t)place;
    c->expect(c->model, &view, expected);
    expected[3] = 1;
    float largest = 0;
    float worst = 0;
    for (int k = 0; k < 3; k++) {
        const float difference = got[k] - expected[k];
        p->difference[4 * (size_t)place + (size_t)k] = difference;
        largest = fmaxf(largest, expected[k]);
        worst = fmaxf(worst, fabsf(difference));
    }
    // Below a millionth of daylight nobody sees a colour.
    if (largest > 1e-3f && !is_edge(c, camera, &view)) {
        p->errors[p->compared++] = worst / largest;
    }
}

static void write_failure(const struct frame_check *c, const char *view, const char *what,
                          const float *rgba)
{
    char path[128];
    snprintf(path, sizeof path, "%s-%s-%s.exr", c->name, view, what);
    assert_int_equal(trl_image_write_exr(c->ctx, path, c->width, c->height, rgba), TRL_OK);
    fprintf(stderr, "left %s\n", path);
}

static void judge(const struct frame_check *c, const char *name, struct pictures *p)
{
    const size_t count = p->compared;
    assert_true(count > 100);
    qsort(p->errors, count, sizeof *p->errors, compare_floats);
    const double median = (double)p->errors[count / 2];
    const double most = (double)p->errors[count - 1 - count / 20];
    printf("%-12s %5zu pixels: median %.4f %%, 95 of 100 below %.4f %%, worst %.2f %%\n", name,
           count, 100 * median, 100 * most, 100 * (double)p->errors[count - 1]);
    if (!(median < c->median_limit && most < c->most_limit)) {
        write_failure(c, name, "got", p->got);
        write_failure(c, name, "expected", p->expected);
        write_failure(c, name, "difference", p->difference);
    }
    assert_true(median < c->median_limit);
    assert_true(most < c->most_limit);
}

void frame_check_view(const struct frame_check *c, const char *name, const trl_view *view)
{
    const uint32_t pixels = c->width * c->height;
    struct pictures p = create_pictures(pixels);
    frame_check_draw(c->renderer, view, c->width, c->height, p.got);
    const struct camera_place place = {.radius_m = c->scene->medium.ground_radius_m};
    const struct camera camera = camera_resolve(view, &place, (double)c->width / c->height);
    for (uint32_t i = 0; i < pixels; i++) {
        compare_pixel(c, &camera, &p, i);
    }
    judge(c, name, &p);
    destroy_pictures(&p);
}

void frame_check_named(const struct frame_check *c, const char *name)
{
    trl_view view;
    assert_int_equal(trl_scene_view(c->scene, name, &view), TRL_OK);
    frame_check_view(c, name, &view);
}

void frame_check_all(const struct frame_check *c)
{
    static const char *const names[] = {"ground", "sunset", "twilight", "limb", "full-disc"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        frame_check_named(c, names[i]);
    }
    trl_view view;
    assert_int_equal(trl_scene_view(c->scene, "ground", &view), TRL_OK);
    view.altitude_m = 11000;
    view.pitch_rad = -0.4;
    frame_check_view(c, "aircraft", &view);
}

void frame_check_finite(trl_renderer *renderer)
{
    enum { WIDTH = 32, HEIGHT = 24 };
    static const double altitudes_m[] = {-1000, 0, 1e5, 1e5 + 1e-3, 4e5, 1e9};
    static const double pitches_rad[] = {-M_PI_2, -0.3, 0, M_PI_2};
    static const double suns_rad[] = {M_PI_2, 0, -0.2, -M_PI_2};
    static float got[WIDTH * HEIGHT * 4];
    for (int k = 0; k < 6 * 4 * 4 * 2; k++) {
        trl_view view = trl_view_default();
        view.altitude_mode = TRL_ALTITUDE_SPHERE;
        view.latitude_rad = k % 2 ? M_PI_2 : 0.3;
        view.altitude_m = altitudes_m[k / 2 % 6];
        view.pitch_rad = pitches_rad[k / 12 % 4];
        view.sun_mode = TRL_SUN_LOCAL;
        view.sun_latitude_or_elevation_rad = suns_rad[k / 48 % 4];
        frame_check_draw(renderer, &view, WIDTH, HEIGHT, got);
        for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
            assert_true(isfinite(got[i]));
        }
    }
}
