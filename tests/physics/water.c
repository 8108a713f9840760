// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Light in the water against closed forms and paths.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "context.h"
#include "frame/daylight.h"
#include "frame/sea.h"
#include "frame/under_light.h"
#include "ocean/sea.h"
#include "ocean/volume_under.h"
#include "reference/water.h"
#include "shared/fresnel.glsl"
#include "shared/sea.glsl"
#include "sky/sea_volume.h"

static void assert_near(double got, double wanted, double share)
{
    if (!(fabs(got - wanted) <= share * fabs(wanted))) {
        fail_msg("%.8g, not %.8g within %g of it", got, wanted, share);
    }
}

// Elek 2010, Figures 5 and 8: clear, much algae, mud; over sand.
enum { CLEAR, ALGAL, MUDDY, KINDS };
static struct ocean_desc kind(int k)
{
    static const struct ocean_water waters[KINDS] = {
        {0},
        {.chlorophyll_mg_m3 = 10, .dissolved_per_m_440 = 0.1},
        {.chlorophyll_mg_m3 = 1, .mud_g_m3 = 10}};
    return (struct ocean_desc){.water = waters[k], .bed.albedo = {.constant = 0.4}};
}

static struct volume_light solve(const trl_context *ctx, const struct volume_column *column,
                                 struct volume_view view)
{
    struct volume_light light;
    assert_int_equal(volume_radiance(ctx, column, &view, &light), TRL_OK);
    return light;
}

static void phase_functions_are_whole_and_have_their_backscatter(void **state)
{
    (void)state;
    static const double backs[] = {0.003, 0.0183, 0.05};
    for (int i = 0; i < 3; i++) {
        const struct water_optics optics = {.particles_per_m = 1, .backscatter = backs[i]};
        const struct water_phase phase = water_phase_make(&optics);
        double all = 0, back = 0;
        enum { STEPS = 20000 };
        const double step = log(M_PI / 1e-9) / STEPS; // the peak is a power of the angle
        for (int k = 0; k < STEPS; k++) {
            const double angle = 1e-9 * exp(step * (k + 0.5));
            const double part =
                water_phase_value(&phase, cos(angle)) * 2 * M_PI * sin(angle) * angle * step;
            all += part;
            back += angle > M_PI / 2 ? part : 0;
        }
        // What a cosine cannot tell from 1 is missing: of a peak of large particles, some per cent.
        assert_near(all, 1, i == 0 ? 0.05 : 0.01);
        // Of the closed integral less the added term, which takes as much as it gives: 6 %.
        assert_near(back, backs[i], 0.07);
    }
    // Mobley, Sundman and Boss 2002: the Petzold mean of 0.0183 has n = 1.10, slope 3.5835.
    const struct water_optics petzold = {.particles_per_m = 1, .backscatter = 0.0183};
    assert_near(water_phase_make(&petzold).slope, 3.5835, 2e-3);
}

// Nothing is lost in clear water over a white bed: below an even sky it has the sky's radiance,
// more by the square of the index in the water, whatever it scatters.
static void a_furnace_is_even(void **state)
{
    for (int i = 0; i < 2; i++) {
        const struct volume_column column = {
            .optics = {.clear_per_m = 0.05, .particles_per_m = i * 0.5, .backscatter = 0.02},
            .index = 1.34,
            .depth_m = 5,
            .bed_albedo = 1};
        static const double views[] = {-0.95, -0.4, -0.1, 0.3, 0.7, 0.97};
        for (int v = 0; v < 6; v++) {
            const struct volume_view below = {2, 0.5, views[v], 0};
            assert_near(solve(*state, &column, below).sky, 1.34 * 1.34 / M_PI, 2e-3);
            const struct volume_view above = {0, 0.5, views[v], 0};
            if (views[v] < 0) {
                assert_near(solve(*state, &column, above).sky,
                            (1 - fresnel_reflectance(-views[v], 1.34)) / M_PI, 2e-3);
            }
        }
    }
}

static void ways_can_be_reversed(void **state)
{
    for (int k = 0; k < KINDS; k++) {
        const struct ocean_desc ocean = kind(k);
        const struct volume_column column = volume_column_make(&ocean, 3, 550);
        const double there = solve(*state, &column, (struct volume_view){0, 0.9, -0.35, 1}).star;
        const double back = solve(*state, &column, (struct volume_view){0, 0.35, -0.9, 1}).star;
        assert_near(there, back, 1e-5); // doubling begins with layers that are off by as much
    }
}

// Without scattering light goes down, up, and back and forth between bed and surface.
static void absorbing_water_shows_its_bed(void **state)
{
    const struct volume_column column = {
        .optics = {.absorption_per_m = 0.3}, .index = 1.34, .depth_m = 2, .bed_albedo = 0.5};
    const double sun = sqrt(1 - (1 - 0.49) / (1.34 * 1.34));
    const double seen = sqrt(1 - (1 - 0.81) / (1.34 * 1.34));
    double again = 0; // of the bed's light on the bed, by the surface
    enum { STEPS = 20000 };
    for (int i = 0; i < STEPS; i++) {
        const double mu = (i + 0.5) / STEPS;
        again += 2 * mu / STEPS * fresnel_reflectance(mu, 1 / 1.34) * exp(-2 * 0.6 / mu);
    }
    const double bed =
        (1 - fresnel_reflectance(0.7, 1.34)) * exp(-0.6 / sun) * 0.5 / M_PI / (1 - 0.5 * again);
    const double wanted =
        bed * exp(-0.6 / seen) * (1 - fresnel_reflectance(0.9, 1.34)) / (1.34 * 1.34);
    assert_near(solve(*state, &column, (struct volume_view){0, 0.7, -0.9, 2}).star, wanted, 1e-4);
}

// By reference_water_radiance with 200000, 2000000 and 800000 paths of the seed 7: at 550 nm,
// azimuth 1 rad, view cosine -0.8; noon and 4 PM.
static const struct traced {
    int kind;
    double depth_m, sun_mu, star, star_error, sky, sky_error;
} traced[] = {
    {CLEAR, 2, 0.94, 0.059637, 5.4e-05, 0.055682, 0.00012},
    {CLEAR, 2, 0.5, 0.055445, 5e-05, 0.055682, 0.00012},
    {CLEAR, 4, 0.94, 0.044692, 5.4e-05, 0.041018, 0.00012},
    {CLEAR, 4, 0.5, 0.040265, 4.9e-05, 0.041018, 0.00012},
    {CLEAR, 10, 0.94, 0.020612, 4.1e-05, 0.018042, 9.2e-05},
    {CLEAR, 10, 0.5, 0.016938, 3.3e-05, 0.018042, 9.2e-05},
    {CLEAR, 100, 0.94, 0.0009258, 1.1e-06, 0.00092614, 9.2e-06},
    {CLEAR, 100, 0.5, 0.00080213, 1.1e-06, 0.00092614, 9.2e-06},
    {ALGAL, 2, 0.94, 0.032494, 7.6e-05, 0.029331, 2.5e-05},
    {ALGAL, 2, 0.5, 0.028298, 8e-05, 0.029331, 2.5e-05},
    {ALGAL, 4, 0.94, 0.014558, 4.9e-05, 0.012701, 1.8e-05},
    {ALGAL, 4, 0.5, 0.011961, 4.8e-05, 0.012701, 1.8e-05},
    {ALGAL, 10, 0.94, 0.0033052, 2.6e-05, 0.0032554, 1.3e-05},
    {ALGAL, 10, 0.5, 0.0034432, 2.8e-05, 0.0032554, 1.3e-05},
    {ALGAL, 100, 0.94, 0.0026132, 2.4e-05, 0.0027501, 1.3e-05},
    {ALGAL, 100, 0.5, 0.0030533, 2.7e-05, 0.0027501, 1.3e-05},
    {MUDDY, 2, 0.94, 0.037456, 0.00017, 0.036657, 6.5e-05},
    {MUDDY, 2, 0.5, 0.039061, 0.0002, 0.036657, 6.5e-05},
    {MUDDY, 4, 0.94, 0.031183, 0.00017, 0.031279, 6.7e-05},
    {MUDDY, 4, 0.5, 0.034105, 0.00019, 0.031279, 6.7e-05},
    {MUDDY, 10, 0.94, 0.030301, 0.00017, 0.030524, 6.7e-05},
    {MUDDY, 10, 0.5, 0.03348, 0.00019, 0.030524, 6.7e-05},
    {MUDDY, 100, 0.94, 0.030301, 0.00017, 0.030523, 6.7e-05},
    {MUDDY, 100, 0.5, 0.033479, 0.00019, 0.030523, 6.7e-05},
};

static void depths_and_waters_agree_with_paths(void **state)
{
    for (size_t i = 0; i < sizeof traced / sizeof *traced; i++) {
        const struct traced *t = &traced[i];
        const struct ocean_desc ocean = kind(t->kind);
        const struct volume_column column = volume_column_make(&ocean, t->depth_m, 550);
        const struct volume_view view = {0, t->sun_mu, -0.8, 1};
        const struct volume_light light = solve(*state, &column, view);
        assert_near(light.star, t->star, 0.03);
        assert_near(light.sky, t->sky, 0.03);
    }
}

static struct reference_water_light trace(const struct volume_column *column,
                                          const struct volume_view *view, uint64_t paths)
{
    const struct water_phase phase = water_phase_make(&column->optics);
    const struct reference_water water = {.absorption_per_m = column->optics.absorption_per_m,
                                          .clear_per_m = column->optics.clear_per_m,
                                          .particles_per_m = column->optics.particles_per_m,
                                          .particle_index = phase.index,
                                          .particle_slope = phase.slope,
                                          .index = column->index,
                                          .depth_m = column->depth_m,
                                          .bed_albedo = column->bed_albedo};
    const struct reference_water_view same = {view->eye_depth_m, view->sun_mu, view->view_mu,
                                              view->azimuth_rad};
    struct reference_water_light light;
    reference_water_radiance(&water, &same, paths, 3, &light);
    return light;
}

// Up and down, in Snell's window and beside it, in clear and in algal water.
static void eyes_under_water_agree_with_paths(void **state)
{
    static const double views[] = {-0.6, 0.4, 0.9};
    for (int i = 0; i < 6; i++) {
        const struct ocean_desc ocean = kind(i / 3);
        const struct volume_column column = volume_column_make(&ocean, 10, 550);
        const struct volume_view view = {2, 0.7, views[i % 3], 2.5};
        const struct volume_light light = solve(*state, &column, view);
        const struct reference_water_light paths = trace(&column, &view, 60000);
        // Beyond the noise, 3 %.
        assert_true(fabs(light.star - paths.star) <= 0.03 * paths.star + 3 * paths.star_error);
        assert_true(fabs(light.sky - paths.sky) <= 0.03 * paths.sky + 3 * paths.sky_error);
    }
}

static void the_table_says_the_same(void **state)
{
    static const double nm[] = {440, 550, 640};
    for (int k = 0; k < KINDS; k++) {
        const struct ocean_desc ocean = kind(k);
        struct volume_table *table = NULL;
        assert_int_equal(volume_table_make(*state, &ocean, nm, 3, &table), TRL_OK);
        static const double depths_m[] = {0.7, 2, 10, 100};
        for (int i = 0; i < 8; i++) {
            const double depth_m = depths_m[i % 4];
            const struct volume_view view = {0, i < 4 ? 0.94 : 0.5, i % 2 ? -0.97 : -0.3, 2};
            struct volume_light read[VOLUME_WAVELENGTHS];
            volume_table_at(table, depth_m, &view, read);
            for (int w = 0; w < 3; w++) {
                const struct volume_column column = volume_column_make(&ocean, depth_m, nm[w]);
                const struct volume_light light = solve(*state, &column, view);
                assert_near(read[w].star, light.star, 0.03); // between its entries
                assert_near(read[w].sky, light.sky, 0.03);
            }
        }
        volume_table_destroy(*state, &table);
        assert_null(table);
    }
}

// Every direction, near the surface, between, and near the bed; the eye between the table's depths.
static void tables_for_eyes_under_water_say_the_same(void **state)
{
    static const double nm[] = {440, 560, 640};
    static const double eyes_m[] = {0.01, 0.3, 1.1, 4.3, 9.6};
    static const double views[] = {-0.98, -0.5, -0.1, 0.1, 0.5, 0.72, 0.95};
    for (int k = 0; k < KINDS; k++) {
        const struct ocean_desc ocean = kind(k);
        struct volume_under *under = NULL;
        assert_int_equal(volume_under_get(*state, &ocean, nm, 3, 10, &under), TRL_OK);
        double worst = 0, mean = 0;
        int count = 0;
        for (int i = 0; i < 5 * 7 * 3; i += 2) {
            const int wavelength = i % 3;
            const struct volume_view view = {eyes_m[i / 21], i % 2 ? 0.9 : 0.4, views[i / 3 % 7],
                                             i % 4 * 0.9};
            const struct volume_light read = volume_under_at(under, wavelength, &view);
            struct volume_column column = volume_column_make(&ocean, 10, nm[wavelength]);
            column.index = under->index;
            const struct volume_light light = solve(*state, &column, view);
            const double star = fabs(read.star - light.star), sky = fabs(read.sky - light.sky);
            // Under an even sky its window is 0.57; near the bed of murky water it is night.
            assert_true(star < 0.03 * light.star + 0.002 && sky < 0.03 * light.sky + 0.002);
            const double off = fmax(star / light.star, sky / light.sky);
            worst = fmax(worst, off);
            mean += off;
            count++;
        }
        assert_true(mean / count < 0.03);
        printf("water %d: mean %.2f %%, worst %.2f %%\n", k, 100 * mean / count, 100 * worst);
        volume_under_destroy(*state, &under);
    }
}

// Pictures have columns for two depths an octave, and mix them for the depth that there is.
static void beds_between_columns_are_as_bright_as_their_own(void **state)
{
    static const double depth_m = 10, views[] = {-0.85, -0.3, 0.2, 0.9};
    const int wavelengths[] = {2, 8, 12};
    for (int k = 0; k < KINDS; k++) {
        struct ocean_desc ocean = kind(k);
        ocean.bed.depth_m = -1;
        struct under_columns columns = {.ctx = *state, .ocean = &ocean};
        double worst = 0;
        assert_int_equal(under_columns_find(&columns, depth_m), TRL_OK);
        for (int i = 0; i < 4 * 3; i++) {
            const int wavelength = wavelengths[i % 3];
            const struct volume_view view = {2, i % 2 ? 0.9 : 0.4, views[i / 3], 1};
            const struct volume_light read = under_columns_at(&columns, wavelength, depth_m, &view);
            struct volume_column column =
                volume_column_make(&ocean, depth_m, columns.of[0]->nm[wavelength]);
            column.index = columns.of[0]->index;
            const struct volume_light light = solve(*state, &column, view);
            const double off =
                fmax(fabs(read.star / light.star - 1), fabs(read.sky / light.sky - 1));
            worst = fmax(worst, off);
        }
        printf("water %d: %.2f %%\n", k, 100 * worst);
        assert_true(worst < 0.03); // what is between the tables' own entries is as far off
        under_columns_finish(&columns);
    }
}

static void tables_come_back_from_the_cache(void **state)
{
    (void)state;
    char folder[] = "/tmp/terrella-water-XXXXXX";
    assert_non_null(mkdtemp(folder));
    trl_context_desc desc = trl_context_desc_default();
    desc.cache_dir = folder;
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    static const double nm[] = {440, 640};
    const struct ocean_desc ocean = kind(ALGAL);
    struct volume_table *made = NULL, *kept = NULL, *other = NULL;
    assert_int_equal(volume_table_get(ctx, &ocean, nm, 2, &made), TRL_OK);
    assert_int_equal(volume_table_make(ctx, &ocean, nm, 2, &other), TRL_OK);
    assert_memory_equal(made, other, sizeof *made);
    memset(other->star, 0, sizeof other->star);
    const struct volume_kept kept_file = volume_table_kept(other);
    assert_true(volume_cache_load(ctx, &kept_file));
    assert_memory_equal(made, other, sizeof *made);
    other->column[1].bed_albedo += 1e-12; // other water
    assert_false(volume_cache_load(ctx, &kept_file));
    assert_int_equal(volume_table_get(ctx, &ocean, nm, 2, &kept), TRL_OK);
    assert_memory_equal(made, kept, sizeof *made);
    volume_table_destroy(ctx, &made);
    volume_table_destroy(ctx, &kept);
    volume_table_destroy(ctx, &other);
    for (int place = 0; place < 8; place++) {
        char path[64];
        snprintf(path, sizeof path, "%s/water-%d.bin", folder, place);
        unlink(path);
    }
    assert_int_equal(rmdir(folder), 0);
    trl_context_destroy(&ctx);
}

// Linear sRGB of the solution at twice as many wavelengths as the table has.
struct colours {
    double star[3], sky[3];
};
static void solve_colour(const trl_context *ctx, const struct ocean_desc *ocean,
                         const struct medium *medium, double depth_m,
                         const struct volume_view *view, struct colours *out)
{
    enum { COUNT = 33 };
    double nm[COUNT], weights[3][DAYLIGHT_MAX_WEIGHTS];
    for (int k = 0; k < COUNT; k++) {
        nm[k] = 390 + 10 * k;
    }
    daylight_weights(medium, nm, COUNT, weights);
    *out = (struct colours){0};
    for (int k = 0; k < COUNT; k++) {
        const struct volume_column column = volume_column_make(ocean, depth_m, nm[k]);
        const struct volume_light light = solve(ctx, &column, *view);
        for (int c = 0; c < 3; c++) {
            out->star[c] += M_PI * weights[c][k] * light.star;
            out->sky[c] += M_PI * weights[c][k] * light.sky;
        }
    }
}

static double luminance(const double rgb[3])
{
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

// Within 3 %: luminance, and each channel of the brightest.
static void assert_colours_near(const double got[3], const double wanted[3])
{
    const double most = fmax(fmax(wanted[0], wanted[1]), wanted[2]);
    assert_near(luminance(got), luminance(wanted), 0.03);
    for (int c = 0; c < 3; c++) {
        if (!(fabs(got[c] - wanted[c]) <= 0.03 * most)) {
            fail_msg("%g %g %g, not %g %g %g", got[0], got[1], got[2], wanted[0], wanted[1],
                     wanted[2]);
        }
    }
}

// What pictures look up is the colour of the solution: the depths of Elek's Figure 5 at noon and
// 4 PM, others between them, and with a low sun and from low eyes.
static void pictures_have_the_colour_of_the_solution(void **state)
{
    const struct medium medium = {.star_irradiance = {.constant = 1.5}};
    static const struct {
        double depth_m, sun_mu, view_mu;
    } places[] = {{2, 0.5, 0.8},    {4, 0.94, 0.8},  {10, 0.5, 0.8},
                  {100, 0.94, 0.8}, {6, 0.17, 0.33}, {30, 0.97, 0.8}};
    for (int k = 0; k < KINDS; k++) {
        const struct ocean_desc ocean = kind(k);
        struct sky_sea_volume *volume = NULL;
        assert_int_equal(frame_sea_make_volume(*state, &ocean, &medium, &volume), TRL_OK);
        for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
            const double seen = places[i].view_mu;
            const struct volume_view view = {0, places[i].sun_mu, -seen, 1};
            const struct sea_volume_rays rays = {view.sun_mu, seen, cos(1)};
            struct sea_volume_light light;
            struct colours wanted, got;
            solve_colour(*state, &ocean, &medium, places[i].depth_m, &view, &wanted);
            sea_volume_at(volume, sea_depth_code(places[i].depth_m), &rays, &light);
            sea_volume_rgb(volume, light.star, got.star);
            sea_volume_rgb(volume, light.sky, got.sky);
            const double index = volume_column_make(&ocean, 1, 560).index;
            const double leaves = 1 - fresnel_reflectance(seen, index);
            for (int c = 0; c < 3; c++) {
                got.star[c] *= leaves * (1 - fresnel_reflectance(view.sun_mu, index));
                got.sky[c] *= leaves;
            }
            assert_colours_near(got.star, wanted.star);
            assert_colours_near(got.sky, wanted.sky);
        }
        mem_free(*state, volume);
    }
}

// As albedo below the surface under an even sky: pi times what leaves straight upward per
// irradiance that has entered, without what the surface takes.
static double find_albedo(const trl_context *ctx, const struct ocean_desc *ocean, double depth_m,
                          double nm)
{
    const struct volume_column column = volume_column_make(ocean, depth_m, nm);
    const double entered = 1 - sea_diffuse_reflectance(column.index);
    return M_PI * solve(ctx, &column, (struct volume_view){0, 0.8, -1, 0}).sky /
           ((1 - fresnel_reflectance(1, column.index)) * entered);
}

static void water_has_the_colour_of_its_depth(void **state)
{
    const struct ocean_desc sea = {.water = {.chlorophyll_mg_m3 = 0.1, .dissolved_per_m_440 = 0.01},
                                   .bed.albedo = {.constant = 0.3}};
    // Irradiance reflectance of clear blue sea below the surface: 3 to 6 % in the blue, far less
    // than a hundredth in the red (Morel and Prieur 1977, Figure 2).
    const double factor = 1.34 * 1.34;
    assert_true(factor * find_albedo(*state, &sea, 1e6, 440) > 0.03);
    assert_true(factor * find_albedo(*state, &sea, 1e6, 440) < 0.07);
    assert_true(factor * find_albedo(*state, &sea, 1e6, 650) < 0.003);
    // No water: the bed behind the surface, with the light that goes back and forth.
    const double index = volume_column_make(&sea, 1e-6, 550).index;
    const double inner = 1 - (1 - sea_diffuse_reflectance(index)) / (index * index);
    assert_near(find_albedo(*state, &sea, 1e-6, 550), 0.3 / (1 - inner * 0.3) / (index * index),
                1e-4);
    double before = 1;
    for (double depth = 0; depth < 100; depth += 5) {
        const double green = find_albedo(*state, &sea, depth, 550);
        assert_true(green < before);
        before = green;
    }
    // Mud makes it brighter and browner.
    struct ocean_desc river = sea;
    river.water.mud_g_m3 = 50;
    assert_true(find_albedo(*state, &river, 1e6, 650) > find_albedo(*state, &river, 1e6, 440));
    assert_true(find_albedo(*state, &river, 1e6, 650) > 20 * find_albedo(*state, &sea, 1e6, 650));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(phase_functions_are_whole_and_have_their_backscatter),
        cmocka_unit_test(a_furnace_is_even),
        cmocka_unit_test(ways_can_be_reversed),
        cmocka_unit_test(absorbing_water_shows_its_bed),
        cmocka_unit_test(depths_and_waters_agree_with_paths),
        cmocka_unit_test(eyes_under_water_agree_with_paths),
        cmocka_unit_test(the_table_says_the_same),
        cmocka_unit_test(tables_for_eyes_under_water_say_the_same),
        cmocka_unit_test(beds_between_columns_are_as_bright_as_their_own),
        cmocka_unit_test(tables_come_back_from_the_cache),
        cmocka_unit_test(water_has_the_colour_of_its_depth),
        cmocka_unit_test(pictures_have_the_colour_of_the_solution)};
    return cmocka_run_group_tests_name("water", tests, make_context, drop_context);
}
