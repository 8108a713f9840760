// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Biomes of made-up ground: each range decides by what it names alone, and pictures have the
// colours that the CPU knows, which traced pictures and the light of regions are made with.
#include "fixture.h"
#include "terrain/look.h"

#include <stdio.h>

static const double DEGREE = 3.14159265358979323846 / 180;
enum { RANGES = 5 };

static struct biome white(void)
{
    return (struct biome){.albedo = {0.8f, 0.8f, 0.8f},
                          .altitude_m = FIXTURE_ANY,
                          .slope = FIXTURE_ANY,
                          .latitude_deg = FIXTURE_ANY,
                          .temperature_C = FIXTURE_ANY,
                          .moisture = FIXTURE_ANY};
}

static struct biome_range *range_of(struct biome *b, int i)
{
    struct biome_range *const ranges[RANGES] = {&b->altitude_m, &b->slope, &b->latitude_deg,
                                                &b->temperature_C, &b->moisture};
    return ranges[i];
}

static double white_at(const struct biomes *biomes, struct biome_place place)
{
    double rgb[3] = {0};
    biomes_colour(biomes, &place, rgb);
    return rgb[1] / 0.8;
}

// Inside all, outside nothing, on each end a half; whatever the other four are.
static void test_each_range_decides_by_what_it_names(void **state)
{
    (void)state;
    static const struct biome_range ranges[RANGES] = {
        {1000, 2000, 200}, {0.5, 1, 0.1}, {30, 60, 4}, {-10, 5, 2}, {-0.2, 0.4, 0.2}};
    for (int i = 0; i < RANGES; i++) {
        struct biomes biomes = {.count = 1, .climate = {28, -22, 0.0065}};
        biomes.list[0] = white();
        *range_of(&biomes.list[0], i) = ranges[i];
        for (int k = 0; k < 5; k++) {
            const struct biome_range *r = &ranges[i];
            const double x = r->low + (0.5 * k - 0.5) * (r->high - r->low);
            // Latitude from 28 - 50 sin^2 - 0.0065 * 800 where it is the temperature that is asked.
            const double sine = i == 3 ? sqrt((28 - 5.2 - x) / 50) : sin(0.3);
            const struct biome_place place = {.altitude_m = i == 0 ? x : 800,
                                              .slope = i == 1 ? x : 0.2,
                                              .latitude_rad = i == 2 ? -x * DEGREE : asin(sine),
                                              .moisture = i == 4 ? x : 0.9};
            assert_close(white_at(&biomes, place), k % 4 == 0 ? 0 : k % 2 == 1 ? 0.5 : 1, 1e-6);
        }
    }
}

static void test_later_ones_lie_over_earlier_ones(void **state)
{
    (void)state;
    struct biomes biomes = {.count = 2};
    biomes.list[0] = white();
    biomes.list[1] = white();
    biomes.list[1].albedo[1] = 0.2f;
    biomes.list[1].altitude_m = (struct biome_range){500, 1e9, 100};
    assert_close(white_at(&biomes, (struct biome_place){.altitude_m = 400}), 1, 1e-6);
    assert_close(white_at(&biomes, (struct biome_place){.altitude_m = 600}), 0.25, 1e-6);
    // Frayed by the relief: by half a feather where its tone is 1.
    assert_close(white_at(&biomes, (struct biome_place){.altitude_m = 500, .tone = 1}), 0.25, 1e-6);
}

// Green by altitude, red by slope, blue by climate, over grey. Without octaves below 8 m: stones
// are in pictures only.
static struct surface_desc make_planet(void)
{
    struct surface_desc desc = fixture_invent(5);
    desc.noise.smallest_m = 8;
    desc.continents.height_m = 4000;
    desc.continents.amplitude_m = 1500;
    desc.biomes = (struct biomes){.count = 5, .climate = {30, -30, 0.006}};
    struct biome *list = desc.biomes.list;
    const float albedos[][3] = {{0.3f, 0.3f, 0.3f},
                                {0.05f, 0.5f, 0.05f},
                                {0.5f, 0.1f, 0.05f},
                                {0.1f, 0.1f, 0.6f},
                                {0.4f, 0.4f, 0.05f}};
    for (int i = 0; i < 5; i++) {
        list[i] = white();
        list[i].variation = 0.2;
        for (int c = 0; c < 3; c++) {
            list[i].albedo[c] = albedos[i][c];
        }
    }
    list[1].altitude_m = (struct biome_range){1500, 1e9, 600};
    list[2].slope = (struct biome_range){0.3, 1e9, 0.2};
    list[3].temperature_C = (struct biome_range){-1e9, 0, 6};
    list[4].moisture = (struct biome_range){-1e9, -0.1, 0.2};
    return desc;
}

static void test_pictures_have_the_cpus_colours(void **state)
{
    struct fixture *f = *state;
    const struct surface_desc desc = make_planet();
    struct surface with, without;
    assert_int_equal(surface_init(f->gpu, &desc, &with), TRL_OK);
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &without), TRL_OK);
    enum { PLACES = 24 };
    double least[3] = {1, 1, 1}, most[3] = {0}, worst = 0;
    for (int i = 0; i < PLACES; i++) {
        struct camera_place place = {89 * sin(2.3 * i), 137.5 * i, desc.radius_m, 0, 0, -90, 0.5};
        place.altitude_m =
            surface_altitude(&without, vec3_normalize(fixture_camera(&place).position_m)) + 500;
        const struct camera camera = fixture_camera(&place);
        const struct composed c = fixture_compose_middle(f, &with, &camera);
        double rgb[3] = {desc.default_albedo[0], desc.default_albedo[1], desc.default_albedo[2]};
        assert_true(surface_biomes(&without, vec3_normalize(camera.position_m), rgb));
        for (int k = 0; k < 3; k++) {
            worst = fmax(worst, fabs(c.albedo_water[k] - 255 * sqrt(rgb[k])));
            least[k] = fmin(least[k], rgb[k]);
            most[k] = fmax(most[k], rgb[k]);
        }
    }
    printf("colours %.3f-%.3f, %.3f-%.3f, %.3f-%.3f; at most %.2f of 255 off\n", least[0], most[0],
           least[1], most[1], least[2], most[2], worst);
    // Places differ by biome, and the two by a code and what half a pixel of 3 cm changes.
    for (int k = 0; k < 3; k++) {
        assert_true(most[k] > 2 * least[k]);
    }
    assert_true(worst < 3);
    surface_finish(&with);
    surface_finish(&without);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_range_decides_by_what_it_names),
        cmocka_unit_test(test_later_ones_lie_over_earlier_ones),
        cmocka_unit_test(test_pictures_have_the_cpus_colours),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
