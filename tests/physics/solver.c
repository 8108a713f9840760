// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The source-moment solver and the integration along a view: closed forms, conservation, and the
// path tracer.
#include "reference_media.h"

#include "base/context.h"
#include "reference/path_tracer.h"
#include "scatter/query.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

static const double DEGREE = M_PI / 180;
static const double WAVELENGTH_NM = 550;

struct solved {
    trl_context *ctx;
    struct optics *optics;
    struct solution solution;
    struct query *query;
};

static void solve(const struct medium *medium, enum solver_quality quality, struct solved *s)
{
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &s->ctx), TRL_OK);
    s->optics = mem_alloc(s->ctx, 1, sizeof *s->optics);
    assert_non_null(s->optics);
    optics_init(s->optics, medium, &WAVELENGTH_NM, 1);
    const struct solver_settings settings = solver_settings_choose(s->optics, quality);
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

static double look(const struct solved *s, double altitude_m, double sun_deg, double view_deg,
                   double azimuth_deg)
{
    const struct query_view view =
        query_view_make(s->optics->ground_radius_m + altitude_m, sun_deg * DEGREE,
                        view_deg * DEGREE, azimuth_deg * DEGREE);
    lanes radiance;
    query_radiance(s->query, &view, &radiance);
    return (double)radiance[0];
}

static void assert_near(double got, double expected, double relative)
{
    if (!(fabs(got - expected) <= relative * fabs(expected))) {
        fail_msg("got %.7g, expected %.7g within %g %%", got, expected, 100 * relative);
    }
}

// Straight lines through a uniform shell: chords by Pythagoras.
static double chord(double radius_m, double mu, double sphere_m)
{
    const double pass2 = radius_m * radius_m * (1 - mu * mu);
    return sqrt(sphere_m * sphere_m - pass2) - radius_m * mu;
}

static void without_air_only_the_ground_is_seen(void **state)
{
    (void)state;
    const struct medium medium = empty_medium(0.3);
    struct solved s;
    solve(&medium, SOLVER_PRECISE, &s);
    // Lambert: albedo / pi times the cosine of the star's zenith angle, there is nothing else.
    assert_near(look(&s, 0, 40, 120, 30), 0.3 / M_PI * cos(40 * DEGREE),
                1e-4); // the table of direct light
    assert_near(look(&s, 1e6, 0, 180, 0), 0.3 / M_PI, 1e-4);
    assert_true(look(&s, 0, 40, 60, 30) == 0);
    assert_true(look(&s, 1e6, 40, 60, 30) == 0);
    finish(&s);
}

// Absorption alone: the light of the ground, dimmed on both ways (Beer's law).
static void absorbing_air_dims_the_ground(void **state)
{
    (void)state;
    struct medium medium = uniform_medium(0, 1e-5, 0.5);
    struct solved s;
    solve(&medium, SOLVER_PRECISE, &s);
    const double ground = medium.ground_radius_m;
    const double down_m = chord(ground, cos(50 * DEGREE), medium.top_radius_m);
    assert_near(look(&s, 200e3, 50, 180, 0),
                0.5 / M_PI * cos(50 * DEGREE) * exp(-1e-5 * (down_m + 60e3)), 3e-4);
    assert_true(look(&s, 0, 50, 30, 0) == 0);
    finish(&s);
}

// So thin that light scatters once: the integral of scattering along the chord is its length.
static void thin_air_scatters_once(void **state)
{
    (void)state;
    const double scattering = 1e-9;
    struct medium medium = uniform_medium(scattering, 0, 0);
    struct solved s;
    solve(&medium, SOLVER_PRECISE, &s);
    const double views_deg[] = {0, 45, 80, 89};
    for (int v = 0; v < 4; v++) {
        const double length_m =
            chord(medium.ground_radius_m, cos(views_deg[v] * DEGREE), medium.top_radius_m);
        // Isotropic: 1 / 4 pi. Attenuation and the second order are below 1e-3 of it: 9e5 m of
        // 1e-9 per m, twice.
        assert_near(look(&s, 0, 60, views_deg[v], 50), scattering * length_m / (4 * M_PI), 2e-3);
    }
    finish(&s);
}

// Light that the planet takes out of the direct beam, by quadrature over the beam's cross-section:
// all that
// meets the ground, and what is scattered out of the rays that pass above it.
static double intercepted(const struct medium *medium, double extinction_per_m)
{
    const double ground = medium->ground_radius_m;
    const double top = medium->top_radius_m;
    double sum = M_PI * ground * ground;
    const int steps = 20000;
    for (int k = 0; k < steps; k++) {
        const double pass = ground + (top - ground) * (k + 0.5) / steps;
        const double way = 2 * sqrt(top * top - pass * pass);
        sum += 2 * M_PI * pass * (1 - exp(-extinction_per_m * way)) * (top - ground) / steps;
    }
    return sum;
}

// A planet that absorbs nothing gives back all light that it intercepts. Outgoing light is summed
// over its
// whole top and all directions there: by symmetry over the star's zenith angle only.
static void conservative_planet_gives_back_all_light(void **state)
{
    (void)state;
    const double scattering = 1e-5; // vertical optical depth 0.6
    struct medium medium = uniform_medium(scattering, 0, 1);
    struct solved s;
    solve(&medium, SOLVER_PRECISE, &s);
    const double top = medium.top_radius_m;
    struct gauss suns;
    struct gauss views;
    gauss_init(&suns, 40);
    gauss_init(&views, 24);
    const double horizon = sqrt(1 - pow(medium.ground_radius_m / top, 2));
    double power = 0;
    for (int i = 0; i < suns.count; i++) {
        const double sun_mu = -0.2 + 1.2 * suns.node[i]; // below, no light leaves
        double flux = 0;
        for (int half = 0; half < 2; half++) { // views on the ground, and past it
            for (int q = 0; q < views.count; q++) {
                const double x = views.node[q] * views.node[q];
                const double down = half ? horizon * (1 - x) : horizon + (1 - horizon) * x;
                const double weight = (half ? horizon : 1 - horizon) * 2 * views.node[q];
                for (int p = 0; p < 12; p++) {
                    const double radiance =
                        look(&s, top - medium.ground_radius_m, acos(sun_mu) / DEGREE,
                             acos(-down) / DEGREE, (p + 0.5) * 15);
                    flux += radiance * down * weight * views.weight[q] * 2 * M_PI / 12;
                }
            }
        }
        power += flux * 2 * M_PI * top * top * 1.2 * suns.weight[i];
    }
    // Quadratures of 24 and 40 points over the terminator: half a percent.
    assert_near(power, intercepted(&medium, scattering), 0.005);
    finish(&s);
}

// Optical depth 3 over white ground, nothing absorbed: many orders, and no light is lost or made.
static void dense_white_air_converges(void **state)
{
    (void)state;
    struct medium medium = uniform_medium(3 / 60e3, 0, 1);
    struct solved s;
    solve(&medium, SOLVER_INTERACTIVE, &s);
    assert_true(s.solution.orders > 10);
    const double down = look(&s, 0, 30, 91, 0);
    const double up = look(&s, 0, 30, 0, 0);
    // The ground's radiance is its irradiance over pi; under a diffusing layer the sky is nearly as
    // bright in all directions.
    assert_near(down, up, 0.2);
    // A layer over white ground that absorbs nothing reflects all: seen from above about as bright
    // as a white wall (thick layers: 0.6 to 1.3 of it, Chandrasekhar 1960).
    const double from_space = look(&s, 100e3, 30, 180, 0);
    assert_true(from_space > 0.6 * cos(30 * DEGREE) / M_PI);
    assert_true(from_space < 1.3 * cos(30 * DEGREE) / M_PI);
    finish(&s);
}

static void finer_grids_change_little(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.2);
    struct solved coarse;
    solve(&medium, SOLVER_INTERACTIVE, &coarse);
    struct solved fine;
    solve(&medium, SOLVER_PRECISE, &fine);
    const double suns_deg[] = {0, 60, 88, 94};
    const double views_deg[] = {0, 70, 89, 95, 150};
    for (int i = 0; i < 4; i++) {
        for (int v = 0; v < 5; v++) {
            // What SOLVER_INTERACTIVE promises; twilight is less sure.
            assert_near(look(&coarse, 2000, suns_deg[i], views_deg[v], 40),
                        look(&fine, 2000, suns_deg[i], views_deg[v], 40),
                        suns_deg[i] < 90 ? 0.012 : 0.05);
        }
    }
    finish(&coarse);
    finish(&fine);
}

static void last_orders_close_the_series(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.8);
    struct solved s;
    solve(&medium, SOLVER_INTERACTIVE, &s);
    const double early = look(&s, 0, 50, 60, 90);
    struct solver_settings settings = solver_settings_choose(s.optics, SOLVER_INTERACTIVE);
    settings.tolerance = 1e-7;
    struct solution full;
    assert_int_equal(solution_init(s.ctx, s.optics, &settings, &full), TRL_OK);
    assert_true(full.orders > s.solution.orders);
    struct query *query = NULL;
    assert_int_equal(query_create(s.ctx, &full, &query), TRL_OK);
    const struct query_view view =
        query_view_make(s.optics->ground_radius_m, 50 * DEGREE, 60 * DEGREE, 90 * DEGREE);
    lanes radiance;
    query_radiance(query, &view, &radiance);
    assert_near(early, (double)radiance[0], settings.tolerance + 1e-3); // the promise: 0.1 %
    query_destroy(s.ctx, &query);
    solution_finish(s.ctx, &full);
    finish(&s);
}

struct view {
    double altitude_m, sun_deg, view_deg, azimuth_deg;
};

// Against brute force. The tolerance is the project's target for any value, 2 %, beyond four
// standard errors.
static void compare(const struct medium *medium, const struct view *views, int count,
                    uint64_t paths)
{
    struct solved s;
    solve(medium, SOLVER_PRECISE, &s);
    for (int v = 0; v < count; v++) {
        const trl_sky_query query = {views[v].altitude_m, views[v].sun_deg * DEGREE,
                                     views[v].view_deg * DEGREE, views[v].azimuth_deg * DEGREE,
                                     WAVELENGTH_NM};
        const struct reference_desc desc = {.paths = paths, .seed = 11};
        double expected;
        double error;
        assert_int_equal(reference_sky_radiance(s.ctx, medium, &query, 1, &desc, &expected, &error),
                         TRL_OK);
        const double got = look(&s, views[v].altitude_m, views[v].sun_deg, views[v].view_deg,
                                views[v].azimuth_deg);
        printf("  %6.0f m, sun %3.0f, view %5.1f, azimuth %3.0f: %+.2f %% (standard error %.2f)\n",
               views[v].altitude_m, views[v].sun_deg, views[v].view_deg, views[v].azimuth_deg,
               100 * (got / expected - 1), 100 * error / expected);
        // A reference that knows nothing would let anything pass.
        assert_true(error < 0.02 * expected);
        assert_true(fabs(got - expected) < 0.02 * expected + 4 * error);
    }
    finish(&s);
}

// A layer of cloud with an edge, from outside: at its limb light grazes the kink of its density.
static const double CLOUD_PER_M = 2e-3;
static const double CLOUD_MIDDLE_M = 40e3;
static const double CLOUD_HALF_M = 8e3;

static struct medium cloud_medium(void)
{
    struct medium medium = empty_medium(0.1);
    medium.constituent_count = 1;
    medium.constituents[0] = make_constituent(
        CLOUD_PER_M, 0,
        (struct profile){
            .kind = PROFILE_TENT, .centre_m = CLOUD_MIDDLE_M, .half_width_m = CLOUD_HALF_M},
        (struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.75});
    return medium;
}

// Optical depth of a straight way, by midpoints; it stops where nothing is left of the light.
static double cloud_depth(double radius_m, double mu, double end_m, int steps)
{
    const double ground_m = cloud_medium().ground_radius_m;
    double depth = 0;
    for (int k = 0; k < steps && depth < 30; k++) {
        const double way_m = end_m * (k + 0.5) / steps;
        const double height_m =
            sqrt(radius_m * radius_m + way_m * (way_m + 2 * radius_m * mu)) - ground_m;
        depth += CLOUD_PER_M * fmax(0, 1 - fabs(height_m - CLOUD_MIDDLE_M) / CLOUD_HALF_M) * end_m /
                 steps;
    }
    return depth;
}

// One scattering toward an eye in space, the line of sight in the plane of the star: brute force.
static double single_by_steps(double eye_m, double view_mu, double sun_mu, double nu)
{
    const struct medium medium = cloud_medium();
    const double top_m = medium.ground_radius_m + CLOUD_MIDDLE_M + CLOUD_HALF_M;
    const double pass_m = eye_m * sqrt(1 - view_mu * view_mu);
    const double half_m = sqrt(top_m * top_m - pass_m * pass_m);
    const double begin_m = -eye_m * view_mu - half_m;
    const double entry_mu = -half_m / top_m;
    const int steps = 8000;
    double depth = 0;
    double sum = 0;
    for (int k = 0; k < steps && depth < 20; k++) {
        const double way_m = 2 * half_m * (k + 0.5) / steps;
        const double radius_m = sqrt(top_m * top_m + way_m * (way_m + 2 * top_m * entry_mu));
        const double height_m = radius_m - medium.ground_radius_m;
        const double extinction =
            CLOUD_PER_M * fmax(0, 1 - fabs(height_m - CLOUD_MIDDLE_M) / CLOUD_HALF_M);
        const double mu = (eye_m * sun_mu + (begin_m + way_m) * nu) / radius_m;
        const double light_m =
            sqrt(top_m * top_m - radius_m * radius_m * (1 - mu * mu)) - radius_m * mu;
        const double step_depth = extinction * 2 * half_m / steps;
        sum += step_depth * exp(-depth - step_depth / 2 - cloud_depth(radius_m, mu, light_m, 4000));
        depth += step_depth;
    }
    return sum * phase_value(&medium.constituents[0].phase, nu);
}

// 1 %: what the table of direct light is off by at such an edge (0.7 % was measured).
static void limb_of_a_cloud_scatters_once(void **state)
{
    (void)state;
    const struct medium medium = cloud_medium();
    struct solved s = {0};
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &s.ctx), TRL_OK);
    s.optics = mem_alloc(s.ctx, 1, sizeof *s.optics);
    assert_non_null(s.optics);
    optics_init_for(OPTICS_WHOLE, &medium, &WAVELENGTH_NM, 1, s.optics);
    struct solver_settings settings = solver_settings_choose(s.optics, SOLVER_PRECISE);
    settings.orders = 1;
    assert_int_equal(solution_init(s.ctx, s.optics, &settings, &s.solution), TRL_OK);
    assert_int_equal(query_create(s.ctx, &s.solution, &s.query), TRL_OK);
    const double eye_m = medium.ground_radius_m + 400e3;
    for (int t = 0; t < 3; t++) { // tangent heights, m
        const double tangent_m = (const double[]){10e3, 40e3, 47e3}[t];
        const double view_rad = M_PI - asin((medium.ground_radius_m + tangent_m) / eye_m);
        const double sun_rad = 92 * DEGREE;
        const double expected =
            single_by_steps(eye_m, cos(view_rad), cos(sun_rad), cos(view_rad - sun_rad));
        assert_near(look(&s, 400e3, 92, view_rad / DEGREE, 0), expected, 0.01);
    }
    finish(&s);
}

static trl_result begin_backward_peak(trl_context *ctx, double extinction_per_m)
{
    struct medium medium = uniform_medium(extinction_per_m, 0, 0.3);
    medium.constituents[0].phase = (struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = -0.999};
    struct optics *optics = mem_alloc(ctx, 1, sizeof *optics);
    assert_non_null(optics);
    optics_init(optics, &medium, &WAVELENGTH_NM, 1);
    const struct solver_settings settings = solver_settings_choose(optics, SOLVER_INTERACTIVE);
    struct solution solution;
    const trl_result result = solution_init(ctx, optics, &settings, &solution);
    if (result == TRL_OK) {
        solution_finish(ctx, &solution);
    }
    mem_free(ctx, optics);
    return result;
}

// Also where light turns back twice only along the horizon; not where it hardly does anywhere.
static void sharp_backward_peaks_are_refused(void **state)
{
    (void)state;
    trl_context *ctx = NULL;
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    assert_int_equal(begin_backward_peak(ctx, 1 / 60e3), TRL_ERROR_INVALID);
    assert_int_equal(begin_backward_peak(ctx, 0.1 / 60e3), TRL_ERROR_INVALID);
    assert_int_equal(begin_backward_peak(ctx, 0.001 / 60e3), TRL_OK);
    trl_context_destroy(&ctx);
}

static void agrees_with_path_tracer_by_day(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.2);
    const struct view views[] = {{0, 30, 0, 0},         {0, 30, 75, 0},        {0, 60, 85, 90},
                                 {0, 75, 89, 180},      {12000, 60, 120, 90},  {60000, 60, 95, 0},
                                 {400000, 60, 150, 30}, {400000, 60, 109.7, 0}};
    compare(&medium, views, 8, 6000);
}

static void agrees_with_path_tracer_in_twilight(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.2);
    const struct view views[] = {{0, 92, 45, 0},     {0, 94, 70, 180},     {0, 97, 80, 0},
                                 {12000, 96, 88, 0}, {90000, 95, 99.2, 0}, {2000, 94, 150, 40}};
    compare(&medium, views, 6, 24000);
}

static void agrees_with_path_tracer_in_thick_dust(void **state)
{
    (void)state;
    struct medium medium = empty_medium(0.3);
    medium.constituent_count = 1;
    medium.constituents[0] =
        make_constituent(3e-4, 3e-5, exponential_profile(2000),
                         (struct phase){.kind = PHASE_HENYEY_GREENSTEIN, .g = 0.7});
    const struct view views[] = {
        {0, 40, 0, 0}, {0, 40, 60, 0}, {0, 70, 80, 90}, {300000, 50, 170, 0}};
    compare(&medium, views, 4, 24000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_air_only_the_ground_is_seen),
        cmocka_unit_test(absorbing_air_dims_the_ground),
        cmocka_unit_test(thin_air_scatters_once),
        cmocka_unit_test(conservative_planet_gives_back_all_light),
        cmocka_unit_test(dense_white_air_converges),
        cmocka_unit_test(finer_grids_change_little),
        cmocka_unit_test(last_orders_close_the_series),
        cmocka_unit_test(limb_of_a_cloud_scatters_once),
        cmocka_unit_test(sharp_backward_peaks_are_refused),
        cmocka_unit_test(agrees_with_path_tracer_by_day),
        cmocka_unit_test(agrees_with_path_tracer_in_twilight),
        cmocka_unit_test(agrees_with_path_tracer_in_thick_dust),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
