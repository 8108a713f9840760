// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Light scattered by spheres against published values, limits and sum rules.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <string.h>

#include "log.h"
#include "scatter/mie_population.h"

#define PI 3.14159265358979323846

static void assert_near(double got, double wanted, double tolerance)
{
    if (!(fabs(got - wanted) <= tolerance)) {
        fail_msg("got %.12g, wanted %.12g within %g", got, wanted, tolerance);
    }
}

static struct mie_efficiencies sphere(trl_context *ctx, double size, double complex index)
{
    struct mie_series series;
    assert_int_equal(mie_series_init(ctx, size, 1, &series), TRL_OK);
    mie_series_compute(&series, size, index);
    const struct mie_efficiencies q = mie_series_efficiencies(&series);
    mie_series_finish(ctx, &series);
    return q;
}

// The cases of Wiscombe 1979, "Mie Scattering Calculations", NCAR/TN-140+STR, printed to six
// digits after the point.
static void efficiencies_are_the_published_ones(void **state)
{
    const struct {
        double real, imaginary, size, extinction, scattering, asymmetry;
    } cases[] = {
        {0.75, 0, 10, 2.232265, 2.232265, 0.896473},
        {0.75, 0, 1000, 1.997908, 1.997908, 0.844944},
        {1.5, 0, 10, 2.881999, 2.881999, 0.742913},
        {1.5, 0, 100, 2.094388, 2.094388, 0.818246},
        {1.5, 0, 1000, 2.013945, 2.013945, 0.827882},
        {1.33, 1e-5, 1, 0.093952, 0.093923, 0.184517},
        {1.33, 1e-5, 100, 2.101321, 2.096594, 0.868959},
        {1.5, 1, 0.055, 0.101491, 0.000011, 0.000491},
        {1.5, 1, 1, 2.336321, 0.663454, 0.192136},
        {1.5, 1, 100, 2.097502, 1.283697, 0.850252},
        {10, 10, 1, 2.532993, 2.049405, -0.110664},
        {10, 10, 100, 2.071124, 1.836785, 0.556215},
    };
    const double printed = 1e-6; // and computed in single precision
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct mie_efficiencies q =
            sphere(*state, cases[i].size, mie_complex(cases[i].real, cases[i].imaginary));
        assert_near(q.extinction, cases[i].extinction, printed);
        assert_near(q.scattering, cases[i].scattering, printed);
        assert_near(q.asymmetry, cases[i].asymmetry, printed);
    }
}

// Bohren and Huffman 1983, Eq. 5.7 to 5.9: the series' next term is smaller by x^2.
static void small_spheres_scatter_as_rayleigh_says(void **state)
{
    const double sizes[] = {0.001, 0.01, 0.03};
    const double complex m = mie_complex(1.5, 0.1);
    const double complex polarisability = (m * m - 1) / (m * m + 2);
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        const double x = sizes[i];
        const struct mie_efficiencies q = sphere(*state, x, m);
        const double scattering = 8.0 / 3 * pow(x, 4) * pow(cabs(polarisability), 2);
        const double absorption = 4 * x * cimag(polarisability);
        assert_near(q.scattering / scattering, 1, 3 * x * x + 1e-9);
        assert_near((q.extinction - q.scattering) / absorption, 1, 3 * x * x + 1e-9);
        assert_near(q.asymmetry, 0, x * x);
    }
}

// Twice the geometric shadow: what is hit and as much diffracted. The edge adds about 2 x^(-2/3)
// (van de Hulst 1957, Section 17.21).
static void large_spheres_take_twice_their_shadow(void **state)
{
    for (double x = 250; x <= MIE_MAX_SIZE; x *= 2) {
        const struct mie_efficiencies q = sphere(*state, x, mie_complex(1.5, 0.5));
        assert_near(q.extinction, 2 + 2 * pow(x, -2.0 / 3), 0.3 * pow(x, -2.0 / 3));
    }
}

static void spheres_that_do_not_absorb_scatter_all(void **state)
{
    for (double x = 0.01; x < MIE_MAX_SIZE; x *= 3.7) {
        const struct mie_efficiencies q = sphere(*state, x, 1.44);
        // The lowest terms lose digits as x^-3.
        assert_near(q.scattering / q.extinction, 1, 1e-12 + 1e-15 / (x * x * x));
    }
}

static struct mie_population *make_population(trl_context *ctx, enum mie_size_kind kind,
                                              double radius_m, double variance)
{
    struct mie_population *population = mem_alloc(ctx, 1, sizeof *population);
    assert_non_null(population);
    const struct mie_sizes sizes = {kind, radius_m, variance};
    double largest = 0;
    assert_int_equal(mie_population_init(ctx, &sizes, 360, &largest, population), TRL_OK);
    return population;
}

static void destroy_population(trl_context *ctx, struct mie_population *population)
{
    mie_population_finish(ctx, population);
    mem_free(ctx, population);
}

static double sum_powers(const struct mie_population *p, int power)
{
    double sum = 0;
    for (int i = 0; i < MIE_RADII; i++) {
        sum += p->share[i] * pow(p->radius_m[i], power);
    }
    return sum;
}

static void sizes_have_the_effective_radius_and_variance(void **state)
{
    const struct mie_sizes cases[] = {{MIE_SIZE_LOG_NORMAL, 1.5e-6, 0.3},
                                      {MIE_SIZE_LOG_NORMAL, 1e-6, 0.002},
                                      {MIE_SIZE_LOG_NORMAL, 5e-8, 0.1},
                                      {MIE_SIZE_GAMMA, 1.05e-6, 0.07},
                                      {MIE_SIZE_GAMMA, 1e-5, 0.4}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct mie_population *p = make_population(
            *state, cases[i].kind, cases[i].effective_radius_m, cases[i].effective_variance);
        const double radius = sum_powers(p, 3) / sum_powers(p, 2);
        const double variance = sum_powers(p, 4) * sum_powers(p, 2) / pow(sum_powers(p, 3), 2) - 1;
        // A millionth is left out at each end.
        assert_near(radius / cases[i].effective_radius_m, 1, 1e-4);
        assert_near(variance / cases[i].effective_variance, 1, 1e-3);
        destroy_population(*state, p);
    }
}

// The phase function, integrated, gives back what the coefficients' sums say: its norm the
// scattering cross section, its first moment the asymmetry.
static void intensities_integrate_to_the_cross_section(void **state)
{
    const struct mie_sizes cases[] = {{MIE_SIZE_LOG_NORMAL, 1.5e-6, 0.3},
                                      {MIE_SIZE_LOG_NORMAL, 5e-8, 0.1},
                                      {MIE_SIZE_GAMMA, 1.05e-6, 0.07},
                                      {MIE_SIZE_GAMMA, 1e-5, 0.1}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        trl_context *ctx = *state;
        struct mie_population *p = make_population(ctx, cases[i].kind, cases[i].effective_radius_m,
                                                   cases[i].effective_variance);
        struct mie_optics optics;
        mie_population_compute(p, 500, mie_complex(1.45, 0.002), true, &optics);
        struct phase phase;
        assert_int_equal(phase_table_init(ctx, p->angle_rad, optics.intensity, MIE_ANGLES, &phase),
                         TRL_OK);
        // S is per wave number k: C_sca p(angle) = |S|^2 / k^2.
        const double wave_number = 2 * PI / 500e-9;
        const double norm = optics.intensity[0] / phase.value[0] / (wave_number * wave_number);
        // The table is linear between its angles, 1 degree apart in the middle.
        assert_near(norm / optics.scattering_m2, 1, 3e-3);
        double moments[2];
        phase_moments(&phase, 1, moments);
        assert_near(moments[1], optics.asymmetry, 2e-3);
        mem_free(ctx, phase.angle_rad);
        destroy_population(ctx, p);
    }
}

static void tiny_spheres_have_the_rayleigh_phase_function(void **state)
{
    trl_context *ctx = *state;
    struct mie_population *p = make_population(ctx, MIE_SIZE_GAMMA, 2e-9, 0.05);
    struct mie_optics optics;
    mie_population_compute(p, 600, 1.4, true, &optics);
    const double forward = optics.intensity[0];
    for (int i = 0; i < MIE_ANGLES; i++) {
        const double nu = cos(p->angle_rad[i]);
        // The asymmetry is of the order x^2 = 4e-4.
        assert_near(optics.intensity[i] / forward, (1 + nu * nu) / 2, 2e-3);
    }
    destroy_population(ctx, p);
}

static void spheres_that_are_too_large_are_refused(void **state)
{
    struct mie_population *population = mem_alloc(*state, 1, sizeof *population);
    const struct mie_sizes sizes = {MIE_SIZE_GAMMA, 1e-3, 0.1};
    double largest = 0;
    assert_int_equal(mie_population_init(*state, &sizes, 360, &largest, population),
                     TRL_ERROR_UNSUPPORTED);
    assert_true(largest > MIE_MAX_SIZE);
    mem_free(*state, population);
}

static int make_context(void **state)
{
    static struct test_log log;
    *state = test_context(&log);
    return *state == NULL;
}

static int free_context(void **state)
{
    trl_context_destroy((trl_context **)state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(efficiencies_are_the_published_ones),
        cmocka_unit_test(small_spheres_scatter_as_rayleigh_says),
        cmocka_unit_test(large_spheres_take_twice_their_shadow),
        cmocka_unit_test(spheres_that_do_not_absorb_scatter_all),
        cmocka_unit_test(sizes_have_the_effective_radius_and_variance),
        cmocka_unit_test(intensities_integrate_to_the_cross_section),
        cmocka_unit_test(tiny_spheres_have_the_rayleigh_phase_function),
        cmocka_unit_test(spheres_that_are_too_large_are_refused),
    };
    return cmocka_run_group_tests(tests, make_context, free_context);
}
