// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The sea as a sum of waves: against the laws that they are drawn from, and as a surface.
#include "waves.h"

#include "ocean/spectrum.h"

#include <stdio.h>

static double find_height(const struct wave_spectrum *s)
{
    double sum = 0;
    const double step = 1e-3;
    for (double x = log(0.3); x < log(1000); x += step) {
        const double omega = s->peak_per_s * exp(x + step / 2);
        sum += wave_spectrum_at(s, omega) * omega * step;
    }
    return 4 * sqrt(sum);
}

// Of alpha g^2 w^-5 exp(-beta (g / U w)^4) the integral is alpha U^4 / (4 beta g^2).
static void full_grown_sea_is_as_high_as_its_integral(void **state)
{
    const struct ocean_desc ocean = waves_describe(10, OCEAN_PIERSON_MOSKOWITZ, 60);
    const struct wave_spectrum s = wave_spectrum_make(&ocean.waves, GRAVITY);
    const double u = 10.26;
    const double wanted = 4 * sqrt(0.0081 / (4 * 0.74)) * u * u / GRAVITY;
    assert_true(fabs(find_height(&s) / wanted - 1) < 1e-3);
    struct waves waves;
    waves_make(*state, &ocean, &waves);
    // Left out are waves above 0.55 of the peak's length squared and those shorter than 0.2 m.
    assert_true(fabs(waves_significant_height_m(&waves) / wanted - 1) < 2e-3);
    waves_finish(&waves);
}

static double find_peak(const struct wave_spectrum *s)
{
    double best = 0, most = 0;
    for (double omega = 0.3 * s->peak_per_s; omega < 4 * s->peak_per_s; omega *= 1.0005) {
        const double here = wave_spectrum_at(s, omega);
        best = here > most ? omega : best;
        most = fmax(here, most);
    }
    return best;
}

// Hasselmann et al. 1973: variance = 1.6e-7 fetch U^2 / g and w_p = 22 (g^2 / U fetch)^(1/3), until
// both are those of Pierson and Moskowitz. gamma lies where theirs did, 3.3 in the mean of 1 to 7.
static void sea_grows_with_the_fetch_as_was_measured(void **state)
{
    for (double wind = 5; wind <= 20; wind *= 2) {
        const double grown_m = 4 * sqrt(0.0081 / (4 * 0.74)) * pow(1.026 * wind, 2) / GRAVITY;
        const double grown_per_s = pow(0.8 * 0.74, 0.25) * GRAVITY / (1.026 * wind);
        for (double fetch_m = 1e3; fetch_m < 4e6; fetch_m *= 3) {
            struct ocean_desc ocean = waves_describe(wind, OCEAN_JONSWAP, 60);
            ocean.waves.fetch_m = fetch_m;
            const struct wave_spectrum s = wave_spectrum_make(&ocean.waves, GRAVITY);
            const double height_m = 4 * sqrt(1.6e-7 * fetch_m * wind * wind / GRAVITY);
            const double peak_per_s = 22 * cbrt(GRAVITY * GRAVITY / (wind * fetch_m));
            assert_true(fabs(find_height(&s) / fmin(height_m, grown_m) - 1) < 2e-3);
            assert_true(fabs(find_peak(&s) / fmax(peak_per_s, grown_per_s) - 1) < 2e-3);
            assert_true(s.gamma >= 1 && s.gamma <= 5);
            struct waves waves;
            waves_make(*state, &ocean, &waves);
            // Without what is below 0.2 m, or is left out for Cox and Munk's slopes.
            const double drawn = waves_significant_height_m(&waves) / find_height(&s);
            assert_true(drawn < 1.002 && drawn > (fetch_m < 1e4 ? 0.96 : 0.99));
            waves_finish(&waves);
        }
    }
}

static void a_sea_with_fetch_enough_is_full_grown(void **state)
{
    (void)state;
    struct ocean_desc ocean = waves_describe(9, OCEAN_JONSWAP, 60);
    ocean.waves.fetch_m = 1e7;
    const struct wave_spectrum young = wave_spectrum_make(&ocean.waves, GRAVITY);
    ocean.waves.spectrum = OCEAN_PIERSON_MOSKOWITZ;
    const struct wave_spectrum grown = wave_spectrum_make(&ocean.waves, GRAVITY);
    for (double omega = 0.3; omega < 10; omega *= 1.1) {
        const double off = wave_spectrum_at(&young, omega) / wave_spectrum_at(&grown, omega) - 1;
        assert_true(fabs(off) < 1e-3);
    }
}

static void waves_run_as_in_deep_water(void **state)
{
    struct ocean_desc ocean = waves_describe(8, OCEAN_JONSWAP, 60);
    ocean.gravity_m_s2 = 1.35; // another planet's
    struct waves waves;
    waves_make(*state, &ocean, &waves);
    assert_true(waves.count > 30);
    for (uint32_t i = 0; i < waves.count; i++) {
        const struct wave_component *c = &waves.components[i];
        assert_true(fabs(c->omega_per_s * c->omega_per_s / (1.35 * c->wavenumber_per_m) - 1) <
                    1e-12);
        assert_true(i == 0 || c->wavenumber_per_m > waves.components[i - 1].wavenumber_per_m);
    }
    waves_finish(&waves);
}

// Down to where capillary waves begin (k = 370 per m) the spectrum has 1.0 of the slopes that Cox
// and Munk saw at 5 m/s and 0.5 at 12: its tail does not know the wind. What is missing, or too
// much, is made good: the sum is theirs.
static void slopes_are_near_those_of_cox_and_munk(void **state)
{
    for (double wind = 5; wind <= 12; wind += 3.5) {
        const struct ocean_desc ocean = waves_describe(wind, OCEAN_JONSWAP, 60);
        const struct wave_spectrum s = wave_spectrum_make(&ocean.waves, GRAVITY);
        const double seen = 0.003 + 0.00512 * wind, step = 1e-3;
        double sum = 0;
        for (double x = log(0.3 * s.peak_per_s); x < log(sqrt(GRAVITY * 370)); x += step) {
            const double omega = exp(x + step / 2), k = omega * omega / GRAVITY;
            sum += wave_spectrum_at(&s, omega) * k * k * omega * step;
        }
        assert_true(sum > 0.5 * seen && sum < 1.1 * seen);
        struct waves waves;
        waves_make(*state, &ocean, &waves);
        double square = 0;
        for (uint32_t i = 0; i < waves.count; i++) {
            const double slope =
                waves.components[i].amplitude_m * waves.components[i].wavenumber_per_m;
            square += slope * slope / 2;
        }
        assert_true(fabs(square + waves.rest_square - seen) < 1e-12);
        assert_true(waves.rest_square >= 0);
        waves_finish(&waves);
    }
}

// Fewer, and glints near the eye show each of them: bumps in rows.
static void every_octave_of_short_waves_has_some(void **state)
{
    const struct ocean_desc ocean = waves_describe(7, OCEAN_JONSWAP, 60);
    struct waves waves;
    waves_make(*state, &ocean, &waves);
    for (double length_m = 0.13; length_m < 3; length_m *= 2) {
        int count = 0;
        for (uint32_t i = 0; i < waves.count; i++) {
            const double at_m = 2 * M_PI / waves.components[i].wavenumber_per_m;
            count += at_m >= length_m && at_m < 2 * length_m;
        }
        assert_true(count >= 5);
    }
    waves_finish(&waves);
}

// A wave that runs across a pixel 100 m long ends there, since it stands for others beside it; one
// along a short pixel does not know.
static void no_crest_is_longer_than_its_courses_allow(void **state)
{
    (void)state;
    assert_true(gerstner_weight(0, 2 * 0.1) > 0.99);
    assert_true(gerstner_weight_of(0, 2 * 0.1, 2, 100 * 100) < 0.01);
    assert_true(fabs(gerstner_weight_of(0.3, 0, 2, 0.15 * 0.15) / gerstner_weight(0.3, 0) - 1) <
                1e-6);
}

// All waves at a place, under a window.
static GerstnerSum sum_at(const struct waves_view *view, double x, double y, double side_x_m,
                          double side_y_m)
{
    const GerstnerPlace p = gerstner_place(x, y, RADIUS_M);
    GerstnerSum sum = gerstner_level();
    for (uint32_t i = 0; i < view->count; i++) {
        const GerstnerWave w = waves_view_get(view, i);
        const GerstnerTurn t = gerstner_turn(w, p);
        const GerstnerRipple r = gerstner_ripple(w, p, RADIUS_M, gerstner_small_angle(t));
        const double k = w.wavenumber;
        sum = gerstner_add(sum, w, r,
                           gerstner_weight_of(k * side_x_m * r.dx, k * side_y_m * r.dy, k,
                                              side_x_m * side_x_m + side_y_m * side_y_m));
    }
    return sum;
}

// Number i of places that cover a square evenly, by powers of the inverse of the root of x^3 = x +
// 1.
static double place_x(int i, double side_m)
{
    return side_m * (fmod(i * 0.7548776662466927, 1) - 0.5);
}

static double place_y(int i, double side_m)
{
    return side_m * (fmod(i * 0.5698402909980532, 1) - 0.5);
}

// Under any window the slopes of the surface that is shown, crests pressed together as it has them
// (in the mean over 200 000 m^2 as seen from above), and those that are told are those that Cox and
// Munk saw.
static void windows_keep_the_mean_square_slope(void **state)
{
    struct waves_view *view = test_malloc(sizeof *view);
    for (double wind = 5; wind <= 15; wind += 5) {
        const struct ocean_desc ocean = waves_describe(wind, OCEAN_JONSWAP, 60);
        const struct vec3 eye = {RADIUS_M, 0.3 * RADIUS_M, 0.2 * RADIUS_M};
        struct waves waves;
        waves_make(*state, &ocean, &waves);
        waves_view_make(&waves, eye, 5, view);
        const double total = 0.003 + 0.00512 * wind;
        for (double side_m = 0; side_m < 20; side_m = 2 * side_m + 0.3) {
            double shown = 0, told = 0, area = 0;
            enum { PLACES = 3000 };
            for (int i = 0; i < PLACES; i++) {
                const GerstnerSum sum =
                    sum_at(view, place_x(i, 450), place_y(i, 450), side_m, 0.3 * side_m);
                const GerstnerNormal n = gerstner_normal(sum);
                const double part = gerstner_jacobian(sum, 1);
                shown += part * (n.x * n.x + n.y * n.y) / (n.z * n.z);
                told += (sum.lost_square + waves.rest_square) / PLACES;
                area += part;
            }
            // A mean of 3000 squares.
            assert_true(fabs((shown / area + told) / total - 1) < 0.05);
            assert_true(side_m > 0 ? told > waves.rest_square
                                   : shown / area > 0.5 * waves.mean_square_slope);
        }
        waves_finish(&waves);
    }
    test_free(view);
}

// All waves with their crests at the anchor, where they press together the most that they can.
static double find_least_jacobian(const struct waves_view *view)
{
    const GerstnerPlace p = gerstner_place(0, 0, RADIUS_M);
    GerstnerSum sum = gerstner_level();
    for (uint32_t i = 0; i < view->count; i++) {
        GerstnerWave w = waves_view_get(view, i);
        w.phase = SHARED_PI / 2;
        sum = gerstner_add(sum, w, gerstner_ripple(w, p, RADIUS_M, 0), 1);
    }
    // Also along one course no crest is pressed to nothing.
    assert_true(1 - sum.xx > 0 && 1 - sum.yy > 0);
    return gerstner_jacobian(sum, 1);
}

// Loops never occur, in the middle of a cell (the first place) or where cells border; and what can
// be had is taken: all of Q where few waves leave room for it.
static void no_meeting_of_crests_makes_a_loop(void **state)
{
    const uint32_t counts[] = {1, 20, 60, 250, 1000};
    struct waves_view *view = test_malloc(sizeof *view);
    for (double wind = 4; wind <= 40; wind *= 3) {
        for (int c = 0; c < 5; c++) {
            const struct ocean_desc ocean = waves_describe(wind, OCEAN_JONSWAP, counts[c]);
            struct waves waves;
            waves_make(*state, &ocean, &waves);
            for (int i = 0; i < 12; i++) {
                waves_view_make(&waves, (struct vec3){cos(i), sin(i), 0.02 + 0.1 * i}, 0, view);
                const double least = find_least_jacobian(view);
                assert_true(least > 0);
                const double last = waves_view_get(view, view->count - 1).steepness;
                assert_true(last == 1 || least < 0.9); // all of it, or no more room
                assert_true(waves_view_get(view, 0).steepness == 1);
            }
            assert_true(counts[c] > 20 || waves_view_get(view, view->count - 1).steepness == 1);
            waves_finish(&waves);
        }
    }
    test_free(view);
}

// How the surface bends upward, by the slopes of its normals over 5 cm: the Laplacian of the height
// over the place as it was moved.
static double find_bend(const struct waves_view *view, double x, double y, double side_m,
                        double *part)
{
    const double step = 0.05;
    double slope[2][2][2]; // x or y of the slope; along x or y; behind or ahead
    for (int axis = 0; axis < 2; axis++) {
        for (int end = 0; end < 2; end++) {
            const double by = end ? step : -step;
            const GerstnerNormal n = gerstner_normal(
                sum_at(view, x + (axis ? 0 : by), y + (axis ? by : 0), side_m, side_m));
            slope[0][axis][end] = -n.x / n.z;
            slope[1][axis][end] = -n.y / n.z;
        }
    }
    double d[2][2];
    for (int i = 0; i < 2; i++) {
        for (int axis = 0; axis < 2; axis++) {
            d[i][axis] = (slope[i][axis][1] - slope[i][axis][0]) / (2 * step);
        }
    }
    const GerstnerSum s = sum_at(view, x, y, side_m, side_m);
    *part = gerstner_jacobian(s, 1);
    return (d[0][0] * (1 - s.yy) + d[0][1] * s.xy + d[1][0] * s.xy + d[1][1] * (1 - s.xx)) / *part;
}

// The skewness of how crests bend against troughs: 0 for a sum of sines.
static double find_sharpness(const struct waves_view *view, double side_m)
{
    enum { PLACES = 4000 };
    double area = 0, sums[3] = {0};
    for (int i = 0; i < PLACES; i++) {
        double part = 0;
        const double bend = -find_bend(view, place_x(i, 2000), place_y(i, 2000), side_m, &part);
        area += part;
        for (int power = 0; power < 3; power++) {
            sums[power] += part * pow(bend, power + 1);
        }
    }
    const double mean = sums[0] / area, square = sums[1] / area - mean * mean;
    return (sums[2] / area - 3 * mean * square - mean * mean * mean) / pow(square, 1.5);
}

// With one Q for all 60 waves, as much as excludes loops, it is 0.22 to 0.30.
static void crests_are_sharper_than_troughs(void **state)
{
    struct waves_view *view = test_malloc(sizeof *view);
    for (double wind = 7; wind <= 20; wind += 6.5) {
        const struct ocean_desc ocean = waves_describe(wind, OCEAN_JONSWAP, 60);
        struct waves waves;
        waves_make(*state, &ocean, &waves);
        waves_view_make(&waves, (struct vec3){1, 0.02, 0.02}, 0, view);
        assert_true(find_sharpness(view, 2) > 0.33);
        for (uint32_t i = 0; i < view->count; i++) {
            view->texels[i / WAVES_LANES][6][i % WAVES_LANES] = 0;
        }
        assert_true(fabs(find_sharpness(view, 2)) < 0.15);
        waves_finish(&waves);
    }
    test_free(view);
}

// What floats is at the anchor, though waves have moved it there from metres away.
static void what_stands_below_the_anchor_is_found(void **state)
{
    const struct ocean_desc ocean = waves_describe(25, OCEAN_JONSWAP, 60);
    struct waves waves;
    struct waves_view *view = test_malloc(sizeof *view);
    waves_make(*state, &ocean, &waves);
    double farthest_m = 0;
    for (int i = 0; i < 300; i++) {
        waves_view_make(&waves, (struct vec3){cos(i), sin(i), 0.3}, 11.0 * i, view);
        const struct waves_stand stand = waves_stand_find(view, RADIUS_M, 0, 1);
        const GerstnerSum sum = sum_at(view, stand.east_m, stand.north_m, 0, 0);
        assert_true(hypot(stand.east_m + sum.x, stand.north_m + sum.y) < 1e-3);
        assert_true(fabs(stand.height_m - sum.z) < 1e-3);
        farthest_m = fmax(farthest_m, hypot(sum.x, sum.y));
    }
    assert_true(farthest_m > 3);
    test_free(view);
    waves_finish(&waves);
}

static void seed_tells_the_sea_and_calm_has_none(void **state)
{
    struct ocean_desc ocean = waves_describe(8, OCEAN_JONSWAP, 30);
    struct waves a, b;
    waves_make(*state, &ocean, &a);
    ocean.waves.seed = 2;
    waves_make(*state, &ocean, &b);
    assert_true(a.components[5].bearing_rad != b.components[5].bearing_rad);
    waves_finish(&b);
    ocean.waves.wind_m_s = 0;
    waves_make(*state, &ocean, &b);
    assert_int_equal(b.count, 0);
    assert_true(fabs(b.rest_square - 0.003) < 1e-12);
    waves_finish(&a);
    waves_finish(&b);
}

// Within a shorter fetch than the scene's the same waves have the height that such a sea has, none
// much longer than its own, and slopes no steeper than those of the whole sea.
static void waves_of_a_lake_are_those_of_its_fetch(void **state)
{
    struct waves waves;
    struct waves_view *view = test_malloc(sizeof *view);
    const struct ocean_desc ocean = waves_describe(9, OCEAN_JONSWAP, 60);
    waves_make(*state, &ocean, &waves);
    for (double fetch_m = 1000; fetch_m < 1e5; fetch_m *= 3) {
        const double variance_m2 = 1.6e-7 * fetch_m * 9 * 9 / GRAVITY;
        const double peak_per_s = 22 * cbrt(GRAVITY * GRAVITY / (9 * fetch_m));
        const struct waves_eye eye = {{RADIUS_M, 0, 0}, 0, fetch_m};
        waves_view_make_within(&waves, &eye, view);
        double variance = 0, slopes = 0, longer = 0;
        for (uint32_t i = 0; i < view->count; i++) {
            const GerstnerWave w = waves_view_get(view, i);
            const double square = 0.5 * w.amplitude * w.amplitude;
            variance += square;
            slopes += square * w.wavenumber * w.wavenumber;
            longer += sqrt(GRAVITY * w.wavenumber) < 0.55 * peak_per_s ? square : 0;
        }
        printf("%6.0f m: height %.3f of the law's, longer waves %.1e, slopes %.2f of all\n",
               fetch_m, sqrt(variance / variance_m2), longer / variance,
               slopes / waves.mean_square_slope);
        assert_true(fabs(sqrt(variance / variance_m2) - 1) < 0.05);
        assert_true(fabs(view->height_part * waves_significant_height_m(&waves) / 4 -
                         sqrt(variance)) < 1e-3 * sqrt(variance));
        assert_true(longer < 1e-4 * variance);
        assert_true(slopes < 1.3 * waves.mean_square_slope);
    }
    test_free(view);
    waves_finish(&waves);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_of_a_lake_are_those_of_its_fetch),
        cmocka_unit_test(full_grown_sea_is_as_high_as_its_integral),
        cmocka_unit_test(sea_grows_with_the_fetch_as_was_measured),
        cmocka_unit_test(a_sea_with_fetch_enough_is_full_grown),
        cmocka_unit_test(waves_run_as_in_deep_water),
        cmocka_unit_test(slopes_are_near_those_of_cox_and_munk),
        cmocka_unit_test(every_octave_of_short_waves_has_some),
        cmocka_unit_test(no_crest_is_longer_than_its_courses_allow),
        cmocka_unit_test(windows_keep_the_mean_square_slope),
        cmocka_unit_test(no_meeting_of_crests_makes_a_loop),
        cmocka_unit_test(crests_are_sharper_than_troughs),
        cmocka_unit_test(what_stands_below_the_anchor_is_found),
        cmocka_unit_test(seed_tells_the_sea_and_calm_has_none),
    };
    return cmocka_run_group_tests(tests, waves_set_up, waves_tear_down);
}
