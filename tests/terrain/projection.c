// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The projection of Michelic 2019 in closed form; no GPU.
#include "fixture.h"

#include "shared/hemisphere.glsl"
#include "terrain/projection.h"

#include <math.h>

static const double R = 6371000;

// Rounding of a handful of operations on numbers of the size of 1.
static const double ROUNDING = 1e-9;

static void test_lift_is_equation_3_as_printed(void **state)
{
    (void)state;
    const double distances[] = {R + 5000, R + 1e5, 2 * R, 11 * R};
    for (size_t i = 0; i < 4; i++) {
        const double d = distances[i];
        const double peak = R + 8800;
        const double h = sqrt(d * d - R * R);
        const double s = sqrt(peak * peak - R * R);
        const double printed = (peak * peak + d * d - (h + s) * (h + s)) / (2 * R * (h + s));
        // The printed form cancels: 16 digits of R^2 for a difference of d^2.
        assert_close(projection_lift(d, R, peak), printed, 1e-6 * (1 + fabs(printed)));
    }
}

static void test_lift_has_the_limits_of_horizons(void **state)
{
    (void)state;
    // No mountains: the horizon of the sphere. On the ground: the peak's own horizon.
    assert_close(atan2(1, projection_lift(2 * R, R, R)), acos(0.5), ROUNDING);
    assert_close(atan2(1, projection_lift(R, R, R + 8800)), acos(R / (R + 8800)), 1e-8);
    // From infinity half the sphere, and what stands up behind.
    assert_close(atan2(1, projection_lift(1e9 * R, R, R + 8800)), acos(0.0) + acos(R / (R + 8800)),
                 1e-8);
}

static double angle_of(LocalDirection d)
{
    return atan2(hypot(d.x, d.y), 1 + d.z);
}

static void test_grid_covers_the_cap_and_not_much_more(void **state)
{
    (void)state;
    const double altitudes[] = {2, 1000, 30000, 4e5, R, 10 * R};
    for (size_t i = 0; i < 6; i++) {
        const double lift = projection_lift(R + altitudes[i], R, R + 8800);
        const double reach = acos(R / (R + altitudes[i])) + acos(R / (R + 8800));
        double nearest = 9;
        for (int k = -1000; k <= 1000; k++) {
            const double t = k / 1000.0;
            const HemisphereRings rings = {1 / (1 + (double)(i % 3)), 1 + 0.5 * (double)(i % 2)};
            nearest = fmin(nearest, angle_of(hemisphere_direction(1, t, rings, lift)));
            nearest = fmin(nearest, angle_of(hemisphere_direction(t, -1, rings, lift)));
        }
        // The border's nearest points are the middles of its sides, which lie on the cap's edge.
        assert_close(nearest, reach, 1e-6);
    }
}

static void test_directions_keep_digits_near_the_middle(void **state)
{
    (void)state;
    // 1 mm on Earth: in single precision, relative to itself, not to the planet.
    const double lift = 20;
    const HemisphereRings even = {1, 1}, bent = {0.4, 1.7};
    const LocalDirection d = hemisphere_direction(3.3e-9, 0, even, lift);
    assert_close(d.x * 21 / 3.3e-9, 1, ROUNDING);
    assert_close(d.z / (-0.5 * d.x * d.x), 1, ROUNDING);
    const LocalDirection far = hemisphere_direction(0.9, -0.4, bent, -0.3);
    assert_close(far.x * far.x + far.y * far.y + (1 + far.z) * (1 + far.z), 1, ROUNDING);
}

static void test_shadow_map_is_its_own_inverse(void **state)
{
    (void)state;
    for (int i = 0; i < 200; i++) {
        const double gx = cos(i) * (0.01 + i / 210.0);
        const double gy = sin(3 * i) * (i / 210.0);
        LocalDirection d = shadow_map_direction(gx, gy, 2.7, 0.6);
        const double length = 1 + i * 0.01; // any length
        d.x *= length;
        d.y *= length;
        d.z = (1 + d.z) * length - 1;
        const double scale = shadow_map_scale(d, 2.7, 0.6);
        assert_close(d.x * scale, gx, ROUNDING);
        assert_close(d.y * scale, gy, ROUNDING);
    }
}

static void test_power_puts_the_ring_where_it_is_wanted(void **state)
{
    (void)state;
    const double power = projection_power(0.01, 40, 400);
    assert_close(pow(0.1, power), 0.01, ROUNDING);
    assert_close(projection_power(0.9, 40, 400), 1, 0); // the paper's own grid
    assert_close(projection_power(1e-9, 40, 400), 4, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lift_is_equation_3_as_printed),
        cmocka_unit_test(test_lift_has_the_limits_of_horizons),
        cmocka_unit_test(test_grid_covers_the_cap_and_not_much_more),
        cmocka_unit_test(test_directions_keep_digits_near_the_middle),
        cmocka_unit_test(test_shadow_map_is_its_own_inverse),
        cmocka_unit_test(test_power_puts_the_ring_where_it_is_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
