// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The GPU's float and C's double agree on the formulas that are one text for both.
#include "fixture.h"

#include "shared/albedo.glsl"
#include "shared/blend.glsl"
#include "shared/eclipse.glsl"
#include "shared/penumbra.glsl"
#include "shared/phase.glsl"
#include "shared/profile.glsl"
#include "shared/projection.glsl"
#include "shared/projective.glsl"
#include "shared/sea.glsl"
#include "shared/shore.glsl"
#include "shared/sky_map.glsl"

#include <math.h>

// A float has 6e-8; a dozen operations, and an exp that drivers may take to a few parts in a
// million.
#define AGREEMENT 5e-6

static struct texel draw(struct fixture *f, struct gpu_program *program)
{
    const struct gpu_pass pass = {.target = &f->target};
    gpu_pass_begin(f->gpu, &pass);
    assert_int_equal(gpu_draw_fullscreen(program, "formulas"), TRL_OK);
    return fixture_read(&f->color, 0, 0);
}

static void assert_agree(float got, double wanted)
{
    const double error = fabs((double)got - wanted);
    if (!(error <= AGREEMENT * fabs(wanted))) {
        fail_msg("GPU %.9g, C %.17g", (double)got, wanted);
    }
}

static struct gpu_program make_program(struct fixture *f)
{
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "formulas.frag"};
    struct gpu_program program;
    assert_int_equal(gpu_program_init(f->gpu, &desc, &program), TRL_OK);
    return program;
}

static void phase_functions_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    const float g[] = {-0.9f, -0.3f, 0, 0.5f, 0.76f, 0.99f, 0.9999f};
    const float nu[] = {-1, -0.99f, -0.5f, 0, 0.3f, 0.9f, 0.999f, 1};
    for (size_t i = 0; i < sizeof g / sizeof g[0]; i++) {
        for (size_t j = 0; j < sizeof nu / sizeof nu[0]; j++) {
            const float angle[4] = {nu[j], g[i], 0, 0};
            gpu_program_set_vec4(&program, "u_angle", angle);
            const struct texel got = draw(f, &program);
            const double cosine = (double)nu[j];
            const double asymmetry = (double)g[i];
            assert_agree(got.rgba[0], phase_isotropic());
            assert_agree(got.rgba[1], phase_rayleigh(cosine));
            assert_agree(got.rgba[2], phase_henyey_greenstein(cosine, asymmetry));
            assert_agree(got.rgba[3], phase_cornette_shanks(cosine, asymmetry));
        }
    }
    gpu_program_finish(&program);
}

static void profiles_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_profile", 1);
    const float altitude[] = {0, 100, 8000, 20000, 30000, 50000};
    for (size_t i = 0; i < sizeof altitude / sizeof altitude[0]; i++) {
        const float shell[4] = {altitude[i], 8000, 25000, 15000};
        gpu_program_set_vec4(&program, "u_shell", shell);
        const struct texel got = draw(f, &program);
        assert_agree(got.rgba[0], profile_exponential((double)altitude[i], 8000));
        assert_agree(got.rgba[1], profile_tent((double)altitude[i], 25000, 15000));
    }
    gpu_program_finish(&program);
}

// Also that dark ground is as much brighter as it is said to be, and that none is brighter than 1.
static void albedos_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_blend", 1);
    const float albedo[] = {0.001f, 0.05f, 0.3f, 0.8f, 1}, paler[] = {0.2f, 1, 1.5f};
    for (size_t i = 0; i < sizeof albedo / sizeof *albedo; i++) {
        for (size_t j = 0; j < sizeof paler / sizeof *paler; j++) {
            gpu_program_set_vec4(&program, "u_angle", (const float[4]){albedo[i], 0, 0, 0});
            gpu_program_set_vec4(&program, "u_shell", (const float[4]){paler[j], 0, 0, 0});
            const double wanted = albedo_varied((double)albedo[i], (double)paler[j]);
            assert_agree(draw(f, &program).rgba[3], wanted);
            assert_true(paler[j] != 1 || fabs(wanted - (double)albedo[i]) < 1e-12);
            assert_true(wanted <= 1);
        }
    }
    assert_true(fabs(albedo_varied(0.01, 1.2) / 0.012 - 1) < 0.02);
    assert_true(fabs(albedo_varied(0.8, 1.2) / 0.8 - 1) < 0.03);
    gpu_program_finish(&program);
}

// Of a standard normal variable.
static double mean_cover(double share, double strength, double hidden)
{
    double sum = 0, weights = 0;
    for (double z = -5; z <= 5; z += 0.01) {
        const double weight = exp(-z * z / 2);
        sum += weight * albedo_cover(share, z * sqrt(1 - hidden), strength, hidden);
        weights += weight;
    }
    return sum / weights;
}

// Also that the mean over all heights is the share, however much of them is seen: within 0.02,
// which is the error of the logistic function's mean and of the clamped ends.
static void covers_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_blend", 1);
    gpu_program_set_float(&program, "u_wants_cover", 1);
    const float share[] = {0, 0.1f, 0.5f, 0.9f, 1};
    for (size_t i = 0; i < sizeof share / sizeof *share; i++) {
        const double s = (double)share[i];
        gpu_program_set_vec4(&program, "u_angle", (const float[4]){share[i], 0.7f, 0, 0});
        gpu_program_set_vec4(&program, "u_shell", (const float[4]){2, 0.25f, 0, 0});
        const double wanted = albedo_cover(s, (double)0.7f, 2, 0.25);
        assert_true(fabs((double)draw(f, &program).rgba[1] - wanted) < 1e-5);
        for (double hidden = 0; hidden <= 1; hidden += 0.5) {
            const double mean = mean_cover(s, 3, hidden);
            if (!(fabs(mean - s) < 0.02)) {
                fail_msg("a share of %.2f becomes %.4f, %.1f hidden", s, mean, hidden);
            }
        }
    }
    assert_true(albedo_cover(0.5, 1, 3, 0) > 0.9 && albedo_cover(0.5, -1, 3, 0) < 0.1);
    gpu_program_finish(&program);
}

// Coordinates are compared as they are used: the finest table has 256 texels, and this is a
// twentieth of one. Roots near 0 leave a float no more.
static void assert_same_texel(float got, double wanted)
{
    if (!(fabs((double)got - wanted) <= 2e-4)) {
        fail_msg("GPU %.9g, C %.17g", (double)got, wanted);
    }
}

static void maps_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_map", 1);
    const float distance[] = {1000, 1500, 90000, 700000, 1000000, 1133000};
    const float mu[] = {-0.28f, -0.1f, -0.02f, 0, 0.003f, 0.2f, 1};
    const float altitude[] = {0, 2, 8848, 99000};
    for (size_t i = 0; i < sizeof distance / sizeof distance[0]; i++) {
        for (size_t j = 0; j < sizeof mu / sizeof mu[0]; j++) {
            const float high = altitude[(i + j) % 4];
            const float map[4] = {distance[i], 1133000, mu[j], high};
            gpu_program_set_vec4(&program, "u_map", map);
            const struct texel got = draw(f, &program);
            const double lowest = sky_map_lowest_sun(6371000, (double)high, 0.99998915, 0.0046529);
            assert_same_texel(got.rgba[0], sky_map_view((double)distance[i], 1000, 1133000));
            assert_same_texel(got.rgba[1], sky_map_sun((double)mu[j], -0.07, 0.07, -2, 3.4));
            assert_same_texel(got.rgba[2], sky_map_sunlight((double)mu[j], lowest, 0.01));
            assert_same_texel(got.rgba[3], sky_map_depth((double)distance[i], 1000, 1133000));
        }
    }
    gpu_program_finish(&program);
}

static void maps_from_outside_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_outside", 1);
    const float distance[] = {1000, 1500, 90000, 700000, 1000000, 1133000};
    const float mu[] = {-0.28f, -0.02f, 0, 0.2f, 1};
    for (size_t i = 0; i < sizeof distance / sizeof distance[0]; i++) {
        for (size_t j = 0; j < sizeof mu / sizeof mu[0]; j++) {
            const float map[4] = {distance[i], 1133000, mu[j], 0};
            gpu_program_set_vec4(&program, "u_map", map);
            const struct texel got = draw(f, &program);
            const double way = (double)distance[i];
            const SkyMapSuns suns = sky_map_suns(7e6, way, 6.5e6, -0.4, (double)mu[j]);
            assert_same_texel(got.rgba[0], sky_map_ground_row_outside(way, 1000, 1133000));
            assert_same_texel(got.rgba[1], sky_map_depth_outside(way, 1000, 700000, 1133000, 0.5));
            assert_same_texel(got.rgba[2], suns.middle);
            assert_same_texel(got.rgba[3], suns.reach);
        }
    }
    gpu_program_finish(&program);
}

static void shadows_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_shadow", 1);
    const float t[] = {-500, -1, -0.7f, -0.005f, 0, 0.4f, 1, 3, 2000};
    for (size_t i = 0; i < sizeof t / sizeof t[0]; i++) {
        for (size_t j = 0; j < sizeof t / sizeof t[0]; j++) {
            const float ends[4] = {t[i], t[j], 0, 0};
            gpu_program_set_vec4(&program, "u_angle", ends);
            const struct texel got = draw(f, &program);
            assert_true(fabs((double)got.rgba[0] - penumbra_visible((double)t[i])) < AGREEMENT);
            // A difference of two integrals, over as little as 0.02.
            assert_true(fabs((double)got.rgba[1] - penumbra_mean((double)t[i], (double)t[j])) <
                        2e-5);
            if (t[i] >= 1 && t[j] >= 1) {
                assert_true(got.rgba[1] == 1.0f);
            }
        }
    }
    gpu_program_finish(&program);
}

static void eclipses_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_eclipse", 1);
    const float apart[] = {0, 0.003f, 0.06f, 0.3f, 0.95f, 1, 1.04f, 1.3f, 2, 2.06f, 19, 20.5f};
    const float radius[] = {0.01f, 0.5f, 0.94f, 1, 1.06f, 20};
    for (size_t i = 0; i < sizeof apart / sizeof apart[0]; i++) {
        for (size_t j = 0; j < sizeof radius / sizeof radius[0]; j++) {
            const float discs[4] = {apart[i], radius[j], 0, 0};
            const double across = 2e5 * (double)apart[i];
            const float place[4] = {(float)across, 3.6e8f, 0, 0};
            gpu_program_set_vec4(&program, "u_angle", discs);
            gpu_program_set_vec4(&program, "u_shell", place);
            const struct texel got = draw(f, &program);
            // Parts of a disc are differences of angles that are some 1, the larger disc's times
            // the square of its radius; Mesa takes atan2 and asin to 1e-5 and 1e-4.
            const double wanted = eclipse_visible((double)apart[i], (double)radius[j]);
            const double scale = fmax(1, pow((double)radius[j], 2));
            assert_true(fabs((double)got.rgba[0] - wanted) < 1e-5 * scale);
            assert_agree(got.rgba[1], eclipse_corona((double)apart[i]));
            const double shadow =
                eclipse_shadow((double)place[0], (double)place[1], 1737400, 0.0046529);
            assert_true(fabs((double)got.rgba[2] - shadow) < 1e-4);
            assert_true((got.rgba[2] == 1) == (shadow == 1));
        }
    }
    gpu_program_finish(&program);
}

// From a metre above the Earth to a hundred radii, short of the tangent, where a float has the root
// of its rounding only.
static void projective_rays_agree(void **state)
{
    struct fixture *f = *state;
    const struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                          .fragment = "projective.frag"};
    struct gpu_program program;
    assert_int_equal(gpu_program_init(f->gpu, &desc, &program), TRL_OK);
    const float part[] = {0.01f, 0.3f, 0.6f, 0.9f, 0.99f};
    const float altitude[] = {1, 100, 30000, 4e5f, 6.371e6f, 6.371e8f};
    for (size_t i = 0; i < sizeof part / sizeof part[0]; i++) {
        for (size_t j = 0; j < sizeof altitude / sizeof altitude[0]; j++) {
            const float ray[4] = {part[i], altitude[j], 6.371e6f, 8848};
            gpu_program_set_vec4(&program, "u_ray", ray);
            const struct texel got = draw(f, &program);
            const double excess = projective_excess((double)altitude[j], 6.371e6);
            const double tangent = projective_tangent(excess);
            const double omega = (double)part[i] * tangent;
            const double reach = projective_reach(excess, 6.371e6, 8848);
            const double wanted[4] = {
                projective_normal_angle(omega, tangent, excess),
                projective_distance(omega, tangent, excess, (double)altitude[j]),
                projective_blended_angle(omega, excess, reach, 0.5),
                projective_rings_within((double)part[i], 0.001, 7)};
            for (int c = 0; c < 4; c++) {
                // Mesa's atan is a polynomial that is off by 2e-5; each angle has two or three.
                const double error = fabs((double)got.rgba[c] - wanted[c]);
                if (!(error <= 1e-4 * fabs(wanted[c]))) {
                    fail_msg("number %d at %g of the tangent, %g m: GPU %.9g, C %.17g", c,
                             (double)part[i], (double)altitude[j], (double)got.rgba[c], wanted[c]);
                }
            }
        }
    }
    gpu_program_finish(&program);
}

static void seas_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_sea", 1);
    const float cosines[] = {0.01f, 0.1f, 0.5f, 0.9f, 0.999f};
    const float slopes[] = {0.003f, 0.04f, 0.2f};
    for (size_t i = 0; i < sizeof cosines / sizeof cosines[0]; i++) {
        for (size_t j = 0; j < sizeof slopes / sizeof slopes[0]; j++) {
            const float angle[4] = {cosines[i], j == 1 ? 0.75f : 1.34f, 0, 0};
            const float shell[4] = {slopes[j], 0.3f, cosines[4 - i], 30.0f * (float)j};
            gpu_program_set_vec4(&program, "u_angle", angle);
            gpu_program_set_vec4(&program, "u_shell", shell);
            const struct texel got = draw(f, &program);
            const double mu = (double)cosines[i], mss = (double)slopes[j];
            const double wanted[4] = {
                fresnel_reflectance(mu, (double)angle[1]), sea_hidden(mu, mss),
                sea_glint(mu, 0.8, (double)shell[1], (double)shell[2], mss, 1.34), shell[3]};
            gpu_program_set_float(&program, "u_wants_sea", 3);
            const struct texel foam = draw(f, &program);
            gpu_program_set_float(&program, "u_wants_sea", 1);
            const double white = sea_foam(3 * mu, mss, (double)shell[2] + 1, (double)shell[1]);
            if (fabs((double)foam.rgba[0] - white) > 1e-5) {
                fail_msg("foam: GPU %.9g, C %.17g", (double)foam.rgba[0], white);
            }
            // Powers of e of steep facets in a calm sea lose digits, but there is no light then.
            for (int k = 0; k < 4; k++) {
                if (fabs((double)got.rgba[k] - wanted[k]) > 1e-6 + 1e-4 * fabs(wanted[k])) {
                    fail_msg("%d: GPU %.9g, C %.17g", k, (double)got.rgba[k], wanted[k]);
                }
            }
        }
    }
    gpu_program_finish(&program);
}

static void shores_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    const float masks[] = {0, 0.3f, 0.55f, 0.9f, 1}, altitudes[] = {-3, 0, 0.4f, 40};
    for (int i = 0; i < 3 * 5 * 4 * 4; i++) {
        const float bed = 0.5f * (float)(i / 80);
        // Mask, texels in a footprint, how fine heights are.
        // Altitude, that around, slope, made-up detail.
        const float angle[4] = {masks[i % 5], i / 20 % 4 == 3 ? 0.6f : 0.05f, 0.5f * (float)(i % 3),
                                0};
        const float shell[4] = {altitudes[i / 5 % 4], 20.0f * (float)(i / 20 % 4), 0.01f,
                                0.4f * (float)(i / 20 % 4) - 0.5f};
        gpu_program_set_float(&program, "u_wants_sea", 2 + 0.5f * bed);
        gpu_program_set_vec4(&program, "u_angle", angle);
        gpu_program_set_vec4(&program, "u_shell", shell);
        const struct texel got = draw(f, &program);
        for (int k = 0; k < 2; k++) {
            const ShoreWater w = shore_water((Shore){
                (double)angle[0], 1 - k, (double)angle[1], (double)shell[0], (double)bed,
                (double)shell[1], (double)angle[2], (double)shell[2], (double)shell[3], 4000});
            assert_true(w.part >= 0 && w.part <= 1 && w.code >= 0 && w.code <= 1);
            if (fabs((double)got.rgba[k] - w.part) > 1e-5 ||
                fabs((double)got.rgba[k + 2] - w.code) > 1e-5) {
                fail_msg("%d, %d: GPU %.9g, %.9g, C %.17g, %.17g", i, k, (double)got.rgba[k],
                         (double)got.rgba[k + 2], w.part, w.code);
            }
        }
    }
    gpu_program_finish(&program);
}

static void blends_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    gpu_program_set_float(&program, "u_wants_blend", 1);
    const float values[] = {-2000, -0.5f, 0, 0.25f, 1, 8000};
    for (int mode = 0; mode <= 4; mode++) {
        for (size_t i = 0; i < 36; i++) {
            const float pair[4] = {values[i % 6], values[i / 6], 0, 0};
            const float how[4] = {(float)mode, 0.25f, 0, 0};
            gpu_program_set_vec4(&program, "u_angle", pair);
            gpu_program_set_vec4(&program, "u_shell", how);
            const struct texel got = draw(f, &program);
            const double below = (double)pair[0], value = (double)pair[1];
            assert_agree(got.rgba[0], blend_layers(mode, below, value, 0.25));
            assert_agree(got.rgba[1], blend_slope(mode, below, value, 3, 4));
            assert_agree(got.rgba[2], blend_neutral(mode, below));
            // What is neutral changes nothing, at any weight.
            const double neutral = blend_neutral(mode, below);
            assert_true(blend_layers(mode, below, neutral, 0.25) == below);
        }
    }
    gpu_program_finish(&program);
}

// Offsets keep their digits however small they are: errors are counted in parts of the offset.
static void projections_agree(void **state)
{
    struct fixture *f = *state;
    struct gpu_program program = make_program(f);
    const float latitudes[] = {1.5707963f, 1.5f, 1, 0.3f, -0.2f};
    const float offsets[] = {1e-9f, -3e-6f, 2e-3f, -0.2f};
    for (size_t i = 0; i < 2 * 5 * 16; i++) {
        const float pole = i % 2 ? -1 : 1;
        const float place[4] = {pole * latitudes[i / 2 % 5], offsets[i / 10 % 4],
                                -pole * fabsf(offsets[i / 40]), pole};
        gpu_program_set_vec4(&program, "u_place", place);
        const double sine = sin((double)place[0]), cosine = cos((double)place[0]);
        const AxisOffset o =
            projection_axis_offset(sine, cosine, (double)place[1], (double)place[2]);
        const MapOffset m =
            projection_stereographic(o, sine, cosine, (double)pole, 0.0066943799, 1);
        const double size = fabs((double)place[1]) + fabs((double)place[2]);
        gpu_program_set_float(&program, "u_wants_projection", 1);
        struct texel got = draw(f, &program);
        // Sine and cosine of the anchor are floats too: 6e-8, times a few operations.
        assert_true(fabs((double)got.rgba[0] - o.outward) < 1e-6 * size);
        assert_true(fabs((double)got.rgba[1] - o.east) < 1e-6 * size);
        assert_true(fabs((double)got.rgba[2] - o.up) < 1e-6 * size);
        gpu_program_set_float(&program, "u_wants_projection", 2);
        got = draw(f, &program);
        assert_true(fabs((double)got.rgba[0] - m.x) < 3e-6 * size);
        assert_true(fabs((double)got.rgba[1] - m.y) < 3e-6 * size);
        assert_agree(got.rgba[2], projection_stereographic_scale(sine, o.up, (double)pole));
    }
    gpu_program_finish(&program);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phase_functions_agree),
        cmocka_unit_test(albedos_agree),
        cmocka_unit_test(covers_agree),
        cmocka_unit_test(profiles_agree),
        cmocka_unit_test(maps_agree),
        cmocka_unit_test(maps_from_outside_agree),
        cmocka_unit_test(shadows_agree),
        cmocka_unit_test(eclipses_agree),
        cmocka_unit_test(projective_rays_agree),
        cmocka_unit_test(blends_agree),
        cmocka_unit_test(seas_agree),
        cmocka_unit_test(shores_agree),
        cmocka_unit_test(projections_agree),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
