// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// Paths over ground that is not a sphere: where rays meet it, what it looks like, what it hides.
#include "context.h"

#include "reference/palette.h"
#include "reference/path_tracer.h"
#include "reference/picture.h"
#include "reference_media.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static const double infinity = 1e300;
static const double pi = 3.14159265358979323846;
static const double radius_m = 6.36e6;
// A dome on the z axis: a sphere about the point where the axis leaves the planet.
static const double dome_m = 5000;

// Along a direction from the centre, from the dome's middle.
static double dome_altitude(const void *user, struct vec3 direction)
{
    (void)user;
    const struct vec3 unit = vec3_normalize(direction);
    const double across = radius_m * hypot(unit.x, unit.y);
    if (unit.z < 0 || across >= dome_m) {
        return 0;
    }
    const double along = radius_m * unit.z + sqrt(dome_m * dome_m - across * across);
    return fmax(along - radius_m, 0);
}

static double dome_ceiling(const void *user, struct vec3 direction, double reach_m)
{
    (void)user;
    const double away = atan2(hypot(direction.x, direction.y), direction.z) * radius_m;
    return away <= 1.01 * (dome_m + reach_m) ? dome_m : 0;
}

static bool is_below_dome(const void *user, struct vec3 direction, double reach_m,
                          double altitude_m)
{
    return dome_ceiling(user, direction, reach_m) < altitude_m;
}

static double fine_step(const void *user, struct vec3 direction, double reach_m)
{
    (void)user;
    (void)direction;
    (void)reach_m;
    return 20;
}

static void dome_look(const void *user, struct vec3 direction, struct reference_look *look)
{
    const double altitude = dome_altitude(user, direction);
    const struct vec3 up = vec3_normalize(direction);
    const struct vec3 at = vec3_scale(up, radius_m + altitude);
    look->normal = altitude > 0 ? vec3_normalize(vec3_sub(at, (struct vec3){0, 0, radius_m})) : up;
    look->has_colour = false;
    for (int c = 0; c < 3; ++c) {
        look->albedo_rgb[c] = look->glow_rgb[c] = 0;
    }
}

static struct reference_surface make_dome(void)
{
    return (struct reference_surface){.highest_m = dome_m,
                                      .altitude_m = dome_altitude,
                                      .step_m = fine_step,
                                      .is_below = is_below_dome,
                                      .look = dome_look};
}

// The nearer way along a ray to a sphere, or `infinity`.
static double way_to_sphere(struct vec3 from_m, struct vec3 direction, struct vec3 middle_m,
                            double sphere_m)
{
    const struct vec3 to = vec3_sub(middle_m, from_m);
    const double along = vec3_dot(to, direction);
    const struct vec3 across = vec3_sub(to, vec3_scale(direction, along));
    const double rest = sphere_m * sphere_m - vec3_dot(across, across);
    const double way = rest >= 0 ? along - sqrt(rest) : infinity;
    return way > 0 ? way : infinity;
}

static double way_to_ground(struct vec3 from_m, struct vec3 direction)
{
    const struct vec3 top = {0, 0, radius_m}, centre = {0, 0, 0};
    return fmin(way_to_sphere(from_m, direction, centre, radius_m),
                way_to_sphere(from_m, direction, top, dome_m));
}

static void rays_meet_the_ground_where_it_is(void **state)
{
    (void)state;
    const struct reference_surface dome = make_dome();
    struct random_stream random = random_stream_for(1, 0, 0);
    int met = 0, passed = 0;
    for (int i = 0; i < 4000; ++i) {
        const double away = 20e3 * random_next(&random), turn = 2 * pi * random_next(&random);
        const struct vec3 from_m = {away * cos(turn), away * sin(turn),
                                    radius_m + 5100 + 15e3 * random_next(&random)};
        // Toward a place near the dome, or past it.
        const struct vec3 to_m = {9e3 * (random_next(&random) - 0.5),
                                  9e3 * (random_next(&random) - 0.5),
                                  radius_m + 20e3 * random_next(&random)};
        const struct reference_way way = {from_m, vec3_normalize(vec3_sub(to_m, from_m)), 400e3, 0};
        const double expected = way_to_ground(way.from_m, way.direction);
        const double got = reference_surface_meet(&dome, radius_m, &way);
        const struct vec3 at = vec3_add(from_m, vec3_scale(way.direction, expected));
        const struct vec3 away_m = vec3_sub(at, (struct vec3){0, 0, radius_m});
        const double grazing = fabs(vec3_dot(vec3_normalize(away_m), way.direction));
        if (expected < 390e3 && grazing > 0.05) {
            // A millimetre of clearance, under the flattest angle allowed.
            assert_true(fabs(got - expected) < 0.02);
            ++met;
        } else if (expected > 400e3) {
            assert_true(got < 0);
            ++passed;
        }
    }
    assert_true(met > 1000 && passed > 500);
}

// Waves of 900 and 1100 m: as rough as a raster of texels of 300 m.
static double wavy_altitude(const void *user, struct vec3 direction)
{
    (void)user;
    const struct vec3 unit = vec3_normalize(direction);
    return 150 * sin(radius_m * unit.x / 140) * sin(radius_m * unit.y / 175) +
           40 * sin(radius_m * unit.x / 95);
}

static double wavy_step(const void *user, struct vec3 direction, double reach_m)
{
    (void)user;
    (void)direction;
    (void)reach_m;
    return 150;
}

static double wavy_ceiling(const void *user, struct vec3 direction, double reach_m)
{
    (void)user;
    (void)direction;
    (void)reach_m;
    return 190;
}

static bool is_below_wavy(const void *user, struct vec3 direction, double reach_m,
                          double altitude_m)
{
    return wavy_ceiling(user, direction, reach_m) < altitude_m;
}

static double wavy_clearance(const struct reference_way *way, double t)
{
    const struct vec3 at = vec3_add(way->from_m, vec3_scale(way->direction, t));
    return vec3_length(at) - radius_m - wavy_altitude(NULL, at);
}

// The first of steps of 0.25 m that is not above the ground: no wave, of curvature 150 / 140^2, can
// rise above a ray by more than 0.1 mm between two of them.
static double way_by_small_steps(const struct reference_way *way)
{
    double t = 0;
    while (t < way->length_m && wavy_clearance(way, t) > 0) {
        t += 0.25;
    }
    return t < way->length_m ? t : -1;
}

// Nearly level, just above the crests: the first touch and not a later one.
static void grazing_rays_meet_the_first_crest(void **state)
{
    (void)state;
    const struct reference_surface waves = {.lowest_m = -190,
                                            .highest_m = 190,
                                            .altitude_m = wavy_altitude,
                                            .step_m = wavy_step,
                                            .is_below = is_below_wavy,
                                            .look = dome_look};
    struct random_stream random = random_stream_for(5, 0, 0);
    int met = 0, passed = 0;
    for (int i = 0; i < 300; ++i) {
        const double turn = 2 * pi * random_next(&random);
        const double fall = 0.01 * (random_next(&random) - 0.5);
        const struct vec3 from_m = {1e4 * random_next(&random), 1e4 * random_next(&random),
                                    radius_m + 100 + 90 * random_next(&random)};
        const struct vec3 toward = {cos(turn), sin(turn), fall};
        const struct reference_way way = {from_m, vec3_normalize(toward), 8e3, 0};
        const double expected = way_by_small_steps(&way);
        const double got = reference_surface_meet(&waves, radius_m, &way);
        assert_true((got >= 0) == (expected >= 0));
        if (expected > 0) {
            assert_true(got <= expected && got > expected - 0.3);
            ++met;
        }
        passed += expected < 0;
    }
    assert_true(met > 100 && passed > 30);
}

// Without air, one reflection: what is lit is Lambert's cosine, what the dome hides is black.
static void domes_are_lit_and_cast_shadows(void **state)
{
    enum { WIDTH = 16, HEIGHT = 12 };
    const double albedo = 0.4;
    struct medium medium = empty_medium(albedo);
    medium.ground_radius_m = radius_m;
    medium.top_radius_m = radius_m + 60e3;
    medium.star_angular_radius_rad = 0;
    const struct reference_surface dome = make_dome();
    const struct camera camera = {.position_m = {0, 0, radius_m + 20e3},
                                  .right = {1, 0, 0},
                                  .up = {0, 1, 0},
                                  .forward = {0, 0, -1},
                                  .tan_half_fov_x = 0.8,
                                  .tan_half_fov_y = 0.6,
                                  .sun_direction = {cos(0.5), 0, sin(0.5)}};
    const struct reference_scene scene = {.medium = &medium, .surface = &dome};
    const struct reference_picture picture = {
        .camera = &camera, .width = WIDTH, .height = HEIGHT, .paths = 1, .max_order = 1};
    float rgba[4 * WIDTH * HEIGHT];
    const struct reference_sheets sheets = {rgba, NULL};
    assert_int_equal(reference_picture_trace(*state, &scene, &picture, &sheets), TRL_OK);
    struct palette palette;
    palette_make(&medium, &palette);
    int lit = 0, dark = 0;
    for (int i = 0; i < WIDTH * HEIGHT; ++i) {
        const struct vec3 direction = vec3_normalize(camera_ray(
            &camera, 2 * (i % WIDTH + 0.5) / WIDTH - 1, 1 - 2 * (i / WIDTH + 0.5) / HEIGHT));
        const double way = way_to_ground(camera.position_m, direction);
        const struct vec3 at = vec3_add(camera.position_m, vec3_scale(direction, way));
        struct reference_look look;
        dome_look(NULL, at, &look);
        const struct vec3 above = vec3_scale(at, 1 + 1e-8);
        const bool is_lit = !(way_to_ground(above, camera.sun_direction) < infinity);
        const double cosine = fmax(vec3_dot(look.normal, camera.sun_direction), 0);
        const double expected = is_lit ? palette.luminance * albedo / pi * cosine : 0;
        const double got = 0.2126 * (double)rgba[4 * i] + 0.7152 * (double)rgba[4 * i + 1] +
                           0.0722 * (double)rgba[4 * i + 2];
        // Floats, and primaries' luminances of four digits.
        assert_true(fabs(got - expected) < 1e-3 * palette.luminance * albedo / pi);
        lit += is_lit;
        dark += !is_lit;
    }
    assert_true(lit > 50 && dark > 10);
}

static double level_altitude(const void *user, struct vec3 direction)
{
    (void)direction;
    return *(const double *)user;
}

static double level_ceiling(const void *user, struct vec3 direction, double reach_m)
{
    (void)direction;
    (void)reach_m;
    return *(const double *)user;
}

static bool is_below_level(const void *user, struct vec3 direction, double reach_m,
                           double altitude_m)
{
    return level_ceiling(user, direction, reach_m) < altitude_m;
}

static void level_look(const void *user, struct vec3 direction, struct reference_look *look)
{
    (void)user;
    look->normal = vec3_normalize(direction);
    look->has_colour = true;
    for (int c = 0; c < 3; ++c) {
        look->albedo_rgb[c] = 0.5;
        look->glow_rgb[c] = 0;
    }
}

// All orders over a plateau in even air are those over a larger planet.
static void a_level_surface_is_a_larger_sphere(void **state)
{
    enum { WIDTH = 4, HEIGHT = 6, PIXELS = WIDTH * HEIGHT };
    const double plateau_m = 3000;
    struct medium medium = uniform_medium(8e-6, 1e-6, 0.1),
                  larger = uniform_medium(8e-6, 1e-6, 0.5);
    larger.ground_radius_m += plateau_m;
    const struct reference_surface level = {.user = &plateau_m,
                                            .lowest_m = plateau_m,
                                            .highest_m = plateau_m,
                                            .altitude_m = level_altitude,
                                            .step_m = fine_step,
                                            .is_below = is_below_level,
                                            .look = level_look};
    const struct reference_scene scenes[2] = {{.medium = &medium, .surface = &level},
                                              {.medium = &larger}};
    const struct camera camera = {.position_m = {0, 0, medium.ground_radius_m + 4e3},
                                  .right = {0, -1, 0},
                                  .up = {0, 0, 1},
                                  .forward = {1, 0, 0},
                                  .tan_half_fov_x = 0.8,
                                  .tan_half_fov_y = 1.2,
                                  .sun_direction = {0.6, 0, 0.8}};
    float rgba[2][4 * PIXELS], error[2][4 * PIXELS];
    for (int k = 0; k < 2; ++k) {
        const struct reference_picture picture = {.camera = &camera,
                                                  .width = WIDTH,
                                                  .height = HEIGHT,
                                                  .paths = 512,
                                                  .seed = 20 + (uint64_t)k};
        const struct reference_sheets sheets = {rgba[k], error[k]};
        assert_int_equal(reference_picture_trace(*state, &scenes[k], &picture, &sheets), TRL_OK);
    }
    double squares = 0;
    for (int i = 0; i < PIXELS; ++i) {
        const double noise = hypot((double)error[0][4 * i + 1], (double)error[1][4 * i + 1]);
        const double z = ((double)rgba[0][4 * i + 1] - (double)rgba[1][4 * i + 1]) / noise;
        assert_true(fabs(z) < 4.5);
        assert_true(noise < 0.1 * (double)rgba[1][4 * i + 1]);
        squares += z * z;
    }
    // The mean of 24 squares is 1 +- 0.29.
    assert_true(squares / PIXELS < 2.2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_the_ground_where_it_is),
        cmocka_unit_test(grazing_rays_meet_the_first_crest),
        cmocka_unit_test(domes_are_lit_and_cast_shadows),
        cmocka_unit_test(a_level_surface_is_a_larger_sphere),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
