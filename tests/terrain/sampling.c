// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The formulas of planetary projective grid mapping against closed forms, and the sampling camera
// against rays; no GPU.
#include "fixture.h"

#include "shared/projective.glsl"
#include "terrain/sampling_camera.h"

#include <math.h>
#include <stdlib.h>

static const double R = 6371000;

// Rounding of a dozen operations on numbers of the size of 1.
static const double ROUNDING = 1e-12;

static void test_tangent_ray_of_two_radii(void **state)
{
    (void)state;
    const double excess = projective_excess(1, 1);
    const double tangent = projective_tangent(excess);
    assert_close(excess, 3, ROUNDING);
    assert_close(tangent, SHARED_PI / 6, ROUNDING);
    assert_close(projective_normal_angle(tangent, tangent, excess), SHARED_PI / 3, ROUNDING);
    assert_close(projective_distance(tangent, tangent, excess, 1), sqrt(3), ROUNDING);
}

static void test_positions_follow_the_law_of_sines(void **state)
{
    (void)state;
    const double altitudes[] = {1000, 1e5, R, 100 * R};
    for (size_t i = 0; i < 4; i++) {
        const double a = altitudes[i];
        const double excess = projective_excess(a, R);
        const double tangent = projective_tangent(excess);
        for (int k = 1; k < 100; k++) {
            const double omega = tangent * k / 100;
            const double gamma = projective_normal_angle(omega, tangent, excess);
            assert_close(gamma, asin((a + R) / R * sin(omega)) - omega, 1e-9 * gamma);
            // The paper's rho and chi, the latter with the omega that its text leaves out.
            const double chi = SHARED_PI / 2 - gamma / 2 - omega;
            const double printed = a * sin(SHARED_PI / 2 + gamma / 2) / sin(chi);
            const double t = projective_distance(omega, tangent, excess, a);
            assert_close(t, printed, 1e-9 * printed);
            // On the sphere, under omega.
            assert_close(hypot(t * sin(omega), R + a - t * cos(omega)), R, 1e-9 * R);
        }
    }
}

// A centimetre above the ground digits go first: compared with the ground as a plane, which it is
// to a part in a million within ten metres.
static void test_a_centimetre_above_the_ground_nothing_cancels(void **state)
{
    (void)state;
    const double excess = projective_excess(0.01, R);
    const double tangent = projective_tangent(excess);
    for (double omega = 0.1; omega < 1.56; omega += 0.1) {
        const double t = projective_distance(omega, tangent, excess, 0.01);
        assert_close(t * cos(omega), 0.01, 1e-8);
        assert_close(projective_normal_angle(omega, tangent, excess) * R, 0.01 * tan(omega), 1e-6);
    }
    const double horizon = sqrt(0.01 * (2 * R + 0.01));
    assert_close(projective_distance(tangent, tangent, excess, 0.01), horizon, 1e-3);
}

static void test_reach_is_where_the_tangent_leaves_the_maximum_sphere(void **state)
{
    (void)state;
    const double d = R + 30000;
    const double reach = projective_reach(projective_excess(30000, R), R, 8800);
    const double wanted = acos(R / d) + acos(R / (R + 8800));
    assert_close(reach, wanted, 1e-9);
    // Eq. 4: the secondary sphere's own tangent point is there.
    const double secondary = d * cos(reach);
    const double excess = projective_excess(d - secondary, secondary);
    const double tangent = projective_tangent(excess);
    assert_close(tangent, SHARED_PI / 2 - reach, 1e-9);
    assert_close(projective_normal_angle(tangent, tangent, excess), reach, 1e-9);
}

static void test_blend_ascends_from_the_nadir_to_the_reach(void **state)
{
    (void)state;
    const double altitudes[] = {0.01, 2, 100, 1e4, 4e5, R, 9 * R, 100 * R};
    for (size_t i = 0; i < 8; i++) {
        for (int k = 0; k < 4; k++) {
            const double excess = projective_excess(altitudes[i], R);
            const double tangent = projective_tangent(excess);
            const double reach = projective_reach(excess, R, 10.0 + 12000.0 * k);
            const double start =
                0.5 * fmin(tangent, fmax(SHARED_PI / 2 - reach, 0)); // Section 3's b
            double last = -1e-12;
            for (int j = 0; j <= 1000; j++) {
                const double omega = tangent * j / 1000;
                const double gamma = projective_blended_angle(omega, excess, reach, 0.5);
                assert_true(gamma > last);
                last = gamma;
                if (omega < start) { // of the primary sphere alone
                    assert_close(gamma, projective_normal_angle(omega, tangent, excess), 1e-12);
                }
            }
            // At a tangent a rounding of 1e-16 is one of its root.
            assert_close(last, reach, 1e-7);
        }
    }
}

static void test_rings_reach_from_the_nadir_to_the_end(void **state)
{
    (void)state;
    const double near[] = {1e-9, 1e-4, 10};
    for (size_t i = 0; i < 3; i++) {
        assert_close(projective_rings_within(0, near[i], 0.3), 0, 1e-15);
        assert_close(projective_rings_within(0.3, near[i], 0.3), 1, 1e-12);
        // A half is even.
        const double middle = projective_rings_within(0.15, near[i], 0.3);
        assert_close(middle, 0.25 + 0.5 * asinh(0.15 / near[i]) / asinh(0.3 / near[i]), 1e-9);
    }
}

static double random_between(double low, double high)
{
    return low + (high - low) * rand() / RAND_MAX;
}

static struct sampling_camera random_camera(void)
{
    // A camera as such: where it is does not matter to what is tested below.
    const struct vec3 forward = vec3_normalize(
        (struct vec3){random_between(-1, 1), random_between(-1, 1), random_between(-1, 1)});
    const struct vec3 other = vec3_normalize(
        (struct vec3){random_between(-1, 1), random_between(-1, 1), random_between(-1, 1)});
    const struct vec3 right = vec3_normalize(vec3_cross(forward, other));
    const double half = random_between(0.005, 1.3); // up to fields of view of 150 degrees
    const struct camera camera = {.position_m = {0, 0, 1.001},
                                  .right = right,
                                  .up = vec3_cross(right, forward),
                                  .forward = forward,
                                  .tan_half_fov_x = tan(half),
                                  .tan_half_fov_y = tan(half) * random_between(0.3, 1)};
    // A ball without layers: the whole sphere at altitude 0.
    static struct surface_bounds zero[SURFACE_BOUNDS_COLUMNS * SURFACE_BOUNDS_ROWS];
    const struct surface ball = {.radius_m = 1, .bounds = zero};
    return sampling_camera_make(&ball, &camera);
}

// Everything that is in the picture lies within the azimuths, and in its column's range.
static void test_every_ray_of_the_picture_is_within_the_columns(void **state)
{
    (void)state;
    srand(3);
    for (int i = 0; i < 300; i++) {
        const struct sampling_camera s = random_camera();
        for (int k = 0; k < 100; k++) {
            const double x = random_between(-1, 1) * s.tan_half_fov_x;
            const double y = random_between(-1, 1) * s.tan_half_fov_y;
            const struct vec3 ray = vec3_normalize(
                vec3_add(s.forward, vec3_add(vec3_scale(s.right, x), vec3_scale(s.up, y))));
            const double azimuth = atan2(ray.y, ray.x);
            const double middle = 0.5 * (s.from_rad + s.to_rad);
            const double away = remainder(azimuth - middle, 2 * SHARED_PI);
            assert_true(fabs(away) <= 0.5 * (s.to_rad - s.from_rad) + 1e-9);
            const struct sampling_range range = sampling_camera_range(&s, azimuth);
            const double omega = acos(-ray.z);
            assert_true(omega >= range.from_rad - 1e-7 && omega <= range.to_rad + 1e-7);
        }
    }
}

static void test_columns_go_round_in_order(void **state)
{
    (void)state;
    enum { COUNT = 64 };
    srand(5);
    int circles = 0;
    for (int i = 0; i < 300; i++) {
        const struct sampling_camera s = random_camera();
        float columns[4 * (COUNT + 2)];
        sampling_camera_columns(&s, COUNT, columns);
        double turned = 0;
        for (int k = 0; k < COUNT; k++) {
            const float *a = columns + (size_t)4 * k;
            const double step =
                atan2((double)(a[0] * a[5] - a[1] * a[4]), (double)(a[0] * a[4] + a[1] * a[5]));
            assert_true(step > 0);
            turned += step;
        }
        // A circle closes with the same numbers; else there is at least the picture.
        circles += s.is_circle;
        assert_true(turned > s.to_rad - s.from_rad - 1e-4);
        for (int c = 0; c < 8 && s.is_circle; c++) {
            assert_true(columns[c] == columns[4 * COUNT + c]);
        }
    }
    assert_true(circles > 20 && circles < 280);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tangent_ray_of_two_radii),
        cmocka_unit_test(test_positions_follow_the_law_of_sines),
        cmocka_unit_test(test_a_centimetre_above_the_ground_nothing_cancels),
        cmocka_unit_test(test_reach_is_where_the_tangent_leaves_the_maximum_sphere),
        cmocka_unit_test(test_blend_ascends_from_the_nadir_to_the_reach),
        cmocka_unit_test(test_rings_reach_from_the_nadir_to_the_end),
        cmocka_unit_test(test_every_ray_of_the_picture_is_within_the_columns),
        cmocka_unit_test(test_columns_go_round_in_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
