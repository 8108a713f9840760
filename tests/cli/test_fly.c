// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The viewer's camera: the same as the library's, smooth everywhere, never in the ground.
#include "scene/camera.h"
#include "viewer/fly.h"
#include "viewer/pace.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;
static const double radius_m = 6371000.0;

// Deterministic numbers in [low, high).
static double draw_number(uint64_t *state, double low, double high)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return low + (high - low) * (double)(*state >> 11) * 0x1p-53;
}

static trl_view draw_view(uint64_t *state)
{
    trl_view view = trl_view_default();
    view.latitude_rad = draw_number(state, -pi / 2, pi / 2);
    view.longitude_rad = draw_number(state, -pi, pi);
    view.altitude_m = exp(draw_number(state, log(2.0), log(1e8)));
    view.heading_rad = draw_number(state, -pi, pi);
    view.pitch_rad = draw_number(state, -pi / 2, pi / 2);
    view.roll_rad = draw_number(state, -pi, pi);
    view.vertical_fov_rad = draw_number(state, 0.1, 2.0);
    view.sun_latitude_or_elevation_rad = draw_number(state, -1.5, 1.5);
    view.sun_longitude_or_azimuth_rad = draw_number(state, -pi, pi);
    return view;
}

static double measure_distance(struct vector a, struct vec3 b)
{
    return vector_length((struct vector){a.x - b.x, a.y - b.y, a.z - b.z});
}

// Angle of the rotation between two cameras' frames.
static double measure_turn(const struct fly_camera *a, const struct fly_camera *b)
{
    const struct rotation turn =
        rotation_multiply(b->planet_from_camera, rotation_invert(a->planet_from_camera));
    const struct vector axis = {turn.x, turn.y, turn.z};
    return 2.0 * atan2(vector_length(axis), fabs(turn.w));
}

// Both make a frame of the same numbers: a few roundings of unit vectors, 1e-12 of a radian; 1e-6 m
// of 1e8.
static void assert_same_camera(const struct fly_camera *ours, const struct camera *theirs)
{
    assert_true(measure_distance(ours->position_m, theirs->position_m) < 1e-6);
    assert_true(measure_distance(fly_camera_right(ours), theirs->right) < 1e-12);
    assert_true(measure_distance(fly_camera_up(ours), theirs->up) < 1e-12);
    assert_true(measure_distance(fly_camera_forward(ours), theirs->forward) < 1e-12);
}

static void viewer_and_library_see_the_same(void **state)
{
    (void)state;
    uint64_t seed = 1;
    for (int i = 0; i < 2000; i++) {
        trl_view view = draw_view(&seed);
        if (i % 4 == 1) {
            view.latitude_rad = i % 8 == 1 ? pi / 2 : -pi / 2; // at the poles
        }
        if (i % 4 == 2) {
            view.pitch_rad = i % 8 == 2 ? pi / 2 : -pi / 2; // straight up and down
        }
        const struct fly_camera camera = fly_camera_from_view(&view, radius_m);
        const struct camera_place place = {.radius_m = radius_m, .ground_altitude_m = 0.0};
        const struct camera expected = camera_resolve(&view, &place, 1.0);
        assert_same_camera(&camera, &expected);
        // And back: other numbers may describe the same camera at the poles, but the camera is the
        // same.
        trl_view again = trl_view_default();
        fly_camera_to_view(&camera, &again);
        const struct fly_camera returned = fly_camera_from_view(&again, radius_m);
        // acos-like loss where the line of sight is nearly vertical: sqrt(1e-16) of a radian.
        assert_true(measure_turn(&camera, &returned) < 3e-7);
        assert_true(fabs(fly_camera_altitude_m(&returned) - view.altitude_m) < 1e-6);
    }
}

static void level_flight_keeps_altitude_and_horizon_over_the_pole(void **state)
{
    (void)state;
    trl_view view = trl_view_default();
    view.latitude_rad = 1.55;
    view.altitude_m = 1000.0;
    view.pitch_rad = 0.0;
    struct fly_camera camera = fly_camera_from_view(&view, radius_m);
    for (int i = 0; i < 4000; i++) {
        const struct fly_camera before = camera;
        fly_move(&camera, (struct fly_step){.forward_m = 100.0});
        // 100 m of 6372 km turn the frame by 1.57e-5; at no place by more.
        assert_true(measure_turn(&before, &camera) < 1.6e-5);
        assert_true(fabs(fly_camera_altitude_m(&camera) - 1000.0) < 1e-3);
    }
    trl_view now = trl_view_default();
    fly_camera_to_view(&camera, &now);
    // 400 km from 132 km before the pole: the far side is 270 km beyond it, and there the way leads
    // south.
    assert_true(fabs(now.latitude_rad - (pi - 1.55 - 400e3 / (radius_m + 1000.0))) < 1e-6);
    assert_true(fabs(fabs(now.heading_rad) - pi) < 1e-6);
    assert_true(fabs(now.pitch_rad) < 1e-6 && fabs(now.roll_rad) < 1e-6);
}

static void a_descent_from_orbit_ends_above_the_ground(void **state)
{
    (void)state;
    const double ground_m = 1234.0;
    trl_view view = trl_view_default();
    view.altitude_m = 2e7;
    view.pitch_rad = -pi / 2;
    struct fly_camera camera = fly_camera_from_view(&view, radius_m);
    double seconds = 0.0;
    bool has_landed = false;
    while (!has_landed && seconds < 60.0) {
        const double height_m = fly_camera_altitude_m(&camera) - ground_m;
        const double step_m = fly_speed_m_s(height_m) / 30.0;
        fly_move(&camera, (struct fly_step){.forward_m = step_m});
        has_landed = fly_stay_above(&camera, ground_m);
        assert_true(fly_camera_altitude_m(&camera) >= ground_m + fly_clearance_m - 1e-6);
        seconds += 1.0 / 30.0;
    }
    // ln(2e7 / 20) / 0.8 is 17 s, and a little more at the least speed.
    assert_true(has_landed && seconds < 20.0);
}

static void dragging_from_orbit_carries_the_planet_along(void **state)
{
    (void)state;
    trl_view view = trl_view_default();
    view.altitude_m = radius_m; // gain 1: the same angle at the camera and at the planet
    view.pitch_rad = -pi / 2;
    struct fly_camera camera = fly_camera_from_view(&view, radius_m);
    const double distance_m = vector_length(camera.position_m);
    const struct vector below = fly_camera_zenith(&camera);
    const struct vector right = fly_camera_right(&camera);
    fly_drag(&camera, 0.01, 0.0);
    assert_true(fabs(vector_length(camera.position_m) - distance_m) < 1e-6);
    // What was in the middle of the picture has gone to the right, so the camera has gone to the
    // left.
    assert_true(vector_dot(fly_camera_zenith(&camera), right) < -0.0099);
    assert_true(fabs(vector_dot(fly_camera_forward(&camera), fly_camera_zenith(&camera)) + 1.0) <
                1e-12);
    // Up: the surface point goes up in the picture.
    camera = fly_camera_from_view(&view, radius_m);
    fly_drag(&camera, 0.0, 0.01);
    assert_true(vector_dot(below, fly_camera_up(&camera)) > 0.0099);
}

static void dragging_in_orbit_has_no_pole(void **state)
{
    (void)state;
    trl_view view = trl_view_default();
    view.latitude_rad = 1.4;
    view.altitude_m = radius_m;
    view.pitch_rad = -pi / 2;
    struct fly_camera camera = fly_camera_from_view(&view, radius_m);
    for (int i = 0; i < 2000; i++) {
        const struct fly_camera before = camera;
        fly_drag(&camera, 0.0005, -0.002);
        assert_true(measure_turn(&before, &camera) < 0.0021);
    }
}

static void looking_up_stops_at_the_zenith_near_the_ground(void **state)
{
    (void)state;
    trl_view view = trl_view_default();
    view.altitude_m = 10.0;
    view.pitch_rad = 0.3;
    struct fly_camera camera = fly_camera_from_view(&view, radius_m);
    for (int i = 0; i < 100; i++) {
        fly_look(&camera, 0.01, -0.1); // the scene is pulled down: the camera looks up
        const double up = vector_dot(fly_camera_up(&camera), fly_camera_zenith(&camera));
        assert_true(up > -1e-7); // not head over heels; 1e-16 under a root is left of the stop
    }
    assert_true(vector_dot(fly_camera_forward(&camera), fly_camera_zenith(&camera)) > 1.0 - 1e-9);
    // Dragged sideways the horizon stays level.
    camera = fly_camera_from_view(&view, radius_m);
    fly_look(&camera, 0.7, 0.1);
    trl_view now = trl_view_default();
    fly_camera_to_view(&camera, &now);
    assert_true(fabs(now.roll_rad) < 1e-9);
    assert_true(fabs(now.pitch_rad - 0.2) < 1e-9);
    assert_true(fabs(now.heading_rad - (view.heading_rad - 0.7)) < 1e-9);
}

static void levelling_takes_out_the_roll_and_nothing_else(void **state)
{
    (void)state;
    trl_view view = trl_view_default();
    view.altitude_m = 10.0;
    view.pitch_rad = 0.2;
    view.roll_rad = 1.0;
    struct fly_camera camera = fly_camera_from_view(&view, radius_m);
    for (int i = 0; i < 300; i++) {
        fly_level(&camera, 0.02);
    }
    trl_view now = trl_view_default();
    fly_camera_to_view(&camera, &now);
    assert_true(fabs(now.roll_rad) < 1e-6);
    assert_true(fabs(now.pitch_rad - 0.2) < 1e-9);
    view.altitude_m = radius_m; // in orbit roll is as good as any
    camera = fly_camera_from_view(&view, radius_m);
    fly_level(&camera, 10.0);
    fly_camera_to_view(&camera, &now);
    assert_true(fabs(now.roll_rad - 1.0) < 1e-9);
}

static double measure_sun_turn(const trl_view *a, const trl_view *b)
{
    const struct vec3 from =
        vec3_from_lat_lon(a->sun_latitude_or_elevation_rad, a->sun_longitude_or_azimuth_rad);
    const struct vec3 to =
        vec3_from_lat_lon(b->sun_latitude_or_elevation_rad, b->sun_longitude_or_azimuth_rad);
    return vec3_length(vec3_sub(from, to));
}

static void a_flight_leads_smoothly_from_view_to_view(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int i = 0; i < 50; i++) {
        const trl_view from = draw_view(&seed);
        const trl_view to = draw_view(&seed);
        const struct fly_flight flight = fly_flight_plan(&from, &to, radius_m);
        const int steps = 2000;
        const double step_s = flight.duration_s / steps;
        struct fly_camera last = fly_camera_from_view(&from, radius_m);
        trl_view last_view = from;
        for (int k = 0; k <= steps; k++) {
            const trl_view view = fly_flight_view(&flight, k * step_s);
            const struct fly_camera now = fly_camera_from_view(&view, radius_m);
            // At most half a turn of its own, at 2.4 times the mean speed where it turns late, and
            // half one around the planet, at 1.5 times.
            assert_true(measure_turn(&last, &now) < (2.4 + 1.5) * pi / steps + 1e-6);
            assert_true(measure_sun_turn(&last_view, &view) < 1.5 * pi / steps + 1e-6);
            // Heights change by factors: ln(1e8 / 100) in all, and the arch.
            const double height_m = fly_camera_altitude_m(&now) + 100.0;
            assert_true(fabs(log(height_m / (fly_camera_altitude_m(&last) + 100.0))) < 0.3);
            assert_true(fly_camera_altitude_m(&now) > 1.9);
            last = now;
            last_view = view;
        }
        assert_true(measure_turn(&last, &flight.to) < 1e-6);
        assert_true(fabs(last_view.altitude_m - to.altitude_m) < 1e-6);
    }
}

// Over a plateau heights are counted from it: half way from 100 km to 10 m above it the camera is
// at their geometric mean (both with 100 m more), not at that of altitudes above the sphere.
static void heights_of_a_flight_are_above_the_ground(void **state)
{
    (void)state;
    trl_view from = trl_view_default();
    from.altitude_m = 105000;
    trl_view to = from;
    to.altitude_m = 5010;
    struct fly_flight flight = fly_flight_plan(&from, &to, radius_m);
    flight.from_ground_m = flight.to_ground_m = 5000;
    const trl_view half = fly_flight_view(&flight, flight.duration_s / 2);
    assert_true(fabs(half.altitude_m - (4900 + sqrt(100100.0 * 110.0))) < 1e-3);
}

// Stars turn the shorter way, and do not jump.
static void stars_turn_along(void **state)
{
    (void)state;
    trl_view from = trl_view_default();
    from.sidereal_rad = 0.1;
    trl_view to = from;
    to.latitude_rad = 0.5;
    to.sidereal_rad = 2 * pi - 0.1;
    const struct fly_flight flight = fly_flight_plan(&from, &to, radius_m);
    const trl_view half = fly_flight_view(&flight, flight.duration_s / 2);
    assert_true(fabs(half.sidereal_rad) < 1e-9);
}

static void opposite_vectors_and_equal_rotations_have_an_answer(void **state)
{
    (void)state;
    const struct vector x = {1.0, 0.0, 0.0};
    const struct vector back = rotation_apply(rotation_between(x, vector_scale(x, -1.0)), x);
    assert_true(fabs(back.x + 1.0) < 1e-12);
    const struct rotation r = rotation_about(x, 1.0);
    const struct rotation same = rotation_blend(r, r, 0.5);
    assert_true(fabs(same.w - r.w) < 1e-12 && fabs(same.x - r.x) < 1e-12);
}

static void pace_follows_the_machine(void **state)
{
    (void)state;
    struct pace pace = {0};
    for (int i = 0; i < 20; i++) {
        pace_learn(&pace, 1.0);
    }
    assert_true(pace_scale(&pace) == 0.25); // not below a quarter
    for (int i = 0; i < 100; i++) {
        pace_learn(&pace, 0.002);
    }
    assert_true(pace_scale(&pace) == 1.0);
    // A machine that needs 80 ms for all pixels finds a step that it keeps: at most 1/18 s, and no
    // flutter.
    int changes = 0;
    double last = 1.0;
    for (int i = 0; i < 200; i++) {
        const double scale = pace_scale(&pace);
        pace_learn(&pace, 0.08 * scale * scale);
        changes += scale != last;
        last = scale;
    }
    assert_true(0.08 * last * last < 1.0 / 18.0 && changes == 1);
    assert_int_equal(pace_pixels(1, 0.25), 1);
    assert_int_equal(pace_pixels(1280, 0.5), 640);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(viewer_and_library_see_the_same),
        cmocka_unit_test(level_flight_keeps_altitude_and_horizon_over_the_pole),
        cmocka_unit_test(a_descent_from_orbit_ends_above_the_ground),
        cmocka_unit_test(dragging_from_orbit_carries_the_planet_along),
        cmocka_unit_test(dragging_in_orbit_has_no_pole),
        cmocka_unit_test(looking_up_stops_at_the_zenith_near_the_ground),
        cmocka_unit_test(levelling_takes_out_the_roll_and_nothing_else),
        cmocka_unit_test(a_flight_leads_smoothly_from_view_to_view),
        cmocka_unit_test(heights_of_a_flight_are_above_the_ground),
        cmocka_unit_test(stars_turn_along),
        cmocka_unit_test(opposite_vectors_and_equal_rotations_have_an_answer),
        cmocka_unit_test(pace_follows_the_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
