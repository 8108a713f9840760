// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The light of bodies at each phase, against integrals over the disc and the Moon as measured.
#include "sky/body_light.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static const double PI = 3.14159265358979323846;

static void assert_near(double value, double expected, double tolerance)
{
    assert_float_equal((float)(value - expected), 0, (float)tolerance);
}

// Brightness of a point of a disc with radiance 1 at its centre when fully lit: mu toward the
// eye, mu0 toward the star.
static double reflect(enum body_law law, double mu0, double mu)
{
    return law == BODY_LAMBERT ? mu0 : 2 * mu0 / (mu0 + mu);
}

// The disc summed in a raster of the orthographic image, its centre fully lit 1.
static double sum_disc(enum body_law law, double angle_rad)
{
    enum { SIDE = 600 };
    double sum = 0;
    for (int i = 0; i < SIDE * SIDE; i++) {
        const double x = (2 * (i % SIDE) + 1.0) / SIDE - 1;
        const double y = (2.0 * (i / SIDE) + 1.0) / SIDE - 1;
        const double mu2 = 1 - x * x - y * y;
        const double mu = sqrt(fmax(mu2, 0));
        const double mu0 = x * sin(angle_rad) + mu * cos(angle_rad);
        sum += mu2 > 0 && mu0 > 0 ? reflect(law, mu0, mu) : 0;
    }
    return sum;
}

// The raster's edge is worth 1e-3 of the full disc.
static void phases_are_sums_over_the_disc(void **state)
{
    (void)state;
    const enum body_law laws[] = {BODY_LOMMEL_SEELIGER, BODY_LAMBERT};
    for (int l = 0; l < 2; l++) {
        const double full = sum_disc(laws[l], 0);
        for (int deg = 0; deg <= 170; deg += 34) {
            const double angle_rad = deg * PI / 180;
            assert_near(body_phase(laws[l], angle_rad), sum_disc(laws[l], angle_rad) / full, 1e-3);
        }
    }
}

// Full: geometric albedo, size and distance of the Moon and the sun's 1.33e5 lx give the order of
// 0.3 lx. At quarter Eq. 9 of Krisciunas and Schaefer (1991), by hand: 0.026 90 + 4e-9 90^4.
static void the_moon_follows_its_fit(void **state)
{
    (void)state;
    const double full_lx = 0.12 * pow(1737.4 / 384400, 2) * 1.33e5;
    assert_true(full_lx > 0.25 && full_lx < 0.35);
    assert_near(body_phase(BODY_LUNAR, 0), 1, 1e-12);
    assert_near(-2.5 * log10(body_phase(BODY_LUNAR, PI / 2)), 2.6024, 1e-3);
}

static void phases_end_dark_and_never_jump(void **state)
{
    (void)state;
    for (int law = BODY_LOMMEL_SEELIGER; law <= BODY_LUNAR; law++) {
        double last = body_phase((enum body_law)law, 0);
        for (int i = 1; i <= 18000; i++) {
            const double phase = body_phase((enum body_law)law, i * PI / 18000);
            assert_true(phase >= 0 && phase <= last + 1e-9 && last - phase < 1e-3);
            last = phase;
        }
        assert_near(last, 0, 1e-9);
        assert_near(body_phase((enum body_law)law, 4), 0, 1e-9);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phases_are_sums_over_the_disc),
        cmocka_unit_test(the_moon_follows_its_fit),
        cmocka_unit_test(phases_end_dark_and_never_jump),
    };
    return cmocka_run_group_tests_name("body light", tests, NULL, NULL);
}
