// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The sea's surface and water against closed forms and integrals of other kinds.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>

#include "ocean/sea.h"
#include "reference/sea.h"
#include "shared/sea.glsl"
#include "sky/sea.h"

static void assert_close(double got, double wanted, double tolerance)
{
    if (!(fabs(got - wanted) <= tolerance)) {
        fail_msg("%.8g, not %.8g within %g", got, wanted, tolerance);
    }
}

// Walsh 1926, in Duntley 1942, J. Opt. Soc. Am. 32, Eq. 11.
static double walsh(double n)
{
    const double n2 = n * n, n4 = n2 * n2;
    return 0.5 + (n - 1) * (3 * n + 1) / (6 * (n + 1) * (n + 1)) +
           n2 * (n2 - 1) * (n2 - 1) / pow(n2 + 1, 3) * log((n - 1) / (n + 1)) -
           2 * n2 * n * (n2 + 2 * n - 1) / ((n2 + 1) * (n4 - 1)) +
           8 * n4 * (n4 + 1) / ((n2 + 1) * (n4 - 1) * (n4 - 1)) * log(n);
}

static void a_smooth_surface_reflects_by_fresnel(void **state)
{
    (void)state;
    assert_close(fresnel_reflectance(1, 1.34), pow(0.34 / 2.34, 2), 1e-12);
    assert_close(fresnel_reflectance(0, 1.34), 1, 1e-7);
    // By Brewster's angle only what is polarised across comes back: cos^2(2 angle) of half.
    const double brewster = atan(1.34);
    assert_close(fresnel_reflectance(cos(brewster), 1.34), 0.5 * pow(cos(2 * brewster), 2), 1e-12);
    // From below, total beyond 48.3 degrees; and the same way back before.
    assert_close(fresnel_reflectance(0.6, 1 / 1.34), 1, 0);
    const double refracted = sqrt(1 - (1 - 0.5 * 0.5) / (1.34 * 1.34));
    assert_close(fresnel_reflectance(refracted, 1 / 1.34), fresnel_reflectance(0.5, 1.34), 1e-12);
    const double indices[] = {1.29, 1.34, 1.5, 2};
    for (size_t i = 0; i < 4; i++) {
        assert_close(sea_diffuse_reflectance(indices[i]), walsh(indices[i]), 1e-4);
    }
}

// Schlick 1994, Comput. Graph. Forum 13: as above, 1 grazing, and the fifth power between.
static double schlick(double cosine, double index)
{
    const double normal = pow((index - 1) / (index + 1), 2);
    return normal + (1 - normal) * pow(1 - cosine, 5);
}

// Of Lazanyi and Szirmay-Kalos 2005 (WSCG), whom Elek 2010 follows (Section 4.4): for clear media
// Schlick's less a term whose two numbers are fitted, here to the largest error for 1.333 and 1.27.
static double lazanyi(double cosine, double index)
{
    const bool water = index > 1.3;
    return schlick(cosine, index) -
           (water ? 1.88 : 1.98) * cosine * pow(1 - cosine, water ? 10.8 : 8.6);
}

// Largest error, and that of what the surface reflects of even light from all sides, in its parts.
struct approximation {
    double largest, diffuse;
};

static struct approximation approximate(double (*fast)(double, double), double index, bool inside)
{
    struct approximation error = {0};
    enum { STEPS = 20000 };
    double sum = 0, exact = 0;
    for (int i = 0; i < STEPS; i++) {
        const double mu = (i + 0.5) / STEPS;
        // From inside by the ray beyond, along which light comes back the same way; total without.
        const double beyond2 = 1 - (1 - mu * mu) * index * index;
        const double seen = inside ? sqrt(fmax(beyond2, 0)) : mu;
        const double value = inside && beyond2 <= 0 ? 1 : fast(seen, index);
        const double wanted = fresnel_reflectance(mu, inside ? 1 / index : index);
        error.largest = fmax(error.largest, fabs(value - wanted));
        sum += mu * value, exact += mu * wanted;
    }
    error.diffuse = sum / exact - 1;
    return error;
}

// The table of docs/physics.md, section 27: why no approximation is used.
static void fast_approximations_are_off_by_what_is_said(void **state)
{
    (void)state;
    static const struct {
        double (*fast)(double, double);
        double index, largest, outside, inside;
    } cases[] = {{schlick, 1.333, 0.0592, 0.0093, 0.0007},
                 {schlick, 1.27, 0.0786, 0.0865, 0.0073},
                 {lazanyi, 1.333, 0.0096, -0.045, -0.0035},
                 {lazanyi, 1.27, 0.0060, -0.033, -0.0028}};
    for (int i = 0; i < 4; i++) {
        for (int inside = 0; inside < 2; inside++) {
            const struct approximation got = approximate(cases[i].fast, cases[i].index, inside);
            printf("%s, %.3f from %s: %.4f at most, diffuse %+.2f %%\n",
                   cases[i].fast == schlick ? "Schlick" : "Lazanyi", cases[i].index,
                   inside ? "inside" : "outside", got.largest, 100 * got.diffuse);
            assert_close(got.largest, cases[i].largest, 2e-4);
            assert_close(got.diffuse, inside ? cases[i].inside : cases[i].outside, 6e-4);
        }
        // By the angle inside, as if nothing were total: no window at all.
        assert_true(cases[i].fast(0.65, cases[i].index) < 0.05);
        assert_close(fresnel_reflectance(0.6, 1 / cases[i].index), 1, 0);
    }
}

// Over slopes, by a rule that shares nothing with the code: polar, Simpson.
static void slopes_have_their_mean_square(void **state)
{
    (void)state;
    const double mss = 0.04;
    enum { STEPS = 4000 };
    double sum = 0, square = 0;
    for (int i = 0; i <= STEPS; i++) {
        const double s = 2.0 * i / STEPS;
        const double weight = (i == 0 || i == STEPS ? 1 : i % 2 ? 4 : 2) * 2.0 / STEPS / 3;
        const double p = sea_slope_density(1 / sqrt(1 + s * s), mss) * 2 * M_PI * s * weight;
        sum += p;
        square += p * s * s;
    }
    assert_close(sum, 1, 1e-6);
    assert_close(square, mss, 1e-6);
}

// Reflectance of the glint for a view, over all suns: what a furnace of light would see.
static double sum_glint(double view_mu, double mss, double index)
{
    enum { MUS = 1200, AZIMUTHS = 720 };
    double sum = 0;
    for (int i = 0; i < MUS; i++) {
        const double mu = (i + 0.5) / MUS, sine = sqrt(1 - mu * mu);
        const double view_sine = sqrt(1 - view_mu * view_mu);
        for (int j = 0; j < AZIMUTHS; j++) {
            const double azimuth = M_PI * (j + 0.5) / AZIMUTHS;
            const double x = sine * cos(azimuth) + view_sine, y = sine * sin(azimuth);
            const double z = mu + view_mu, length = sqrt(x * x + y * y + z * z);
            const double cosine = (view_sine * x + view_mu * z) / length;
            sum += sea_glint(z / length, cosine, view_mu, mu, mss, index);
        }
    }
    return 2 * M_PI * sum / MUS / AZIMUTHS; // both halves of the azimuths
}

static void glint_and_mirrored_sky_are_one_surface(void **state)
{
    (void)state;
    const double slopes[] = {0.005, 0.02, 0.04, 0.1};
    for (size_t k = 0; k < 4; k++) {
        const struct sky_sea sea = {.mean_square_slope = slopes[k], .index = 1.34};
        for (double mu = 0.2; mu < 1.01; mu += 0.2) {
            const double glint = sum_glint(mu, slopes[k], 1.34);
            double mirror_mu;
            const double mirrored = sea_surface_reflectance(&sea, mu, &mirror_mu);
            printf("mss %.3f mu %.1f: glint %.5f, mirrored %.5f\n", slopes[k], mu, glint, mirrored);
            // 160 facets stand for all.
            assert_close(mirrored / glint, 1, 0.006);
            assert_true(mirror_mu > mu - 0.2 && mirror_mu <= 1);
        }
    }
}

static void nothing_is_reflected_twice_from_a_white_surface(void **state)
{
    (void)state;
    // With an index beyond all others facets reflect everything.
    assert_close(sum_glint(1, 0.04, 1e6), 1, 0.005);
    assert_true(sum_glint(0.5, 0.04, 1e6) <= 1 + 0.005);
    assert_true(sum_glint(0.1, 0.04, 1e6) <= 1 + 0.005);
}

// The path tracer's surface is written apart, with Smith's function exact.
static void paths_meet_the_same_surface(void **state)
{
    (void)state;
    const struct reference_sea sea = {.mean_square_slope = 0.04, .index = 1.34};
    struct random_stream random = random_stream_for(1, 0, 0);
    for (double mu = 0.2; mu < 1.01; mu += 0.4) {
        const struct reference_facets place = {.up = {0, 0, 1}, .view = {sqrt(1 - mu * mu), 0, mu}};
        enum { DRAWS = 200000 };
        double sum = 0;
        for (int i = 0; i < DRAWS; i++) {
            const struct vec3 light = reference_sea_draw(&sea, &place, &random);
            const double value = reference_sea_value(&sea, &place, light)[0];
            sum += value / reference_sea_density(&sea, &place, light);
            const struct vec3 facet = vec3_normalize(vec3_add(light, place.view));
            const double glint =
                light.z > 0 ? sea_glint(facet.z, vec3_dot(facet, light), mu, light.z, 0.04, 1.34)
                            : 0;
            // The rational form is within 0.4 % of what Smith's has, of which there are two.
            // Cosines below 1e-4 are cut off in one of them.
            assert_close(value, light.z > 1e-3 ? glint : value, 0.01 * glint + 1e-12);
        }
        assert_close(sum / DRAWS, sum_glint(mu, 0.04, 1.34), 0.01 * sum / DRAWS);
    }
}

static void wind_makes_slopes_and_whitecaps(void **state)
{
    (void)state;
    struct ocean_waves waves = {.wind_m_s = 10, .mean_square_slope = -1, .whitecaps = 1};
    assert_close(sea_mean_square_slope(&waves), 0.0542, 1e-12);
    assert_close(sea_whitecap_share(&waves), 0.0098, 0.0002); // 1 % at 10 m/s
    waves.whitecaps = 0;
    waves.mean_square_slope = 0.01;
    assert_close(sea_mean_square_slope(&waves), 0.01, 0);
    assert_close(sea_whitecap_share(&waves), 0, 0);
}

static void depths_come_back_from_their_codes(void **state)
{
    (void)state;
    for (double depth = 0; depth < SEA_DEEP_M; depth += 7) {
        assert_close(sea_code_depth(sea_depth_code(depth)), depth, 1e-9);
    }
    assert_close(sea_depth_code(1e5), 0, 0);
}

// Of whole seas of waves with phases at random, near enough to see all, from afar, and between.
static void foam_covers_what_the_wind_makes_of_whitecaps(void **state)
{
    (void)state;
    enum { WAVES = 60, TRIALS = 40000 };
    static const double WINDS_M_S[3] = {7, 12, 20};
    for (int w = 0; w < 3; w++) {
        const struct ocean_waves waves = {.wind_m_s = WINDS_M_S[w], .whitecaps = 1};
        const double wanted = SEA_FOAM_DENSITY * sea_whitecap_share(&waves);
        const struct sea_foam_ramp ramp = sea_foam_find(sea_whitecap_share(&waves));
        for (int seen = 0; seen <= WAVES; seen += WAVES / 2) {
            uint64_t random = 88172645463325252u;
            double sum = 0;
            for (int i = 0; i < TRIALS; i++) {
                double press = 0;
                for (int k = 0; k < seen; k++) {
                    random ^= random << 13, random ^= random >> 7, random ^= random << 17;
                    press += sin((double)(random >> 11) * (2 * M_PI / 9007199254740992.0));
                }
                const double all = sqrt(WAVES / 2.0);
                const double lost = sqrt((WAVES - seen) / 2.0) / all;
                sum += sea_foam(press / all, lost, ramp.first, ramp.width);
            }
            printf("wind %g m/s, %d of %d waves seen: %.3g of the sea, wanted %.3g\n", WINDS_M_S[w],
                   seen, WAVES, sum / TRIALS, wanted);
            // 46 whitecaps in the rarest case (7 m/s), and sums of 60 sines have thinner tails.
            assert_true(fabs(sum / TRIALS / wanted - 1) < (seen == 0 ? 1e-6 : w == 0 ? 0.4 : 0.15));
        }
    }
    const struct ocean_waves calm = {.wind_m_s = 0, .whitecaps = 1};
    const struct sea_foam_ramp none = sea_foam_find(sea_whitecap_share(&calm));
    assert_true(sea_foam(5, 0.1, none.first, none.width) < 1e-12);
}

// Foam of the mean over the sea, by the depth over the height of waves in deep water.
static double find_surf(const struct sea_surf *surf, double depth_m)
{
    const double step = sea_surf_step(depth_m, surf->broken_m);
    const int i = step < SEA_SURF_STEPS ? (int)step : SEA_SURF_STEPS - 1;
    const struct sea_foam_ramp *r = &surf->ramps[i];
    return sea_foam(0, 1, r[0].first + (step - i) * (r[1].first - r[0].first),
                    r[0].width + (step - i) * (r[1].width - r[0].width));
}

// Of waves 1 m high half of the surf is whitecaps in 1.68 m (1 / 1.414 / 0.42) and less, twice as
// deep a sixteenth of that, and far out what the wind makes.
static void waves_break_where_water_is_shallow(void **state)
{
    (void)state;
    const struct ocean_waves waves = {.wind_m_s = 7, .whitecaps = 1};
    const struct sea_surf surf = sea_surf_find(&waves, 1);
    const double open = SEA_FOAM_DENSITY * sea_whitecap_share(&waves);
    const double dense = SEA_FOAM_DENSITY * 0.5;
    assert_close(surf.broken_m, 1.6836, 1e-4);
    const double parts[] = {0.1, 1, sqrt(2), 1.7, 2, 2.3},
                 wants[] = {1, 1, 0.25, 0.1197, 0.0625, 0.0357};
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        const double foam = find_surf(&surf, parts[i] * surf.broken_m);
        printf("%g of the depth: %.4f, wanted %.4f\n", parts[i], foam, wants[i] * dense);
        assert_close(foam / (wants[i] * dense), 1, 0.1);
    }
    assert_close(find_surf(&surf, 20), open, 1e-6);
    const struct ocean_waves bare = {.wind_m_s = 7, .whitecaps = 0}, calm = {.whitecaps = 1};
    const struct sea_surf none = sea_surf_find(&bare, 1), still = sea_surf_find(&calm, 0);
    assert_true(find_surf(&none, 0.5) < 1e-12 && find_surf(&still, 0.5) < 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_smooth_surface_reflects_by_fresnel),
        cmocka_unit_test(fast_approximations_are_off_by_what_is_said),
        cmocka_unit_test(slopes_have_their_mean_square),
        cmocka_unit_test(glint_and_mirrored_sky_are_one_surface),
        cmocka_unit_test(nothing_is_reflected_twice_from_a_white_surface),
        cmocka_unit_test(paths_meet_the_same_surface),
        cmocka_unit_test(wind_makes_slopes_and_whitecaps),
        cmocka_unit_test(foam_covers_what_the_wind_makes_of_whitecaps),
        cmocka_unit_test(waves_break_where_water_is_shallow),
        cmocka_unit_test(depths_come_back_from_their_codes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
