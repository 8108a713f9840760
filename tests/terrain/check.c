// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What mesh_check measures, where it is known by hand; and that every mesher is within a pixel.
#include "planet.h"

#include <math.h>
#include <stdio.h>

static const double R = 1e6;

static double raised(double latitude, double longitude)
{
    (void)latitude;
    (void)longitude;
    return 100;
}

// A truth that is level at an altitude.
static double level_altitude(const void *user, struct vec3 direction)
{
    (void)direction;
    return *(const double *)user;
}

static double level_step(const void *user, struct vec3 direction, double reach_m)
{
    (void)user;
    (void)direction;
    (void)reach_m;
    return 1000;
}

static double level_ceiling(const void *user, struct vec3 direction, double reach_m)
{
    (void)direction;
    (void)reach_m;
    return *(const double *)user;
}

static bool is_below(const void *user, struct vec3 direction, double reach_m, double altitude_m)
{
    return level_ceiling(user, direction, reach_m) < altitude_m;
}

static void level_look(const void *user, struct vec3 direction, struct reference_look *look)
{
    (void)user;
    look->normal = vec3_normalize(direction);
}

static struct reference_surface make_level(const double *altitude_m)
{
    return (struct reference_surface){.user = altitude_m,
                                      .lowest_m = *altitude_m,
                                      .highest_m = *altitude_m,
                                      .altitude_m = level_altitude,
                                      .step_m = level_step,
                                      .is_below = is_below,
                                      .look = level_look};
}

static struct mesh_error check_raised(void **state, double truth_m, double height_m, double pitch)
{
    struct planet p;
    planet_make(*state, raised, NULL, &p);
    assert_true(planet_use(&p, TRL_MESHER_HEMISPHERE));
    p.truth = make_level(&truth_m);
    const struct camera_place place = {
        .radius_m = R, .altitude_m = height_m, .pitch = pitch, .fov = 20};
    const struct camera camera = fixture_camera(&place);
    const struct mesh_error error = planet_check(&p, &camera, 300, 3);
    planet_destroy(&p);
    return error;
}

// Straight below, what lies 100 m too high of 1000 is a tenth too far from the middle.
static void ground_that_is_raised_shifts_outward(void **state)
{
    const struct mesh_error error = check_raised(state, 0, 1000, -90);
    assert_int_equal(error.places, 100 * 100);
    assert_int_equal(error.holes, 0);
    assert_int_equal(error.edges, 0);
    // The mean of x^2 + y^2 over a square of half a side of 150 is 150^2 * 2/3; its corners are 150
    // sqrt 2 away, less half of what a place stands for. Rasterised positions are off their rays by
    // a few hundredths of a pixel.
    assert_close(error.shift_rms, 0.1 * 150 * sqrt(2.0 / 3), 0.02);
    assert_close(error.shift_max, 0.1 * 148.5 * sqrt(2.0), 0.05);
}

// The dip of the horizon falls from acos(R / d) to acos((R + 100) / d).
static void a_horizon_that_is_raised_is_told_by_its_dip(void **state)
{
    const double d = R + 3000;
    const double dips[2] = {acos(R / d), acos((R + 100) / d)};
    const double degree = 3.14159265358979323846 / 180;
    const struct mesh_error error = check_raised(state, 0, 3000, -dips[0] / degree);
    const double pixel = 2 * tan(10 * degree) / 300;
    // Elsewhere than straight ahead the horizon is curved and a little farther from the middle.
    assert_close(error.edge_rms, tan(dips[0] - dips[1]) / pixel, 0.06);
    assert_true(error.edges >= 95);
    assert_int_equal(error.lost_edges, 0);
}

static void ground_where_none_is_counts_as_holes(void **state)
{
    // A planet of half the size behind it: its own silhouette is nowhere drawn.
    const struct mesh_error error = check_raised(state, -5e5, 1e6, -66);
    assert_true(error.holes > 100);
}

// Rolling land, and hills over it in the inset.
static double rolling(double latitude, double longitude)
{
    const double degree = 3.14159265358979323846 / 180;
    const struct vec3 d = vec3_from_lat_lon(latitude * degree, longitude * degree);
    return 1000 + 700 * sin(15 * d.x + 1) * cos(14 * d.y) + 700 * sin(16 * d.z) * cos(13 * d.x);
}

static double hilly(double latitude, double longitude)
{
    return 1500 + 300 * sin(latitude * 12) * cos(longitude * 11) + 20 * sin(latitude * 80) +
           20 * cos(longitude * 90);
}

// All meshers of this GL see the place within that many pixels.
static void check_meshers(struct planet *p, struct camera_place place, double height_m,
                          double most_px)
{
    for (int kind = 0; mesher_name((trl_mesher)kind); kind++) {
        if (!planet_use(p, (trl_mesher)kind)) {
            continue;
        }
        const struct camera camera = planet_camera(p, place, height_m);
        const struct mesh_error e = planet_check(p, &camera, 400, 8);
        printf("%s, from %g m: shift %.3f (%.2f), silhouettes %.3f (%.2f) of %u, %u lost, "
               "%u holes\n",
               mesher_name((trl_mesher)kind), height_m, e.shift_rms, e.shift_max, e.edge_rms,
               e.edge_max, e.edges, e.lost_edges, e.holes);
        assert_true(e.places > 500);
        assert_true(e.shift_rms < most_px);
        assert_true(e.edge_rms < most_px);
        assert_int_equal(e.holes, 0);
    }
}

static void every_mesher_is_within_a_pixel(void **state)
{
    static const struct camera_place views[] = {
        {.latitude = 40, .longitude = 30, .pitch = -90, .fov = 60},
        {.latitude = 40.5, .longitude = 28.7, .heading = 100, .pitch = -10, .fov = 50},
        {.latitude = 89.9, .longitude = 20, .heading = 10, .pitch = -8, .fov = 50},
        {.latitude = 3, .longitude = 179.99, .heading = 60, .pitch = -4, .fov = 50}};
    static const double heights[] = {1e6, 5e3, 2e3, 30};
    struct planet p;
    planet_make(*state, rolling, hilly, &p);
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        check_meshers(&p, views[i], heights[i], 1);
    }
    planet_destroy(&p);
}

// At 7 km from the sphere floats have steps of half a millimetre, which a centimetre above the
// ground is pixels.
static double deep(double latitude, double longitude)
{
    return rolling(latitude, longitude) - 8000;
}

static void far_from_the_sphere_a_millimetre_counts(void **state)
{
    const struct camera_place place = {
        .latitude = 3, .longitude = 100, .heading = 60, .pitch = 0.5, .fov = 20};
    struct planet p;
    planet_make(*state, deep, NULL, &p);
    check_meshers(&p, place, 0.01, 0.5);
    planet_destroy(&p);
}

// The quadtree takes waves that no raster has from the GPU, down to its finest squares.
static void squares_of_made_up_ground_keep_their_digits(void **state)
{
    const struct camera_place place = {
        .latitude = 3, .longitude = 100, .heading = 60, .pitch = 0.5, .fov = 20};
    const struct surface_detail detail = {.roughness = 1, .smallest_m = 0.2};
    struct planet p;
    planet_make_detailed(*state, deep, NULL, &detail, &p);
    assert_true(planet_use(&p, TRL_MESHER_QUADTREE));
    const struct camera camera = planet_camera(&p, place, 0.01);
    const struct mesh_error e = planet_check(&p, &camera, 400, 8);
    printf("shift %.3f (%.2f)\n", e.shift_rms, e.shift_max);
    assert_true(e.places > 500);
    // 0.071 (0.82) where floats count from the sphere.
    assert_true(e.shift_rms < 0.04 && e.shift_max < 0.3);
    planet_destroy(&p);
}

static void change_check(const struct planet *p, const struct camera *camera,
                         struct mesh_check *out)
{
    const struct mesh_check_desc desc = {.ctx = p->f->ctx,
                                         .gpu = p->f->gpu,
                                         .mesher = p->mesher,
                                         .truth = {&p->truth, R, camera, 0},
                                         .width = 200,
                                         .height = 200,
                                         .step = 1};
    assert_int_equal(mesh_check_init(&desc, NULL, out), TRL_OK);
}

// A mesh that stays does not pop when the camera moves; one that is made anew may, by no more than
// it was wrong.
static void what_changes_is_the_mesh_and_not_the_camera(void **state)
{
    struct planet p;
    planet_make(*state, rolling, hilly, &p);
    assert_true(planet_use(&p, TRL_MESHER_HEMISPHERE));
    const struct camera_place place = {
        .latitude = 40.5, .longitude = 29, .heading = 100, .pitch = -20, .fov = 50};
    struct mesh_check checks[3];
    struct camera camera = planet_camera(&p, place, 3000);
    change_check(&p, &camera, &checks[0]);
    camera.position_m = vec3_add(camera.position_m, vec3_scale(camera.right, 200));
    change_check(&p, &camera, &checks[1]);
    assert_int_equal(p.mesher->stats.projections, 1);
    camera.position_m = vec3_add(camera.position_m, vec3_scale(camera.right, 600));
    change_check(&p, &camera, &checks[2]);
    assert_int_equal(p.mesher->stats.projections, 2);
    struct mesh_change kept, popped;
    assert_int_equal(mesh_check_change(&checks[0], &checks[1], &kept), TRL_OK);
    assert_int_equal(mesh_check_change(&checks[1], &checks[2], &popped), TRL_OK);
    assert_true(kept.places > 15000 && popped.places > 15000);
    // Between pixels the error is taken as linear, which it is but at the triangles' sides.
    assert_true(kept.rms < 0.3 * popped.rms);
    assert_true(popped.rms < 2 * checks[2].error.shift_rms);
    for (int i = 0; i < 3; i++) {
        mesh_check_finish(&checks[i]);
    }
    planet_destroy(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ground_that_is_raised_shifts_outward),
        cmocka_unit_test(a_horizon_that_is_raised_is_told_by_its_dip),
        cmocka_unit_test(ground_where_none_is_counts_as_holes),
        cmocka_unit_test(every_mesher_is_within_a_pixel),
        cmocka_unit_test(far_from_the_sphere_a_millimetre_counts),
        cmocka_unit_test(squares_of_made_up_ground_keep_their_digits),
        cmocka_unit_test(what_changes_is_the_mesh_and_not_the_camera),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
