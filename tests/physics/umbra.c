// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Scattered light around the shadow of a moon: what must be so whatever the numbers are.
#include "reference_media.h"

#include "base/context.h"
#include "scatter/umbra.h"
#include "shared/eclipse.glsl"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

struct solved {
    trl_context *ctx;
    struct optics optics;
    struct bands bands;
    struct umbra_kernel kernel;
    struct umbra_map map;
};

static const double NM[BAND_COUNT] = {450, 500, 550, 600};

static struct solved *solve(const struct medium *medium, const struct umbra_shadow *shadow)
{
    static struct solved s;
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, &s.ctx), TRL_OK);
    optics_init(&s.optics, medium, NM, BAND_COUNT);
    for (int k = 0; k < BAND_COUNT; k++) {
        s.bands.lane[k] = k;
        s.bands.nm[k] = NM[k];
        for (int c = 0; c < 3; c++) {
            s.bands.xyz_from_lanes[c][k] = 1;
        }
    }
    umbra_kernel_init(&s.optics, s.bands.lane, &s.kernel);
    if (shadow) {
        assert_int_equal(umbra_map_make(s.ctx, &s.kernel, shadow, &s.bands, &s.map), TRL_OK);
    }
    trl_context_destroy(&s.ctx);
    return &s;
}

static double place_m(const struct solved *s, int u, int v)
{
    const double x = fabs((2 * u + 1.0) / UMBRA_US - 1);
    const double y = (v + 0.5) / UMBRA_VS;
    return s->map.scale_m * hypot(x / (1 - x), y / (1 - y));
}

// What of the light at a node is left, Y and on the ground in the third band.
static double air_left(const struct solved *s, const struct umbra_shadow *shadow, int altitude,
                       int p)
{
    return (double)s->map.air[altitude * UMBRA_PLACES + p][1] +
           eclipse_shadow(place_m(s, p % UMBRA_US, p / UMBRA_US), shadow->along_m, shadow->radius_m,
                          shadow->star_rad);
}

static double ground_left(const struct solved *s, const struct umbra_shadow *shadow, int p)
{
    return (double)s->map.ground[p][2] + eclipse_shadow(place_m(s, p % UMBRA_US, p / UMBRA_US),
                                                        shadow->along_m, shadow->radius_m,
                                                        shadow->star_rad);
}

static const struct umbra_shadow OF_MOON = {
    .radius_m = 1737400, .along_m = 3.57e8, .star_rad = 0.004653, .star_mu = 0.6};

static void nothing_is_missing_without_a_shadow(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.3);
    struct umbra_shadow shadow = OF_MOON;
    shadow.radius_m = 10; // covers 4e-11 of the star
    const struct solved *s = solve(&medium, &shadow);
    for (int p = 0; p < UMBRA_PLACES; p++) {
        for (int a = 0; a < UMBRA_ALTITUDES; a++) {
            assert_true(fabs(air_left(s, &shadow, a, p) - 1) < 1e-4);
        }
        assert_true(fabs(ground_left(s, &shadow, p) - 1) < 1e-4);
    }
}

static void nothing_is_left_where_all_is_dark(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.3);
    const struct umbra_shadow shadow = {
        .radius_m = 1e8, .along_m = 3e8, .star_rad = 0.004653, .star_mu = 0.6};
    const struct solved *s = solve(&medium, &shadow);
    const int middle = UMBRA_US / 2;
    assert_true(ground_left(s, &shadow, middle) == 0);
    assert_true(air_left(s, &shadow, 3, middle) == 0);
}

// In the umbra light comes from beyond it: more where more of it is in sight, and where it is
// nearer. Far from it everything is as the star alone says.
static void the_umbra_is_lit_from_beyond(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.3);
    const struct solved *s = solve(&medium, &OF_MOON);
    const int middle = UMBRA_US / 2; // some 9 km from the axis
    const int edge = middle + 2;     // 50 km; the umbra is 76 km wide
    assert_true(ground_left(s, &OF_MOON, middle) > 1e-4);
    assert_true(ground_left(s, &OF_MOON, middle) < 0.01);
    assert_true(ground_left(s, &OF_MOON, edge) > ground_left(s, &OF_MOON, middle));
    for (int a = 2; a < UMBRA_ALTITUDES; a++) {
        assert_true(air_left(s, &OF_MOON, a, middle) > air_left(s, &OF_MOON, a - 1, middle));
    }
    for (int p = 0; p < UMBRA_PLACES; p++) {
        const double away_m = place_m(s, p % UMBRA_US, p / UMBRA_US);
        const double left = ground_left(s, &OF_MOON, p);
        assert_true(left >= 0 && left <= 1);
        // There the star comes out evenly, and the mean over what is around is what is there.
        if (away_m > 1e6) {
            assert_true(fabs((double)s->map.ground[p][2]) < 0.02);
        }
    }
}

// Each further scattering brings light from farther away.
static void orders_light_the_umbra(void **state)
{
    (void)state;
    const struct medium medium = earth_like_medium(0.3);
    double before = 0;
    for (int orders = 2; orders <= 4; orders++) {
        struct umbra_shadow shadow = OF_MOON;
        shadow.orders = orders;
        const double left = ground_left(solve(&medium, &shadow), &shadow, UMBRA_US / 2);
        assert_true(left > before);
        before = left;
    }
    assert_true(ground_left(solve(&medium, &OF_MOON), &OF_MOON, UMBRA_US / 2) > before);
}

// Everything that enters a thick medium without absorption is scattered in it: within it, what
// reaches a place has come from the medium, with all weights together 1.
static void weights_of_a_thick_medium_sum_to_one(void **state)
{
    (void)state;
    const struct medium medium = uniform_medium(3e-3, 0, 0);
    const struct solved *s = solve(&medium, NULL);
    const int middle = 7; // 24 km of 60
    float sum = 0;
    for (int b = 0; b < UMBRA_ALTITUDES; b++) {
        for (int r = 0; r < UMBRA_RINGS; r++) {
            sum += s->kernel.air_air[middle][b][r][0];
        }
    }
    // Sources that give less than 3e-4 are left out.
    assert_true(fabs((double)sum - 1) < 2e-3);
    // On the ground: irradiance pi under a sky of radiance 1.
    sum = 0;
    for (int b = 0; b < UMBRA_ALTITUDES; b++) {
        for (int r = 0; r < UMBRA_RINGS; r++) {
            sum += s->kernel.ground_air[b][r][0];
        }
    }
    assert_true(fabs((double)sum / SHARED_PI - 1) < 2e-3);
}

static void direct_light_is_beers(void **state)
{
    (void)state;
    const struct medium medium = uniform_medium(1e-5, 1e-5, 0);
    const struct solved *s = solve(&medium, NULL);
    const umbra_bands left = umbra_kernel_direct(&s->kernel, 0, 1, UMBRA_WHOLE);
    assert_true(fabs((double)left[1] - exp(-1.2)) < 1e-5);
    // Isotropic: similarity changes nothing.
    assert_true(umbra_kernel_direct(&s->kernel, 0, 1, UMBRA_SIMILAR)[1] == left[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_is_missing_without_a_shadow),
        cmocka_unit_test(nothing_is_left_where_all_is_dark),
        cmocka_unit_test(the_umbra_is_lit_from_beyond),
        cmocka_unit_test(orders_light_the_umbra),
        cmocka_unit_test(weights_of_a_thick_medium_sum_to_one),
        cmocka_unit_test(direct_light_is_beers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
