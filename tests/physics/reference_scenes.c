// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
//
// The path tracer where it is hard on itself: sharp phase functions near the star's disc, dense
// clouds, bodies before the star. And its standard errors against what they claim.
#include "context.h"

#include "reference/path_tracer.h"
#include "reference/tracer.h"
#include "reference_media.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

static const double pi = 3.14159265358979323846;
static const double max_z = 4;

static double rad(double degrees)
{
    return degrees * pi / 180;
}

static trl_sky_query make_query(double altitude_m, double sun_deg, double view_deg,
                                double azimuth_deg)
{
    return (trl_sky_query){altitude_m, rad(sun_deg), rad(view_deg), rad(azimuth_deg), 550};
}

static void check_z(const char *what, double got, double error, double expected, double max_error)
{
    const double z = (got - expected) / error;
    if (!(fabs(z) < max_z) || !(error <= max_error * fabs(expected))) {
        fail_msg("%s: %.6g +- %.2g, expected %.6g (z = %.1f)", what, got, error, expected, z);
    }
}

static struct medium hazy_medium(double g, double star_radius_deg)
{
    struct medium medium = uniform_medium(1e-6, 0, 0);
    medium.constituents[0].phase = (struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = g};
    medium.star_angular_radius_rad = rad(star_radius_deg);
    return medium;
}

// Mean of the phase function over the star's disc, seen at an angle from its centre.
static double mean_phase(const struct medium *medium, double from_centre_rad)
{
    enum { RINGS = 400, SECTORS = 400 };
    const double radius = medium->star_angular_radius_rad;
    double sum = 0;
    for (int i = 0; i < RINGS; ++i) {
        const double off = acos(1 - (1 - cos(radius)) * (i + 0.5) / RINGS);
        for (int k = 0; k < SECTORS; ++k) {
            const double turn = 2 * pi * (k + 0.5) / SECTORS;
            const double cosine =
                cos(from_centre_rad) * cos(off) + sin(from_centre_rad) * sin(off) * cos(turn);
            sum += phase_value(&medium->constituents[0].phase, cosine);
        }
    }
    return sum / (RINGS * SECTORS);
}

// One scattering in a thin slab: the disc is found by its own points and by the phase function's.
static void sharp_peaks_show_the_disc(void **state)
{
    static const double peaks[] = {0.99, 0.999, -0.999}, offsets_deg[] = {0.05, 0.2, 0.3, 2};
    for (int p = 0; p < 3; ++p) {
        const struct medium medium = hazy_medium(peaks[p], 0.27);
        const bool is_forward = peaks[p] > 0;
        for (int i = 0; i < 4; ++i) {
            // Forward peaks from the ground, backward ones from above, the star behind the eye.
            const trl_sky_query query = is_forward
                                            ? make_query(0, 30, 30 + offsets_deg[i], 0)
                                            : make_query(60e3, 30, 150 + offsets_deg[i], 180);
            const struct reference_desc desc = {.paths = 20000, .seed = 7, .max_order = 1};
            double radiance, error;
            assert_int_equal(
                reference_sky_radiance(*state, &medium, &query, 1, &desc, &radiance, &error),
                TRL_OK);
            // Of parallel light along one column; the slab is 0.06 deep, and both ways through it
            // are about as long.
            const double off = is_forward ? offsets_deg[i] : -offsets_deg[i];
            const double length = 60e3 / cos(rad(30 + off));
            const double depth = 1e-6 * length;
            const double from_centre = rad(is_forward ? offsets_deg[i] : 180 - offsets_deg[i]);
            const double once = is_forward ? depth * exp(-depth) : 0.5 * (1 - exp(-2 * depth));
            // Curvature and the change of the two ways with the angle: below 1 %.
            check_z("peak", radiance, hypot(error, 0.01 * radiance / max_z),
                    once * mean_phase(&medium, from_centre), 0.02);
        }
    }
}

// Mean and standard error of many paths.
struct answer {
    double mean, error;
};

static struct answer trace(const trl_context *ctx, const struct reference_world *world,
                           const trl_sky_query *query, int paths)
{
    struct reference_scratches scratches;
    assert_int_equal(reference_scratches_init(ctx, &world->air, &scratches), TRL_OK);
    const struct reference_tracer tracer = reference_tracer_make(world, &query->wavelength_nm, 1);
    const double sine = sin(query->view_zenith_rad);
    double sum = 0, squares = 0;
    for (int i = 0; i < paths; ++i) {
        struct reference_path path = {
            .random = random_stream_for(5, 0, (uint64_t)i),
            .position = {0, 0, world->scene.medium->ground_radius_m + query->altitude_m},
            .direction = {sine * cos(query->azimuth_rad), sine * sin(query->azimuth_rad),
                          cos(query->view_zenith_rad)},
            .star = {.direction = {sin(query->sun_zenith_rad), 0, cos(query->sun_zenith_rad)},
                     .cos_radius = cos(world->scene.medium->star_angular_radius_rad)}};
        assert_true(reference_enter(world, &path));
        reference_trace(&tracer, &scratches.of[0], &path);
        sum += path.radiance[0];
        squares += path.radiance[0] * path.radiance[0];
    }
    reference_scratches_finish(ctx, &scratches);
    const double mean = sum / paths;
    return (struct answer){mean, sqrt((squares / paths - mean * mean) / (paths - 1))};
}

// Directions drawn toward the star are a matter of noise, not of the mean.
static void directions_toward_star_change_noise_only(void **state)
{
    struct medium medium = earth_like_medium(0.3);
    medium.constituents[1].phase.g = 0.9;
    medium.star_angular_radius_rad = rad(0.27);
    const struct reference_scene scene = {.medium = &medium};
    static const double nm = 550;
    const struct reference_wavelengths wavelengths = {&nm, 1};
    struct reference_world world;
    assert_int_equal(reference_world_init(*state, &scene, &wavelengths, &world), TRL_OK);
    const trl_sky_query query = make_query(0, 40, 75, 0);
    assert_true(world.sharpness[1] > 0);
    const struct answer guided = trace(*state, &world, &query, 60000);
    world.sharpness[1] = 0;
    const struct answer plain = trace(*state, &world, &query, 60000);
    reference_world_finish(*state, &world);
    check_z("guided", guided.mean, hypot(guided.error, plain.error), plain.mean, 0.02);
    assert_true(guided.error < plain.error);
}

static struct medium cloudy_medium(double depth, double g)
{
    struct medium medium = empty_medium(0.3);
    medium.constituent_count = 2;
    medium.constituents[0] = make_constituent(1e-5, 0, exponential_profile(8000),
                                              (struct phase){.kind = PHASE_RAYLEIGH});
    static double altitude_m[] = {1999, 2000, 3000, 3001}, density[] = {0, 1, 1, 0};
    const struct profile slab = {
        .kind = PROFILE_TABLE, .altitude_m = altitude_m, .density = density, .count = 4};
    medium.constituents[1] = make_constituent(
        depth / 1001, 0, slab, (struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = g});
    medium.star_angular_radius_rad = rad(0.27);
    return medium;
}

// A dense conservative layer over black ground, seen from below: its diffuse transmittance falls
// with the similar depth (1 - g) times the depth as 1 / (that + 1.42 ...), van de Hulst 1980.
// Here: what comes down to the ground has the ratio of two depths.
static void deep_clouds_pass_light_as_diffusion_says(void **state)
{
    static const double depths[] = {20, 40};
    double light[2], error[2];
    for (int i = 0; i < 2; ++i) {
        struct medium medium = uniform_medium(depths[i] / 1e3, 0, 0);
        medium.ground_radius_m = 1e9; // plane
        medium.top_radius_m = 1e9 + 1e3;
        const trl_sky_query query = make_query(0, 40, 30, 50);
        const struct reference_desc desc = {.paths = 10000, .seed = 3};
        assert_int_equal(
            reference_sky_radiance(*state, &medium, &query, 1, &desc, &light[i], &error[i]),
            TRL_OK);
    }
    // Isotropic scattering: the asymptotic transmission of a thick conservative layer goes as
    // 1 / (depth + 2 q), q = 0.7104 (Milne's extrapolation length on both sides).
    const double expected = (depths[0] + 1.4209) / (depths[1] + 1.4209);
    const double ratio = light[1] / light[0];
    check_z("diffusion", ratio, ratio * hypot(error[0] / light[0], error[1] / light[1]), expected,
            0.06);
}

// Scores of many independent answers, against their common mean.
static void check_scores(const trl_context *ctx, const struct medium *medium,
                         const trl_sky_query *query, uint64_t paths)
{
    enum { SEEDS = 80 };
    double value[SEEDS], error[SEEDS], mean = 0;
    for (int i = 0; i < SEEDS; ++i) {
        const struct reference_desc desc = {.paths = paths, .seed = 1000 + (uint64_t)i};
        assert_int_equal(reference_sky_radiance(ctx, medium, query, 1, &desc, &value[i], &error[i]),
                         TRL_OK);
        mean += value[i] / SEEDS;
    }
    double squares = 0;
    int far = 0;
    for (int i = 0; i < SEEDS; ++i) {
        const double z = (value[i] - mean) / error[i];
        squares += z * z;
        far += fabs(z) > 3;
    }
    // The variance of 80 normal scores is 1 +- 0.16; skewed paths widen it a little.
    const double variance = squares / (SEEDS - 1);
    if (!(variance > 0.5 && variance < 1.6) || far > 3) {
        fail_msg("view %.0f deg: variance of scores %.2f, %d of %d beyond 3",
                 query->view_zenith_rad * 180 / pi, variance, far, SEEDS);
    }
}

static void standard_errors_do_not_lie(void **state)
{
    struct medium earth = earth_like_medium(0.3);
    earth.star_angular_radius_rad = rad(0.27);
    const trl_sky_query noon = make_query(0, 40, 60, 30), dusk = make_query(0, 96, 80, 0);
    check_scores(*state, &earth, &noon, 400);
    check_scores(*state, &earth, &dusk, 2000);
    earth.constituents[1].phase.g = 0.99;
    const trl_sky_query aureole = make_query(0, 40, 41, 0), beside = make_query(0, 40, 60, 0);
    check_scores(*state, &earth, &aureole, 400);
    check_scores(*state, &earth, &beside, 1000);
    const struct medium cloud = cloudy_medium(10, 0.85);
    const trl_sky_query below = make_query(0, 40, 20, 30), above = make_query(90e3, 40, 160, 30);
    check_scores(*state, &cloud, &below, 400);
    check_scores(*state, &cloud, &above, 500);
}

// What is left of a disc behind another of another size: two circular segments.
static double visible_part(double star_rad, double body_rad, double apart_rad)
{
    if (apart_rad >= star_rad + body_rad) {
        return 1;
    }
    if (apart_rad <= fabs(star_rad - body_rad)) {
        return body_rad >= star_rad ? 0 : 1 - pow(body_rad / star_rad, 2);
    }
    const double a = star_rad, b = body_rad, d = apart_rad;
    const double alpha = acos((d * d + a * a - b * b) / (2 * d * a));
    const double beta = acos((d * d + b * b - a * a) / (2 * d * b));
    const double lens = a * a * (alpha - sin(2 * alpha) / 2) + b * b * (beta - sin(2 * beta) / 2);
    return 1 - lens / (pi * a * a);
}

static void bodies_hide_their_part_of_the_star(void **state)
{
    const double sun_deg = 30, distance_m = 3.8e8;
    struct medium medium = empty_medium(0.5);
    medium.star_angular_radius_rad = rad(0.27);
    static const double bodies_deg[] = {0.25, 0.28, 0.2, 0.25, 0.3};
    static const double apart_deg[] = {0.3, 0.1, 0.0, 0.6, 0.0};
    for (int i = 0; i < 5; ++i) {
        const double away = rad(sun_deg + apart_deg[i]);
        // From the observer, not from the planet's centre.
        const struct reference_occluder body = {
            {distance_m * sin(away), 0, medium.ground_radius_m + distance_m * cos(away)},
            distance_m * sin(rad(bodies_deg[i]))};
        const struct reference_desc desc = {
            .paths = 20000, .seed = 13, .occluder_count = 1, .occluders = &body};
        const trl_sky_query query = make_query(0, sun_deg, 180, 0);
        double radiance, error;
        assert_int_equal(
            reference_sky_radiance(*state, &medium, &query, 1, &desc, &radiance, &error), TRL_OK);
        const double part = visible_part(rad(0.27), rad(bodies_deg[i]), rad(apart_deg[i]));
        const double expected = part * 0.5 / pi * cos(rad(sun_deg));
        // The incidence varies over the disc: 0.27 degrees times the tangent of 30.
        assert_true(fabs(radiance - expected) <= max_z * error + 0.003 * 0.5 / pi);
        assert_true(error < 0.01 * 0.5 / pi);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sharp_peaks_show_the_disc),
        cmocka_unit_test(directions_toward_star_change_noise_only),
        cmocka_unit_test(deep_clouds_pass_light_as_diffusion_says),
        cmocka_unit_test(standard_errors_do_not_lie),
        cmocka_unit_test(bodies_hide_their_part_of_the_star),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
