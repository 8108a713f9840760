// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The exponential of the light transport against the C library's in double. Compiled twice: as the
// library is, and with -O3 -ffast-math as its hot loops are.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "base/lanes.h"

// Sixteen at a time, through memory, as the transport uses it.
static void exp_of(const float *x, float *out)
{
    lanes in;
    memcpy(&in, x, sizeof in);
    const lanes result = lanes_exp_negative(in);
    memcpy(out, &result, sizeof result);
}

// What the header promises: two or three of a float's last digits, 1.2e-7 of 1 each. With
// -ffast-math x - n log 2 and log 2 itself are rounded at the size of x, which exp turns into a
// relative error.
static double error_allowed(double x)
{
#ifdef __FAST_MATH__
    return 3e-7 + 1e-7 * fabs(x);
#else
    (void)x;
    return 3e-7;
#endif
}

static void exp_is_right_over_its_range(void **state)
{
    (void)state;
    enum { STEPS = 87 * 4096 };
    double worst = 0; // as a fraction of what is allowed
    for (int i = 0; i < STEPS; i += LANES) {
        float x[LANES], y[LANES];
        for (int k = 0; k < LANES; k++) {
            x[k] = -86.999f * (float)(i + k) / (float)(STEPS - 1);
        }
        exp_of(x, y);
        for (int k = 0; k < LANES; k++) {
            const double right = exp((double)x[k]);
            worst = fmax(worst, fabs((double)y[k] / right - 1) / error_allowed((double)x[k]));
        }
    }
    assert_true(worst < 1);
    assert_true(worst > 0.1); // a float cannot be better: the comparison is no comparison
}

static void exp_of_zero_is_one(void **state)
{
    (void)state;
    const float x[LANES] = {0.0f, -0.0f};
    float y[LANES];
    exp_of(x, y);
    for (int k = 0; k < LANES; k++) {
        assert_true(y[k] == 1.0f);
    }
}

static void exp_vanishes_below_its_range(void **state)
{
    (void)state;
    float x[LANES], y[LANES];
    for (int k = 0; k < LANES; k++) {
        x[k] = k % 2 ? -3.0e38f : -87.0f - (float)(k * k);
    }
    exp_of(x, y);
    for (int k = 0; k < LANES; k++) {
        assert_true(y[k] >= 0 && y[k] < 2e-38f); // e^-87 = 1.6e-38
    }
}

static void exp_never_rises_as_depth_grows(void **state)
{
    (void)state;
    // By more than its error, where it is steep.
    float last = 1.0f;
    for (int i = 0; i < 100000; i += LANES) {
        float x[LANES], y[LANES];
        for (int k = 0; k < LANES; k++) {
            x[k] = -1e-4f * (float)(i + k);
        }
        exp_of(x, y);
        for (int k = 0; k < LANES; k++) {
            assert_true(y[k] <= last * (1 + 2 * (float)error_allowed(10)));
            last = y[k];
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(exp_is_right_over_its_range),
        cmocka_unit_test(exp_of_zero_is_one),
        cmocka_unit_test(exp_vanishes_below_its_range),
        cmocka_unit_test(exp_never_rises_as_depth_grows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
