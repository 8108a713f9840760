// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Clouds in traced light: against closed forms, against the same matter as air, and the bound that
// free paths are drawn by.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "cloud/traced.h"
#include "reference/path_tracer.h"
#include "shared/cloud.glsl"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

static const double RADIUS_M = 6371000;
static const double RAD = 3.14159265358979323846 / 180;

static int set_up(void **state)
{
    static char folder[] = "/tmp/terrella-traced-XXXXXX";
    assert_non_null(mkdtemp(folder));
    trl_context_desc desc = trl_context_desc_default();
    desc.cache_dir = folder;
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    *state = ctx;
    return 0;
}

static int tear_down(void **state)
{
    trl_context *ctx = *state;
    char path[64];
    snprintf(path, sizeof path, "%s/clouds.bin", ctx->cache_dir);
    unlink(path);
    rmdir(ctx->cache_dir);
    trl_context_destroy(&ctx);
    return 0;
}

static void check(double got, double expected, double error)
{
    if (!(fabs(got - expected) <= error)) {
        fail_msg("%.6g, expected %.6g +- %.2g", got, expected, error);
    }
}

// A deck as dense everywhere, whose bound is twice that and holds as far as it says.
struct deck {
    double base_m, top_m, extinction_per_m;
};

static double deck_extinction(const void *user, struct vec3 position_m)
{
    const struct deck *deck = user;
    const double altitude_m = vec3_length(position_m) - RADIUS_M;
    return altitude_m > deck->base_m && altitude_m < deck->top_m ? deck->extinction_per_m : 0;
}

static double deck_most(const void *user, struct vec3 position_m, double *reach_m)
{
    const struct deck *deck = user;
    const double altitude_m = vec3_length(position_m) - RADIUS_M;
    const double outside_m = fmax(deck->base_m - altitude_m, altitude_m - deck->top_m);
    *reach_m = fmax(outside_m, 100);
    return outside_m > 100 ? 0 : 2 * deck->extinction_per_m;
}

static struct reference_clouds make_clouds(const struct deck *deck)
{
    return (struct reference_clouds){.user = deck,
                                     .highest_m = deck->top_m,
                                     .albedo = 1,
                                     .forward_g = 0.85,
                                     .back_g = -0.4,
                                     .extinction_per_m = deck_extinction,
                                     .most_per_m = deck_most};
}

static struct spectrum constant(double value)
{
    return (struct spectrum){.kind = SPECTRUM_CONSTANT, .constant = value};
}

// Air that does next to nothing, to 20 km, over black ground, under a beam of 1.
static struct medium thin_medium(void)
{
    struct medium medium = {.ground_radius_m = RADIUS_M,
                            .top_radius_m = RADIUS_M + 20000,
                            .ground_albedo = constant(0),
                            .star_irradiance = constant(1),
                            .constituent_count = 1};
    medium.constituents[0] =
        (struct constituent){.scattering_per_m = constant(1e-12),
                             .absorption_per_m = constant(0),
                             .profile = {.kind = PROFILE_UNIFORM},
                             .phase = {.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.85}};
    return medium;
}

static void some_light_comes_through_as_exp_says(void **state)
{
    (void)state;
    enum { COUNT = 20000 };
    const struct deck deck = {1000, 2000, 2e-3};
    const struct reference_clouds clouds = make_clouds(&deck);
    const struct reference_clouds_way way = {{0, 0, RADIUS_M}, {0, 0, 1}, 20000};
    double passed = 0, clear = 0, depth = 0;
    for (int i = 0; i < COUNT; i++) {
        struct random_stream random = random_stream_for(3, 1, (uint64_t)i);
        passed += reference_clouds_passed(&clouds, &way, &random) / COUNT;
        const double met_m = reference_clouds_meet(&clouds, &way, &random);
        clear += isinf(met_m) ? 1.0 / COUNT : 0;
        depth += isinf(met_m) ? 0 : (met_m - 1000) * deck.extinction_per_m / COUNT;
    }
    // Four standard errors of a binomial; ratio tracking has less.
    const double error = 4 * sqrt(exp(-2) * (1 - exp(-2)) / COUNT);
    check(passed, exp(-2), error);
    check(clear, exp(-2), error);
    // The mean depth of collisions, with those beyond as 0; its spread is below 1.
    check(depth, 1 - 3 * exp(-2), 4.0 / sqrt(COUNT));
}

static void radiance(const trl_context *ctx, const struct medium *medium,
                     const struct reference_clouds *clouds, int max_order, double out[2][2])
{
    const trl_sky_query queries[2] = {{0, 30 * RAD, 40 * RAD, 1, 550},
                                      {15000, 30 * RAD, 130 * RAD, 2, 550}};
    const struct reference_desc desc = {
        .paths = 10000, .seed = 4, .max_order = max_order, .clouds = clouds};
    assert_int_equal(reference_sky_radiance(ctx, medium, queries, 2, &desc, out[0], out[1]),
                     TRL_OK);
}

// Parallel light through a slab of depth t, scattered once; mu of the star and of the view, both
// positive. Chandrasekhar 1960, Section 70: through and back.
static double once_through(double t, double mu_star, double mu_view)
{
    return mu_star / (mu_view - mu_star) * (exp(-t / mu_view) - exp(-t / mu_star));
}
static double once_back(double t, double mu_star, double mu_view)
{
    return mu_star / (mu_view + mu_star) * (1 - exp(-t * (1 / mu_view + 1 / mu_star)));
}

static void one_scattering_is_the_closed_form(void **state)
{
    const struct deck deck = {1000, 2000, 1e-3};
    const struct reference_clouds clouds = make_clouds(&deck);
    const struct medium medium = thin_medium();
    double got[2][2];
    radiance(*state, &medium, &clouds, 1, got);
    const double mu_star = cos(30 * RAD), mu_up = cos(40 * RAD), mu_down = cos(50 * RAD);
    const double nu_up = mu_up * mu_star + sin(40 * RAD) * sin(30 * RAD) * cos(1);
    const double nu_down = -mu_down * mu_star + sin(130 * RAD) * sin(30 * RAD) * cos(2);
    const double through = once_through(1, mu_star, mu_up) * reference_clouds_phase(&clouds, nu_up);
    const double back = once_back(1, mu_star, mu_down) * reference_clouds_phase(&clouds, nu_down);
    // The sphere bends the slab by some 1e-3.
    check(got[0][0], through, 4 * got[1][0] + 4e-3 * through);
    check(got[0][1], back, 4 * got[1][1] + 4e-3 * back);
    assert_true(got[1][0] < 0.02 * through && got[1][1] < 0.02 * back);
}

// The tracer of air is judged by other tests; the profile's edges are as steep as shells allow.
static void a_deck_is_as_bright_as_air_of_that_depth(void **state)
{
    const struct deck deck = {0, 20000, 2e-4};
    const struct reference_clouds clouds = make_clouds(&deck);
    struct medium medium = thin_medium();
    double cloud[2][2], air[2][2];
    radiance(*state, &medium, &clouds, 0, cloud);
    medium.constituents[0].scattering_per_m = constant(deck.extinction_per_m);
    radiance(*state, &medium, NULL, 0, air);
    for (int i = 0; i < 2; i++) {
        const double error = hypot(cloud[1][i], air[1][i]);
        check(cloud[0][i], air[0][i], 4 * error);
        assert_true(error < 0.1 * air[0][i]);
    }
}

// Nowhere within its reach is the extinction above the bound, in no kind of layer, and where there
// are no clouds the bound soon says so.
static void the_bound_holds(void **state)
{
    const struct cloud_desc desc = {
        .layer_count = 4,
        .seed = 1,
        .systems_m = 5e5,
        .layers = {{CLOUD_FOG, 0, 300, 0.6, 0.01, 5000, 0, 0, 0, CLOUD_EVERYWHERE},
                   {CLOUD_CUMULUS, 800, 2500, 0.5, 0.04, 8000, 0, 500, 0.9, CLOUD_EVERYWHERE},
                   {CLOUD_STRATUS, 3000, 3400, 0.7, 0.03, 16000, 5, 0, 0.9, {-0.5, 0.5, 0.3}},
                   {CLOUD_CIRRUS, 8000, 9000, 0.4, 1e-3, 40000, 0, 6000, 0.7, CLOUD_EVERYWHERE}},
        .cyclone_count = 2,
        .cyclones = {{0.3, 1, 3e6, 1e5}, {-0.5, -2, 2e6, 1e4}}};
    struct cloud_field field;
    assert_int_equal(cloud_field_init(*state, &desc, RADIUS_M, &field), TRL_OK);
    cloud_field_set_time(&field, 3600);
    const struct reference_clouds clouds = cloud_field_traced(&field);
    struct random_stream random = random_stream_for(1, 2, 3);
    int cloudy = 0, none = 0;
    for (int i = 0; i < 20000; i++) {
        const struct vec3 up = vec3_normalize((struct vec3){
            random_next(&random) - 0.5, random_next(&random) - 0.5, random_next(&random) - 0.5});
        const struct vec3 at = vec3_scale(up, RADIUS_M + 10000 * random_next(&random));
        double reach_m;
        const double most = clouds.most_per_m(clouds.user, at, &reach_m);
        const struct vec3 side = vec3_normalize((struct vec3){
            random_next(&random) - 0.5, random_next(&random) - 0.5, random_next(&random) - 0.5});
        const struct vec3 near = vec3_add(at, vec3_scale(side, reach_m * random_next(&random)));
        const double here = clouds.extinction_per_m(clouds.user, near);
        assert_true(reach_m > 0 && here <= most);
        cloudy += here > 0;
        none += most == 0;
    }
    assert_in_range(cloudy, 1000, 20000); // or nothing has been tested
    assert_in_range(none, 8000, 20000);
    cloud_field_finish(&field);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(some_light_comes_through_as_exp_says),
        cmocka_unit_test(one_scattering_is_the_closed_form),
        cmocka_unit_test(a_deck_is_as_bright_as_air_of_that_depth),
        cmocka_unit_test(the_bound_holds),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
