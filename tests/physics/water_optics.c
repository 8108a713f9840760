// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What water and what is in it absorb and scatter, against numbers as printed elsewhere than in the
// sources of src/ocean/water.c.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <math.h>

#include "ocean/water.h"

static void assert_within(double got, double wanted, double share)
{
    if (!(fabs(got - wanted) <= share * wanted)) {
        fail_msg("%.6g, not %.6g within %g of it", got, wanted, share);
    }
}

static struct water_optics of(struct ocean_water water, double nm)
{
    return water_optics_at(&water, nm);
}

static void clear_water_absorbs_as_measured(void **state)
{
    (void)state;
    // Pope and Fry 1997: the abstract's 0.0044 +- 0.0006 at 418 nm; between the wavelengths kept,
    // their Table 3.
    assert_within(of((struct ocean_water){0}, 418).absorption_per_m, 0.0044, 0.0006 / 0.0044);
    static const double printed[][2] = {{425, 0.00478}, {445, 0.00751}, {475, 0.0114},
                                        {525, 0.0417},  {555, 0.0596},  {575, 0.0772},
                                        {635, 0.3012},  {675, 0.448},   {715, 1.007}};
    for (int i = 0; i < 9; i++) {
        const double got = of((struct ocean_water){0}, printed[i][0]).absorption_per_m;
        assert_within(got, printed[i][1], 0.06);
    }
    // Smith and Baker 1981, Table 1, where they are used.
    assert_within(of((struct ocean_water){0}, 750).absorption_per_m, 2.47, 1e-6);
    assert_within(of((struct ocean_water){0}, 800).absorption_per_m, 2.07, 1e-3);
}

static void clear_water_scatters_as_measured(void **state)
{
    (void)state;
    // Morel 1974 at 500 nm, as most who cite him have it: 0.00288 with salt, 0.00222 without.
    assert_within(of((struct ocean_water){0}, 500).clear_per_m, 0.00288, 0.015);
    assert_within(of((struct ocean_water){.kind = OCEAN_FRESH}, 500).clear_per_m, 0.00222, 0.015);
    // Mobley 1994, Light and Water, as others have it: 16.06 times 4.72e-4 per m and sr at 400 nm.
    assert_within(of((struct ocean_water){0}, 400).clear_per_m, 16.06 * 4.72e-4, 0.01);
}

static void clear_water_refracts_as_measured(void **state)
{
    (void)state;
    // Water at 20 deg C relative to air at the lines C, D and F.
    static const double lines[3][2] = {{656.28, 1.33115}, {589.26, 1.33299}, {486.13, 1.33712}};
    const struct ocean_water fresh = {.kind = OCEAN_FRESH}, sea = {0};
    for (int i = 0; i < 3; i++) {
        const double index = water_refractive_index(&fresh, lines[i][0]);
        assert_within(index, lines[i][1], 5e-5);
        // Salt adds 0.0064 (Austin and Halikas 1976).
        assert_within(water_refractive_index(&sea, lines[i][0]) - index, 0.0064, 0.04);
    }
    const struct ocean_water methane = {.has_refractive_index = true,
                                        .refractive_index = {.constant = 1.27}};
    assert_within(water_refractive_index(&methane, 500), 1.27, 1e-12);
}

// Diffuse attenuation just below the surface, 1.04 (a + b_b) times the mean way, here that of a sun
// 35 degrees from the zenith (Gordon 1989, Limnol. Oceanogr. 34), against what Morel and Maritorena
// 2001 (J. Geophys. Res. 106, Eq. 5) measured where algae and what they dissolve are all there is:
// 0.0166 + 0.07242 C^0.68955 at 490 nm.
static void algae_dim_the_sea_as_measured(void **state)
{
    (void)state;
    static const double chlorophyll[] = {0.03, 0.1, 0.3, 1, 3};
    for (int i = 0; i < 5; i++) {
        // What is dissolved goes with the algae: a fifth of their and the water's absorption.
        struct ocean_water water = {.chlorophyll_mg_m3 = chlorophyll[i]};
        water.dissolved_per_m_440 = 0.2 * of(water, 440).absorption_per_m;
        const struct water_optics optics = of(water, 490);
        const double back = 0.5 * optics.clear_per_m + optics.backscatter * optics.particles_per_m;
        assert_within(1.04 * 1.10 * (optics.absorption_per_m + back),
                      0.0166 + 0.07242 * pow(chlorophyll[i], 0.68955), 0.16);
    }
}

static void constituents_are_as_published(void **state)
{
    (void)state;
    const struct ocean_water none = {0};
    // Red peak of chlorophyll a over the blue one (Prieur and Sathyendranath 1981: 0.595 at 670).
    const struct ocean_water algae = {.chlorophyll_mg_m3 = 1};
    const double blue = of(algae, 440).absorption_per_m - of(none, 440).absorption_per_m;
    const double red = of(algae, 670).absorption_per_m - of(none, 670).absorption_per_m;
    assert_within(blue, 0.06, 1e-9);
    assert_within(red / blue, 0.595, 1e-9);
    // Morel 1988: scattering 0.30 C^0.62 at 550 nm, of which 1.2 % goes back for C = 1.
    assert_within(of(algae, 550).particles_per_m, 0.30, 1e-9);
    assert_within(of(algae, 550).backscatter, 0.012, 1e-9);
    assert_within(of((struct ocean_water){.chlorophyll_mg_m3 = 10}, 550).particles_per_m,
                  0.30 * 4.1687, 1e-4);
    // Dissolved matter falls to a half each 49.5 nm (Bricaud et al. 1981: 0.014 per nm).
    const struct ocean_water yellow = {.dissolved_per_m_440 = 0.1};
    const double at_440 = of(yellow, 440).absorption_per_m - of(none, 440).absorption_per_m;
    const double later = of(yellow, 489.51).absorption_per_m - of(none, 489.51).absorption_per_m;
    assert_within(at_440, 0.1, 1e-9);
    assert_within(later, 0.05, 1e-4);
    // Minerals send back 0.012 m2 per g (Neukermans et al. 2012, Limnol. Oceanogr. 57), which
    // varies by a factor of three. Their absorption halves each 56 nm (Babin et al. 2003).
    const struct ocean_water mud = {.mud_g_m3 = 1};
    assert_within(of(mud, 555).particles_per_m * of(mud, 555).backscatter, 0.012, 0.2);
    assert_within(of(mud, 443).absorption_per_m - of(none, 443).absorption_per_m, 0.041, 1e-9);
    assert_within(of(mud, 499.35).absorption_per_m - of(none, 499.35).absorption_per_m, 0.0205,
                  1e-3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(clear_water_absorbs_as_measured),
                                       cmocka_unit_test(clear_water_scatters_as_measured),
                                       cmocka_unit_test(clear_water_refracts_as_measured),
                                       cmocka_unit_test(algae_dim_the_sea_as_measured),
                                       cmocka_unit_test(constituents_are_as_published)};
    return cmocka_run_group_tests_name("water optics", tests, NULL, NULL);
}
