// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The model of Santana 2017 on the CPU: columns against integration, their symmetries, where
// samples lie, and radiances against the solver with one order.
#include "reference_media.h"

#include "base/context.h"
#include "scatter/rayleigh.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static const double DEGREE = M_PI / 180;
static const double WAVELENGTH_NM = 550;

// The paper's planet: 50 km of air with a scale height of 7994 m.
static const double GROUND_M = 6.371e6;
static const double HEIGHT_M = 50e3;
static const double SCALE_M = 7994;

static void assert_near(double got, double expected, double relative)
{
    if (!(fabs(got - expected) <= relative * fabs(expected))) {
        fail_msg("got %.7g, expected %.7g within %g %%", got, expected, 100 * relative);
    }
}

static void make_depth(struct rayleigh_depth *depth, trl_rayleigh_depth kind)
{
    trl_rayleigh_desc desc = trl_rayleigh_desc_default();
    desc.optical_depth = kind;
    const RayleighAir air = rayleigh_air_make(GROUND_M, HEIGHT_M, SCALE_M);
    rayleigh_depth_init(depth, &air, &desc);
}

// By the trapezoidal rule along X, which knows nothing of inverse air masses and of symmetries.
static double integrate_g(double phi_rad, double altitude_m)
{
    const double radius = GROUND_M + altitude_m;
    const double y0 = radius * sin(phi_rad);
    const double x1 = radius * cos(phi_rad);
    const double top = GROUND_M + HEIGHT_M;
    if (fabs(y0) >= top) {
        return 0;
    }
    const double x0 = -sqrt(top * top - y0 * y0);
    enum { STEPS = 20000 };
    double sum = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double x = x0 + (x1 - x0) * i / STEPS;
        const double h = sqrt(x * x + y0 * y0) - GROUND_M;
        sum += exp(-h / SCALE_M) * (i == 0 || i == STEPS ? 0.5 : 1);
    }
    return x1 > x0 ? sum * (x1 - x0) / STEPS : 0;
}

// The largest error that the texture may have; the interpolation between its texels is the reason.
static const double MAP_ERROR = 3e-3;

static void the_map_is_the_column(void **state)
{
    (void)state;
    static struct rayleigh_depth depth;
    make_depth(&depth, TRL_RAYLEIGH_TEXTURE);
    for (double altitude = 10; altitude < HEIGHT_M; altitude += 4000) {
        for (double phi = 90; phi <= 180; phi += 3) {
            assert_near(rayleigh_depth_g(&depth, phi * DEGREE, altitude),
                        integrate_g(phi * DEGREE, altitude), MAP_ERROR);
        }
    }
}

static void g_has_its_four_symmetries(void **state)
{
    (void)state;
    static struct rayleigh_depth depth;
    make_depth(&depth, TRL_RAYLEIGH_TEXTURE);
    for (double altitude = 10; altitude < HEIGHT_M; altitude += 4000) {
        for (double phi = 1; phi < 180; phi += 7) {
            assert_true(rayleigh_depth_g(&depth, phi * DEGREE, altitude) ==
                        rayleigh_depth_g(&depth, -phi * DEGREE, altitude));
        }
        assert_true(rayleigh_depth_g(&depth, 60 * DEGREE, altitude) > 1e300); // through the planet
        // Just above the horizon the line has been at its closest point already.
        const double phi =
            acos(sqrt(altitude * (2 * GROUND_M + altitude)) / (GROUND_M + altitude)) + 0.5 * DEGREE;
        if (phi < M_PI / 2) {
            assert_near(rayleigh_depth_g(&depth, phi, altitude), integrate_g(phi, altitude),
                        MAP_ERROR);
        }
    }
    assert_true(rayleigh_depth_g(&depth, 120 * DEGREE, HEIGHT_M + 1) == 0);
    assert_true(rayleigh_depth_g(&depth, M_PI / 2, HEIGHT_M + 1) == 0);
    assert_true(rayleigh_depth_g(&depth, 120 * DEGREE, -1) > 1e300);
}

static void the_fit_is_better_than_the_papers(void **state)
{
    (void)state;
    static struct rayleigh_depth depth;
    make_depth(&depth, TRL_RAYLEIGH_FIT); // ten heights, as in Section 8.1
    const struct rayleigh_errors fit = rayleigh_depth_errors(&depth);
    make_depth(&depth, TRL_RAYLEIGH_TEXTURE);
    const struct rayleigh_errors map = rayleigh_depth_errors(&depth);
    printf("mean and largest error: fit %.3f %%, %.2f %%; texture %.4f %%, %.3f %%\n",
           100 * fit.mean, 100 * fit.largest, 100 * map.mean, 100 * map.largest);
    assert_true(fit.mean < 0.0284 / 10);
    assert_true(fit.largest < 0.15);
    assert_true(map.mean < 1e-4 && map.largest < MAP_ERROR);
}

static void fits_get_better_with_degree_and_heights(void **state)
{
    (void)state;
    static struct rayleigh_depth depth;
    const RayleighAir air = rayleigh_air_make(GROUND_M, HEIGHT_M, SCALE_M);
    trl_rayleigh_desc desc = trl_rayleigh_desc_default();
    desc.optical_depth = TRL_RAYLEIGH_FIT;
    desc.fit_heights = TRL_RAYLEIGH_MAX_HEIGHTS;
    double before = 1e9;
    for (desc.fit_degree = 2; desc.fit_degree <= TRL_RAYLEIGH_MAX_DEGREE; desc.fit_degree++) {
        rayleigh_depth_init(&depth, &air, &desc);
        const double mean = rayleigh_depth_errors(&depth).mean;
        assert_true(mean < 0.7 * before);
        before = mean;
    }
    desc.fit_heights = 3;
    rayleigh_depth_init(&depth, &air, &desc);
    assert_true(rayleigh_depth_errors(&depth).mean > 2 * before);
}

static void samples_are_dense_where_the_line_is_low(void **state)
{
    (void)state;
    // V of Section 7, stretched to reach 1: the paper's ends exp(-2.5) = 0.08 before.
    assert_true(rayleigh_spread(0) == 0);
    assert_near(rayleigh_spread(1), 1, 1e-15);
    assert_near(rayleigh_spread(0.4) * (1 - exp(-2.5)), 1 - exp(-2.5 * 0.4), 1e-12);
    // A line that crosses: symmetric about the closest point, which is the middle sample (Eq. 11).
    const RayleighLegs both = {-1000, 0, 0, 1000, 0.5};
    assert_true(rayleigh_place(both, 0) == -1000 && rayleigh_place(both, 1) == 1000);
    assert_true(fabs(rayleigh_place(both, 0.5)) < 1e-9);
    for (int i = 0; i <= 6; i++) {
        const double x = rayleigh_place(both, i / 12.0);
        assert_near(-x, 1000 * (1 - rayleigh_spread(i / 6.0)), 1e-9 + (i == 6 ? 1e9 : 0));
        assert_true(fabs(x + rayleigh_place(both, 1 - i / 12.0)) < 1e-9);
    }
    // One that does not: Eq. 10.
    const RayleighLegs one = {-1000, -200, -200, -200, 1};
    for (int i = 0; i <= 4; i++) {
        assert_near(rayleigh_place(one, i / 4.0), -1000 + rayleigh_spread(i / 4.0) * 800, 1e-12);
    }
}

static void the_shadow_is_a_cylinder(void **state)
{
    (void)state;
    const RayleighAir air = rayleigh_air_make(GROUND_M, HEIGHT_M, SCALE_M);
    for (double sun = 0; sun <= 180; sun += 7.3) {
        for (double view = 0; view <= 90; view += 7.7) {
            for (double azimuth = 0; azimuth <= 180; azimuth += 30) {
                const double eye_m = GROUND_M + 20e3;
                const double mu = cos(view * DEGREE);
                const double nu = mu * cos(sun * DEGREE) +
                                  sin(view * DEGREE) * sin(sun * DEGREE) * cos(azimuth * DEGREE);
                const double eye_x = eye_m * mu;
                const RayleighLine line = {.begin = eye_x,
                                           .end = eye_x + 900e3,
                                           .excess = rayleigh_excess(air, 20e3) - eye_x * eye_x,
                                           .nu = nu,
                                           .sun_distance = eye_m * cos(sun * DEGREE) - eye_x * nu};
                const RayleighShadow shadow = rayleigh_shadow(line);
                for (double s = 1e3; s < 900e3; s += 31e3) {
                    const double x = line.begin + s;
                    const double height = x * nu + line.sun_distance;
                    const double axis2 = x * x + line.excess - height * height;
                    // Distance from the shadow's edge decides, not the last digit at it.
                    if (fabs(axis2) > 1e9 && fabs(height) > 1e3) {
                        assert_int_equal(x > shadow.from && x < shadow.to, axis2 < 0 && height < 0);
                    }
                }
            }
        }
    }
}

// Air alone, at 550 nm or so, over ground of albedo 0.1.
static struct medium make_air(double scattering_per_m)
{
    struct medium medium = empty_medium(0.1);
    medium.constituent_count = 1;
    medium.constituents[0] = make_constituent(scattering_per_m, 0, exponential_profile(8000),
                                              (struct phase){.kind = PHASE_RAYLEIGH});
    return medium;
}

struct solved {
    trl_context *ctx;
    struct optics *optics;
    struct solution solution;
    struct query *query;
};

static void solve_one_order(const struct medium *medium, struct solved *s)
{
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &s->ctx), TRL_OK);
    s->optics = mem_alloc(s->ctx, 1, sizeof *s->optics);
    assert_non_null(s->optics);
    optics_init(s->optics, medium, &WAVELENGTH_NM, 1);
    struct solver_settings settings = solver_settings_choose(s->optics, SOLVER_PRECISE);
    settings.orders = 1;
    assert_int_equal(solution_init(s->ctx, s->optics, &settings, &s->solution), TRL_OK);
    assert_int_equal(query_create(s->ctx, &s->solution, &s->query), TRL_OK);
}

static void finish(struct solved *s)
{
    query_destroy(s->ctx, &s->query);
    solution_finish(s->ctx, &s->solution);
    mem_free(s->ctx, s->optics);
    trl_context_destroy(&s->ctx);
}

static int compare_doubles(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

struct agreement {
    double median, most, worst; // relative differences; of 95 in 100 views
};

enum { MAX_VIEWS = 8192 };

// Views in all directions from five heights, of which the dimmest thousandth counts as dark.
static struct agreement compare(const struct solved *s, const struct rayleigh *model,
                                double sun_from_deg, double sun_to_deg)
{
    static const double altitudes_m[] = {0, 3e3, 30e3, 400e3, 2e7};
    static double errors[MAX_VIEWS];
    size_t count = 0;
    for (size_t a = 0; a < sizeof altitudes_m / sizeof *altitudes_m; a++) {
        for (double sun = sun_from_deg; sun <= sun_to_deg; sun += 11) {
            for (double view_deg = 0.3; view_deg < 180; view_deg += 4.7) {
                for (double azimuth = 0; azimuth <= 180; azimuth += 90) {
                    const struct query_view view =
                        query_view_make(s->optics->ground_radius_m + altitudes_m[a], sun * DEGREE,
                                        view_deg * DEGREE, azimuth * DEGREE);
                    lanes exact;
                    query_radiance(s->query, &view, &exact);
                    const double got = rayleigh_radiance(model, &view, WAVELENGTH_NM);
                    assert_true(isfinite(got) && got >= 0);
                    if ((double)exact[0] > 1e-5 && count < MAX_VIEWS) {
                        errors[count++] = fabs(got / (double)exact[0] - 1);
                    }
                }
            }
        }
    }
    assert_true(count > 300);
    qsort(errors, count, sizeof *errors, compare_doubles);
    const struct agreement result = {errors[count / 2], errors[count - 1 - count / 20],
                                     errors[count - 1]};
    printf("suns %g to %g degrees, %zu views, %u samples: median %.4f %%, 95 of 100 below %.3f %%, "
           "worst %.2f %%\n",
           sun_from_deg, sun_to_deg, count, (unsigned)model->desc.samples, 100 * result.median,
           100 * result.most, 100 * result.worst);
    return result;
}

static void radiances_are_the_solvers_of_one_order(void **state)
{
    (void)state;
    static struct rayleigh model;
    struct solved s;
    const struct medium medium = make_air(1.2e-5);
    solve_one_order(&medium, &s);
    trl_rayleigh_desc desc = trl_rayleigh_desc_default();
    // The solver is good to 1e-3, its star has an extent of 1e-4 rad like the model's.
    rayleigh_init(&model, &medium, &desc);
    struct agreement day = compare(&s, &model, 0, 83);
    assert_true(day.median < 2e-4 && day.most < 2e-3);
    desc.samples = 65;
    rayleigh_init(&model, &medium, &desc);
    day = compare(&s, &model, 0, 83);
    assert_true(day.median < 2e-4 && day.most < 1e-3 && day.worst < 1e-2);
    const struct agreement dusk = compare(&s, &model, 88, 100);
    assert_true(dusk.median < 1e-3 && dusk.most < 1e-2);
    desc.samples = 5;
    desc.optical_depth = TRL_RAYLEIGH_FIT;
    rayleigh_init(&model, &medium, &desc);
    day = compare(&s, &model, 0, 83);
    assert_true(day.median < 2e-3 && day.most < 1e-2);
    finish(&s);
}

static void higher_air_is_as_deep_straight_up(void **state)
{
    (void)state;
    static struct rayleigh model;
    const struct medium medium = make_air(1.2e-5);
    trl_rayleigh_desc desc = trl_rayleigh_desc_default();
    const struct query_view up = query_view_make(medium.ground_radius_m, 0, 0, 0);
    rayleigh_init(&model, &medium, &desc);
    const double real = rayleigh_radiance(&model, &up, WAVELENGTH_NM);
    desc.height_scale = 15; // as in the paper's Figure 7
    rayleigh_init(&model, &medium, &desc);
    assert_near(model.depth.air.height_m, 15 * 60e3, 1e-12);
    assert_near(rayleigh_radiance(&model, &up, WAVELENGTH_NM), real, 1e-3);
}

static void without_out_scattering_light_is_the_columns(void **state)
{
    (void)state;
    static struct rayleigh model;
    const struct medium medium = make_air(1.2e-5);
    trl_rayleigh_desc desc = trl_rayleigh_desc_default();
    desc.has_out_scattering = false;
    rayleigh_init(&model, &medium, &desc);
    const struct query_view up = query_view_make(medium.ground_radius_m, 60 * DEGREE, 0, 0);
    const double column = 8000 * (1 - exp(-60.0 / 8));
    const double phase = 3 / (16 * M_PI) * (1 + 0.25);
    assert_near(rayleigh_radiance(&model, &up, WAVELENGTH_NM), 1.2e-5 * column * phase, 1e-4);
    const struct query_view down = query_view_make(medium.ground_radius_m + 1, 0, M_PI, 0);
    assert_near(rayleigh_radiance(&model, &down, WAVELENGTH_NM), 0.1 / M_PI, 1e-3);
}

static void other_constituents_are_left_out(void **state)
{
    (void)state;
    struct medium medium = earth_like_medium(0);
    struct rayleigh_gas gas;
    rayleigh_gas_init(&gas, &medium);
    assert_true(gas.scale_height_m == 8000 && gas.share[0] == 1);
    assert_true(gas.share[1] == 0 && gas.share[2] == 0);
    assert_true(rayleigh_gas_at(&gas, WAVELENGTH_NM).scattering_per_m == 2.5e-5);
    // Two gases become one of the same column; uniform air has its mean height in its middle.
    medium.constituents[1] = make_constituent(1e-6, 0, (struct profile){.kind = PROFILE_UNIFORM},
                                              (struct phase){.kind = PHASE_RAYLEIGH});
    medium.constituents[0].scattering_per_m = constant_spectrum(0);
    rayleigh_gas_init(&gas, &medium);
    assert_near(gas.scale_height_m, 30e3, 1e-3);
    assert_near(rayleigh_gas_at(&gas, WAVELENGTH_NM).scattering_per_m * gas.scale_height_m *
                    (1 - exp(-60e3 / gas.scale_height_m)),
                1e-6 * 60e3, 1e-6);
    medium.constituent_count = 0;
    rayleigh_gas_init(&gas, &medium);
    assert_true(gas.scale_height_m > 0 && rayleigh_gas_at(&gas, 400).extinction_per_m == 0);
}

static void the_light_is_as_bright_as_the_stars(void **state)
{
    (void)state;
    static struct rayleigh model;
    struct rayleigh_star star;
    struct medium medium = make_air(1.2e-5);
    medium.star_irradiance = (struct spectrum){
        .kind = SPECTRUM_BLACKBODY, .blackbody = {.temperature_K = 5778, .total_W_m2 = 1361}};
    trl_rayleigh_desc desc = trl_rayleigh_desc_default();
    rayleigh_init(&model, &medium, &desc);
    rayleigh_star_init(&model, &star);
    double sum[3] = {0, 0, 0};
    for (uint32_t k = 0; k < desc.wavelengths; k++) {
        for (int i = 0; i < 3; i++) {
            sum[i] += star.rgb[k][i];
        }
    }
    assert_true(star.temperature_K == 5778);
    // A black body of 5800 K gives 93 lumens to the watt.
    assert_near(star.luminance, 1361 * 93, 0.02);
    assert_near(0.2126 * sum[0] + 0.7152 * sum[1] + 0.0722 * sum[2], 1, 1e-3);
    printf("colour of a black body of 5778 K: %.3f %.3f %.3f\n", sum[0], sum[1], sum[2]);
    // A little warmer than D65, which is the white of sRGB: red over green 1.12, blue 0.92 by the
    // observer's own functions. The single lobes are good to some hundredths.
    assert_near(sum[0] / sum[1], 1.12, 0.06);
    assert_near(sum[2] / sum[1], 0.92, 0.06);
    // The same of a table: the temperature is found.
    const trl_context_desc context = trl_context_desc_default();
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&context, &ctx), TRL_OK);
    double nm[50];
    double value[50];
    for (int i = 0; i < 50; i++) {
        nm[i] = 360 + 10 * i;
        value[i] = spectrum_at(&medium.star_irradiance, nm[i]);
    }
    assert_int_equal(spectrum_table_init(ctx, nm, value, 50, &medium.star_irradiance), TRL_OK);
    rayleigh_star_init(&model, &star);
    assert_near(star.temperature_K, 5778, 1e-3);
    spectrum_finish(ctx, &medium.star_irradiance);
    trl_context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_map_is_the_column),
        cmocka_unit_test(g_has_its_four_symmetries),
        cmocka_unit_test(the_fit_is_better_than_the_papers),
        cmocka_unit_test(fits_get_better_with_degree_and_heights),
        cmocka_unit_test(samples_are_dense_where_the_line_is_low),
        cmocka_unit_test(the_shadow_is_a_cylinder),
        cmocka_unit_test(radiances_are_the_solvers_of_one_order),
        cmocka_unit_test(higher_air_is_as_deep_straight_up),
        cmocka_unit_test(without_out_scattering_light_is_the_columns),
        cmocka_unit_test(other_constituents_are_left_out),
        cmocka_unit_test(the_light_is_as_bright_as_the_stars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
