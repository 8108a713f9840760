// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Cameras of views: conventions of angles, the star's place, altitudes, poles.
#include "fixture.h"
#include "scene/camera.h"
#include "scene/scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;
static const struct camera_place SPHERE = {.radius_m = 6371000.0};

// Sines and cosines of doubles, multiplied at most three times.
static const double DIRECTION_TOLERANCE = 1e-14;

static trl_view view_at(double latitude_rad, double longitude_rad)
{
    return (trl_view){.latitude_rad = latitude_rad,
                      .longitude_rad = longitude_rad,
                      .altitude_m = 1000.0,
                      .vertical_fov_rad = PI / 2,
                      .sun_mode = TRL_SUN_SUBSOLAR};
}

static void assert_vec(struct vec3 got, double x, double y, double z)
{
    assert_true(fabs(got.x - x) < DIRECTION_TOLERANCE);
    assert_true(fabs(got.y - y) < DIRECTION_TOLERANCE);
    assert_true(fabs(got.z - z) < DIRECTION_TOLERANCE);
}

static void heading_zero_looks_north_with_east_at_the_right(void **state)
{
    (void)state;
    const trl_view view = view_at(0, 0);
    const struct camera camera = camera_resolve(&view, &SPHERE, 1);
    assert_vec(camera.forward, 0, 0, 1);
    assert_vec(camera.right, 0, 1, 0);
    assert_vec(camera.up, 1, 0, 0);
}

static void heading_turns_clockwise_from_north(void **state)
{
    (void)state;
    trl_view view = view_at(0, 0);
    view.heading_rad = PI / 2; // east
    const struct camera camera = camera_resolve(&view, &SPHERE, 1);
    assert_vec(camera.forward, 0, 1, 0);
    assert_vec(camera.right, 0, 0, -1);
    assert_vec(camera.up, 1, 0, 0);
}

static void an_eye_rides_on_waves_where_the_view_says_so(void **state)
{
    (void)state;
    const struct camera_place place = {.radius_m = 6e6, .ground_altitude_m = 10, .wave_m = -2.5};
    trl_view view = view_at(0, 0);
    view.altitude_m = 4;
    view.altitude_mode = TRL_ALTITUDE_WAVES;
    assert_true(camera_altitude_m(&view, &place) == 11.5);
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    assert_true(camera_altitude_m(&view, &place) == 14);
}

static void pitch_up_is_positive_and_straight_down_is_defined(void **state)
{
    (void)state;
    trl_view view = view_at(0, 0);
    view.pitch_rad = PI / 4;
    struct camera camera = camera_resolve(&view, &SPHERE, 1);
    assert_vec(camera.forward, sqrt(0.5), 0, sqrt(0.5));
    view.pitch_rad = -PI / 2; // the heading is then where the top of the picture points
    camera = camera_resolve(&view, &SPHERE, 1);
    assert_vec(camera.forward, -1, 0, 0);
    assert_vec(camera.up, 0, 0, 1);
    assert_vec(camera.right, 0, 1, 0);
}

static void roll_turns_the_camera_clockwise(void **state)
{
    (void)state;
    trl_view view = view_at(0, 0);
    view.roll_rad = PI / 2;
    const struct camera camera = camera_resolve(&view, &SPHERE, 1);
    assert_vec(camera.right, -1, 0, 0); // the right hand points down
    assert_vec(camera.up, 0, 1, 0);
    assert_vec(camera.forward, 0, 0, 1);
}

static void axes_are_orthonormal_and_right_handed_anywhere(void **state)
{
    (void)state;
    for (int i = 0; i < 500; i++) {
        trl_view view = view_at(PI * (i % 11 / 10.0 - 0.5), 0.7 * i);
        view.heading_rad = 1.3 * i;
        view.pitch_rad = PI * (i % 7 / 6.0 - 0.5);
        view.roll_rad = 0.9 * i;
        const struct camera c = camera_resolve(&view, &SPHERE, 1);
        const struct vec3 across = vec3_cross(c.right, c.up);
        assert_vec(across, -c.forward.x, -c.forward.y, -c.forward.z);
        assert_true(fabs(vec3_length(c.right) - 1) < DIRECTION_TOLERANCE);
        assert_true(fabs(vec3_length(c.up) - 1) < DIRECTION_TOLERANCE);
        assert_true(fabs(vec3_dot(c.right, c.up)) < DIRECTION_TOLERANCE);
    }
}

static void poles_keep_their_headings(void **state)
{
    (void)state;
    const trl_view north = view_at(PI / 2, 0); // north lies beyond the pole, on the other meridian
    const struct camera camera = camera_resolve(&north, &SPHERE, 1);
    assert_vec(camera.forward, -1, 0, 0);
    assert_vec(camera.right, 0, 1, 0);
    const trl_view south = view_at(-PI / 2, 0);
    assert_vec(camera_resolve(&south, &SPHERE, 1).forward, 1, 0, 0);
}

static void field_of_view_is_vertical_and_widens_with_the_aspect(void **state)
{
    (void)state;
    trl_view view = view_at(0, 0);
    view.vertical_fov_rad = PI / 3;
    const struct camera camera = camera_resolve(&view, &SPHERE, 2);
    assert_true(fabs(camera.tan_half_fov_y - 1 / sqrt(3.0)) < DIRECTION_TOLERANCE);
    assert_true(fabs(camera.tan_half_fov_x - 2 / sqrt(3.0)) < DIRECTION_TOLERANCE);
}

static void altitude_counts_from_sphere_or_ground(void **state)
{
    (void)state;
    const struct camera_place hill = {.radius_m = 1e6, .ground_altitude_m = 300};
    trl_view view = view_at(0.3, 0.4);
    assert_true(camera_altitude_m(&view, &hill) == 1000);
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    assert_true(camera_altitude_m(&view, &hill) == 1300);
    const struct camera camera = camera_resolve(&view, &hill, 1);
    assert_true(fabs(vec3_length(camera.position_m) - 1001300) < 1e-8); // 60 ulp of a megametre
}

static void cameras_below_the_ground_are_lifted(void **state)
{
    (void)state;
    const struct camera_place hill = {.radius_m = 1e6, .ground_altitude_m = 3000};
    trl_view view = view_at(0, 0);
    assert_true(camera_altitude_m(&view, &hill) == 3000 + CAMERA_MIN_HEIGHT_M);
    const struct camera_place hollow = {.radius_m = 1e6, .ground_altitude_m = -400};
    view.altitude_m = -399; // below the sphere, above the ground
    assert_true(camera_altitude_m(&view, &hollow) == -399);
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    view.altitude_m = -10;
    assert_true(camera_altitude_m(&view, &hollow) == -400 + CAMERA_MIN_HEIGHT_M);
}

static void subsolar_sun_stands_over_its_point(void **state)
{
    (void)state;
    trl_view view = view_at(1, 1);
    view.sun_latitude_or_elevation_rad = PI / 4;
    view.sun_longitude_or_azimuth_rad = PI / 2;
    assert_vec(camera_resolve(&view, &SPHERE, 1).sun_direction, 0, sqrt(0.5), sqrt(0.5));
}

static void local_sun_has_elevation_and_azimuth_of_the_camera(void **state)
{
    (void)state;
    trl_view view = view_at(0.6, -2.1);
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.2;
    view.sun_longitude_or_azimuth_rad = 4.0;
    view.heading_rad = 4.0; // a camera of the same azimuth and pitch looks into it
    view.pitch_rad = 0.2;
    const struct camera camera = camera_resolve(&view, &SPHERE, 1);
    assert_vec(camera.sun_direction, camera.forward.x, camera.forward.y, camera.forward.z);
    const struct vec3 up = vec3_normalize(camera.position_m);
    assert_true(fabs(vec3_dot(up, camera.sun_direction) - sin(0.2)) < DIRECTION_TOLERANCE);
}

static void a_resolved_view_shows_the_same(void **state)
{
    (void)state;
    const struct camera_place hill = {.radius_m = 1e6, .ground_altitude_m = 3000};
    trl_view view = view_at(0.6, -2.1);
    view.altitude_mode = TRL_ALTITUDE_GROUND;
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.2;
    view.sun_longitude_or_azimuth_rad = 4.0;
    const trl_view resolved = camera_view_resolve(&view, &hill);
    assert_int_equal(resolved.altitude_mode, TRL_ALTITUDE_SPHERE);
    assert_int_equal(resolved.sun_mode, TRL_SUN_SUBSOLAR);
    assert_true(resolved.altitude_m == 4000);
    const struct camera a = camera_resolve(&view, &hill, 1);
    const struct camera b = camera_resolve(&resolved, &hill, 1);
    assert_vec(b.sun_direction, a.sun_direction.x, a.sun_direction.y, a.sun_direction.z);
    assert_vec(vec3_sub(b.position_m, a.position_m), 0, 0, 0);
}

static const struct scene_body MOON = {
    .name = (char *)"Moon", .radius_m = 1.7374e6, .distance_m = 3.844e8};
static const struct camera_place BELOW_MOON = {
    .radius_m = 6371000.0, .bodies = &MOON, .body_count = 1};

// Cosine of the angle to a direction, and the distance from the planet's centre.
static void assert_body(const struct camera *camera, struct vec3 toward, double distance_m)
{
    assert_int_equal(camera->body_count, 1);
    assert_int_equal(camera->bodies[0].index, 0);
    assert_true(camera->bodies[0].radius_m == MOON.radius_m);
    const struct vec3 way_m = vec3_sub(camera->bodies[0].position_m, camera->position_m);
    assert_true(vec3_length(vec3_cross(vec3_normalize(way_m), toward)) < DIRECTION_TOLERANCE);
    assert_true(vec3_dot(way_m, toward) > 0);
    assert_true(fabs(vec3_length(camera->bodies[0].position_m) / distance_m - 1) < 1e-14);
}

static void bodies_stand_where_the_camera_sees_them(void **state)
{
    (void)state;
    trl_view view = view_at(0.6, -2.1);
    assert_int_equal(camera_resolve(&view, &BELOW_MOON, 1).body_count, 0);
    view.bodies[0] = (trl_body_place){TRL_BODY_LOCAL, 0.1, 1.4, 0};
    view.heading_rad = 1.4;
    view.pitch_rad = 0.1;
    struct camera camera = camera_resolve(&view, &BELOW_MOON, 1);
    assert_body(&camera, camera.forward, MOON.distance_m);
    view.bodies[0].distance_m = 4e8;
    camera = camera_resolve(&view, &BELOW_MOON, 1);
    assert_body(&camera, camera.forward, 4e8);
}

// Parallax is left to the camera: the Moon on the horizon of one place is over another.
static void bodies_stand_over_their_points_of_the_planet(void **state)
{
    (void)state;
    trl_view view = view_at(0.2, 0.3);
    view.bodies[0] = (trl_body_place){TRL_BODY_SUBPOINT, 0.2, 0.3, 0};
    const struct camera below = camera_resolve(&view, &BELOW_MOON, 1);
    assert_body(&below, vec3_normalize(below.position_m), MOON.distance_m);
}

static void offsets_from_the_sun_are_right_and_up_for_a_level_camera(void **state)
{
    (void)state;
    trl_view view = view_at(0.6, -2.1);
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = view.pitch_rad = 0.4;
    view.sun_longitude_or_azimuth_rad = view.heading_rad = 3.0;
    view.bodies[0].mode = TRL_BODY_FROM_SUN;
    struct camera c = camera_resolve(&view, &BELOW_MOON, 1);
    assert_body(&c, c.sun_direction, MOON.distance_m);
    view.bodies[0].longitude_or_azimuth_rad = 0.003;
    view.bodies[0].latitude_or_elevation_rad = -0.004;
    c = camera_resolve(&view, &BELOW_MOON, 1);
    const struct vec3 aside = vec3_add(vec3_scale(c.right, 0.6), vec3_scale(c.up, -0.8));
    assert_body(&c, vec3_add(vec3_scale(c.forward, cos(0.005)), vec3_scale(aside, sin(0.005))),
                MOON.distance_m);
}

static void resolved_bodies_stay_where_they_are(void **state)
{
    (void)state;
    trl_view view = view_at(0.6, -2.1);
    view.bodies[0] = (trl_body_place){TRL_BODY_LOCAL, -0.1, 1.4, 5e8};
    const trl_view resolved = camera_view_resolve(&view, &BELOW_MOON);
    assert_int_equal(resolved.bodies[0].mode, TRL_BODY_SUBPOINT);
    const struct camera a = camera_resolve(&view, &BELOW_MOON, 1);
    const struct camera b = camera_resolve(&resolved, &BELOW_MOON, 1);
    // A few roundings of the distance, 5e8 m.
    assert_true(vec3_length(vec3_sub(a.bodies[0].position_m, b.bodies[0].position_m)) < 1e-6);
}

static void cameras_that_cannot_see_a_body_so_are_refused(void **state)
{
    struct fixture *f = *state;
    trl_view view = view_at(0, 0);
    view.bodies[0] = (trl_body_place){TRL_BODY_SUBPOINT, 0, 0, 0};
    view.altitude_m = 3.844e8 - 6371000.0 - 1.7374e6; // on its surface
    fixture_expect_error(f, camera_check(f->ctx, &view, &BELOW_MOON), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_ARGUMENT);
    view.altitude_m -= 1;
    assert_int_equal(camera_check(f->ctx, &view, &BELOW_MOON), TRL_OK);
    view.altitude_m = 5e8; // beyond
    assert_int_equal(camera_check(f->ctx, &view, &BELOW_MOON), TRL_OK);
    view.bodies[0].mode = TRL_BODY_LOCAL;
    fixture_expect_error(f, camera_check(f->ctx, &view, &BELOW_MOON), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_ARGUMENT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(heading_zero_looks_north_with_east_at_the_right),
        cmocka_unit_test(heading_turns_clockwise_from_north),
        cmocka_unit_test(an_eye_rides_on_waves_where_the_view_says_so),
        cmocka_unit_test(pitch_up_is_positive_and_straight_down_is_defined),
        cmocka_unit_test(roll_turns_the_camera_clockwise),
        cmocka_unit_test(axes_are_orthonormal_and_right_handed_anywhere),
        cmocka_unit_test(poles_keep_their_headings),
        cmocka_unit_test(field_of_view_is_vertical_and_widens_with_the_aspect),
        cmocka_unit_test(altitude_counts_from_sphere_or_ground),
        cmocka_unit_test(cameras_below_the_ground_are_lifted),
        cmocka_unit_test(subsolar_sun_stands_over_its_point),
        cmocka_unit_test(local_sun_has_elevation_and_azimuth_of_the_camera),
        cmocka_unit_test(a_resolved_view_shows_the_same),
        cmocka_unit_test(bodies_stand_where_the_camera_sees_them),
        cmocka_unit_test(bodies_stand_over_their_points_of_the_planet),
        cmocka_unit_test(offsets_from_the_sun_are_right_and_up_for_a_level_camera),
        cmocka_unit_test(resolved_bodies_stay_where_they_are),
        cmocka_unit_test_setup_teardown(cameras_that_cannot_see_a_body_so_are_refused,
                                        fixture_set_up, fixture_tear_down),
    };
    return cmocka_run_group_tests_name("camera", tests, NULL, NULL);
}
