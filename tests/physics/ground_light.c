// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// How much brighter it is toward the star: from the moments, against sums over radiance.
#include "sky/ground_light.h"

#include "context.h"
#include "reference_media.h"
#include "scatter/query.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { RINGS = 48, AZIMUTHS = 12, ROWS_APART = 5, SUNS_APART = 6 };
static const double HIGHEST_M = 3000;

struct sky {
    struct atmosphere *atmosphere;
    struct query *query;
    float *slope, *irradiance; // as of ground_light.h
};

static struct sky make_sky(const trl_context *ctx, const struct medium *medium)
{
    struct atmosphere_desc desc = atmosphere_desc_default();
    desc.uses_cache = false;
    desc.wavelengths = 4;
    struct sky sky;
    assert_int_equal(atmosphere_create(ctx, medium, &desc, &sky.atmosphere), TRL_OK);
    assert_int_equal(query_create(ctx, &sky.atmosphere->solution, &sky.query), TRL_OK);
    const int suns = sky.atmosphere->solution.moments.suns;
    const size_t texels = (size_t)GROUND_LIGHT_ALTITUDES * (size_t)suns * BAND_COUNT;
    sky.slope = malloc(texels * sizeof *sky.slope);
    sky.irradiance = malloc(texels * sizeof *sky.irradiance);
    assert_true(sky.slope && sky.irradiance);
    ground_light_slope(sky.atmosphere, HIGHEST_M, sky.slope);
    ground_light_of_sky(sky.atmosphere, HIGHEST_M, sky.irradiance);
    return sky;
}

static void drop_sky(const trl_context *ctx, struct sky *sky)
{
    free(sky->slope);
    free(sky->irradiance);
    query_destroy(ctx, &sky->query);
    atmosphere_destroy(&sky->atmosphere);
}

// Toward the star's side, of all directions. They are dense about the horizon.
static double flux_by_sums(const struct sky *sky, double altitude_m, double sun_mu)
{
    const struct atmosphere *a = sky->atmosphere;
    double flux = 0;
    for (int i = 0; i < 2 * RINGS * AZIMUTHS; i++) {
        const double x = (i / AZIMUTHS + 0.5) / RINGS - 1; // mu = x |x|
        const double azimuth = M_PI * (i % AZIMUTHS + 0.5) / AZIMUTHS;
        const double sine = sqrt(1 - x * x * x * x);
        const struct query_view view = query_view_make(a->optics->ground_radius_m + altitude_m,
                                                       acos(sun_mu), acos(x * fabs(x)), azimuth);
        lanes radiance;
        query_radiance(sky->query, &view, &radiance);
        const double weight = 2 * fabs(x) / RINGS * 2 * M_PI / AZIMUTHS;
        flux += weight * (double)radiance[a->bands.lane[0]] * sine * cos(azimuth);
    }
    return flux;
}

// What is left of the star's beam, with what its light loses to forward peaks, or as it is kept:
// with that still in it.
static double beam(const struct atmosphere *a, double altitude_m, double sun_mu, bool keeps_peaks)
{
    static struct ray ray;
    const struct ray_desc desc = {.radius_m = a->optics->ground_radius_m + altitude_m,
                                  .mu = sun_mu,
                                  .nodes_per_shell = 96,
                                  .end_m = INFINITY};
    ray_init(&ray, a->optics, a->solution.rules, &desc);
    const int lane = a->bands.lane[0];
    double depth = 0;
    for (int i = 0; i < a->optics->constituent_count; i++) {
        const double peak =
            (double)a->optics->scattering_per_m[i][lane] * a->optics->forward_share[i];
        depth += ray.column_m[i] *
                 ((double)a->optics->extinction_per_m[i][lane] + (keeps_peaks ? 0 : peak));
    }
    return exp(-depth);
}

// Within 3 % of the sky's flux, or, where `is_whole`, of what sky and star have together.
static void check_sky(const struct sky *sky, double lowest_mu, bool is_whole)
{
    const struct moments *m = &sky->atmosphere->solution.moments;
    int checked = 0;
    for (int row = 0; row < GROUND_LIGHT_ALTITUDES; row += ROWS_APART) {
        for (int sun = 0; sun < m->suns - 1; sun += SUNS_APART) {
            const double mu = moments_sun_mu(m, sun);
            if (mu < lowest_mu) {
                continue;
            }
            const double altitude_m = HIGHEST_M * row / (GROUND_LIGHT_ALTITUDES - 1);
            const size_t texel = ((size_t)row * (size_t)m->suns + (size_t)sun) * BAND_COUNT;
            const double got =
                (double)sky->slope[texel] * exp((double)sky->irradiance[texel]) / 0.75;
            const double wanted = flux_by_sums(sky, altitude_m, mu);
            const double kept = beam(sky->atmosphere, altitude_m, mu, true) * sqrt(1 - mu * mu);
            const double left = beam(sky->atmosphere, altitude_m, mu, false) * sqrt(1 - mu * mu);
            const double off = is_whole ? (got + kept) / (wanted + left) - 1 : got / wanted - 1;
            if (!(fabs(off) < 0.03)) {
                fail_msg("%g m, star at %.1f degrees: %g, by sums %g; star %g and %g", altitude_m,
                         asin(mu) * 180 / M_PI, got, wanted, kept, left);
            }
            checked++;
        }
    }
    assert_true(checked > 10);
}

// Air that no moment is dropped of: the flux of moments is that of radiance, at each altitude.
static void light_comes_from_the_stars_side_as_radiance_does(void **state)
{
    struct medium medium = earth_like_medium(0.1);
    medium.constituents[1].phase = (struct phase){.kind = PHASE_RAYLEIGH};
    struct sky sky = make_sky(*state, &medium);
    assert_true(sky.atmosphere->optics->forward_share[1] == 0);
    check_sky(&sky, 0, false);
    drop_sky(*state, &sky);
}

// In haze peaks count as not scattered: what the sky's flux lacks of them the star's has. Below 5
// degrees light of this peak, which is wide, leaves the way of the star's: 7 % more at the ground.
static void forward_peaks_are_in_the_stars_light(void **state)
{
    const struct medium medium = earth_like_medium(0.1);
    struct sky sky = make_sky(*state, &medium);
    assert_true(sky.atmosphere->optics->forward_share[1] > 0.1);
    check_sky(&sky, 0.08, true);
    drop_sky(*state, &sky);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(light_comes_from_the_stars_side_as_radiance_does),
        cmocka_unit_test(forward_peaks_are_in_the_stars_light),
    };
    return cmocka_run_group_tests(tests, make_context, drop_context);
}
