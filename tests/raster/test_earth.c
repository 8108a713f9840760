// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The prepared rasters of Earth at places that are known. Skips when they have not been made (`make
// data`).
#include "raster/grid.h"

// cmocka wants these before its own header
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <unistd.h>

static const double RADIAN = 3.14159265358979323846 / 180;
enum { EXIT_SKIP = 77 };

struct earth {
    trl_context *ctx;
    struct raster_grid elevation, water, snow, colorado;
    bool has_lakes; // only the mask from npm shows inland waters (docs/data.md)
};

static void load(trl_context *ctx, const char *name, struct raster_grid *out)
{
    char *path = mem_printf(ctx, "%s/earth/%s", trl_context_data_dir(ctx), name);
    assert_non_null(path);
    struct raster raster;
    assert_int_equal(raster_open(ctx, path, &raster), TRL_OK);
    assert_int_equal(raster_grid_load(&raster, 0, 0, out), TRL_OK);
    raster_finish(&raster);
    mem_free(ctx, path);
}

static int set_up(void **state)
{
    static struct earth earth;
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    if (trl_context_create(&desc, &earth.ctx) != TRL_OK) {
        return -1;
    }
    load(earth.ctx, "elevation.tif", &earth.elevation);
    load(earth.ctx, "water.tif", &earth.water);
    load(earth.ctx, "snow.tif", &earth.snow);
    load(earth.ctx, "colorado.tif", &earth.colorado);
    char *mask = mem_printf(earth.ctx, "%s/packages/three-globe@2.45.2.tgz",
                            trl_context_data_dir(earth.ctx));
    earth.has_lakes = mask && access(mask, R_OK) == 0;
    mem_free(earth.ctx, mask);
    *state = &earth;
    return 0;
}

static int tear_down(void **state)
{
    struct earth *earth = *state;
    raster_grid_finish(&earth->elevation);
    raster_grid_finish(&earth->water);
    raster_grid_finish(&earth->snow);
    raster_grid_finish(&earth->colorado);
    trl_context_destroy(&earth->ctx);
    return 0;
}

static double value_at(const struct raster_grid *grid, double lat_deg, double lon_deg)
{
    const struct raster_sample s = raster_grid_sample(grid, lat_deg * RADIAN, lon_deg * RADIAN);
    assert_true(s.is_valid);
    return s.value;
}

struct place {
    const char *name;
    double lat_deg, lon_deg;
    double min_m, max_m;
    enum { DRY, SEA, LAKE } water;
};

// Bounds are published heights of broad, even places, plus and minus what docs/data.md states for
// the source: 30 m in lowlands, 8 % above, and 10 % at sea, where ETOPO5 is older than modern
// soundings.
static const struct place PLACES[] = {{"Tibetan plateau", 33.5, 88, 4600, 5300, DRY},
                                      {"Altiplano", -18, -68, 3500, 4100, DRY},
                                      {"Denver", 39.74, -104.95, 1450, 1750, DRY},
                                      {"Ganges plain", 27, 80, 60, 180, DRY},
                                      {"Amazon, Manaus", -2.8, -60.2, 0, 150, DRY},
                                      {"Netherlands, Utrecht", 52.1, 5.1, 0, 40, DRY},
                                      {"Berlin", 52.5, 13.4, 5, 80, DRY},
                                      {"Caspian Sea", 42, 51, -40, 40, LAKE},
                                      {"Black Sea", 43, 34, -2420, -1980, SEA},
                                      {"North Sea", 56, 3, -90, -40, SEA},
                                      {"Bay of Biscay", 45.5, -7, -5300, -4300, SEA},
                                      {"Hawaiian abyss", 25, -150, -5900, -4700, SEA},
                                      {"Challenger deep, nearby", 11.35, 142.2, -11000, -7000, SEA},
                                      {"Ross ice shelf", -81, -175, 0, 100, DRY},
                                      {"Antarctic plateau", -80, 90, 3300, 4200, DRY},
                                      {"Greenland ice", 72, -40, 2700, 3400, DRY},
                                      {"Dead Sea", 31.5, 35.48, -700, -100, LAKE},
                                      {"Lake Victoria", -1, 33, 1050, 1250, LAKE}};

static void known_places_have_their_height(void **state)
{
    const struct earth *earth = *state;
    for (size_t i = 0; i < sizeof PLACES / sizeof PLACES[0]; i++) {
        const struct place *p = &PLACES[i];
        const double metres = value_at(&earth->elevation, p->lat_deg, p->lon_deg);
        const double water = value_at(&earth->water, p->lat_deg, p->lon_deg);
        print_message("%-26s %8.1f m, water %3.0f\n", p->name, metres, water);
        assert_true(metres >= p->min_m && metres <= p->max_m);
        if (p->water != LAKE || earth->has_lakes) {
            assert_true(p->water != DRY ? water > 128 : water < 128);
        }
    }
}

// Ocean lies below zero and what is beside it above, so that a sea at height zero meets the coast.
static void the_coast_is_where_the_height_is_zero(void **state)
{
    const struct earth *earth = *state;
    const struct raster_grid *heights = &earth->elevation;
    const size_t count = (size_t)heights->width * heights->height;
    size_t negative_land = 0;
    for (size_t i = 0; i < count; i++) {
        const bool is_water = earth->water.values[i] > 0;
        negative_land += !is_water && heights->values[i] <= 0;
    }
    // Land that is truly far below the sea (the shores of the Dead Sea, Death Valley, the Danakil
    // desert) is less than one part in ten thousand of the globe.
    print_message("%zu of %zu cells are dry and below the sea\n", negative_land, count);
    assert_true(negative_land < count / 10000);
}

// A terrace ends with a jump. On the even slope of the high plains a step of the source's grey is
// 18 to 55 m, and 31 % of its neighbours differ by one or more; undone, few differ by as much as
// the smallest.
static void slopes_have_no_terraces(void **state)
{
    const struct earth *earth = *state;
    size_t jumps = 0;
    size_t cells = 0;
    for (double lat = 39; lat < 41; lat += 1.0 / 30) {
        double before = value_at(&earth->elevation, lat, -103);
        for (double lon = -103; lon < -99; lon += 1.0 / 30) {
            const double metres = value_at(&earth->elevation, lat, lon);
            jumps += fabs(metres - before) > 18;
            cells++;
            before = metres;
        }
    }
    print_message("%zu jumps in %zu cells\n", jumps, cells);
    assert_true(jumps * 30 < cells); // real breaks of the land, such as river bluffs, remain
}

// Ice and high mountains, not deserts, their grey coasts, or the sea.
static void snow_lies_where_it_is_known(void **state)
{
    const struct earth *earth = *state;
    const struct raster_grid *snow = &earth->snow;
    assert_true(value_at(snow, 72, -40) > 250 && value_at(snow, -80, 90) > 220);
    static const double BARE[][2] = {{23, 12},   {-25, 133}, {27.3, 35.6}, {-23, 14.5},
                                     {20, 38.3}, {-3, -62},  {50, -30},    {26, 82}};
    for (size_t i = 0; i < sizeof BARE / sizeof *BARE; i++) {
        assert_true(value_at(snow, BARE[i][0], BARE[i][1]) == 0);
    }
    double sums[2] = {0}, counts[2] = {0}; // of the ground about Everest below and above 5500 m
    for (double lat = 27.5; lat < 28.4; lat += 0.05) {
        for (double lon = 86.2; lon < 87.5; lon += 0.05) {
            const bool is_high = value_at(&earth->elevation, lat, lon) > 5500;
            sums[is_high] += value_at(snow, lat, lon) / 255;
            counts[is_high]++;
        }
    }
    print_message("snow below 5500 m %.3f, above %.3f\n", sums[0] / counts[0], sums[1] / counts[1]);
    assert_true(sums[1] / counts[1] > 3 * sums[0] / counts[0]);
}

static void the_inset_is_where_it_should_be(void **state)
{
    const struct earth *earth = *state;
    // Blanca Peak, 4374 m, and West Spanish Peak, 4155 m; a 3-second grid cuts peaks by tens of
    // metres.
    assert_true(value_at(&earth->colorado, 37.5775, -105.4856) > 4170);
    assert_true(value_at(&earth->colorado, 37.3756, -104.9934) > 4030);
    // San Luis Valley at Alamosa, 2300 m; the river's meadows are some 15 m lower.
    assert_float_equal(value_at(&earth->colorado, 37.47, -105.87), 2300, 25);
    // Both maps agree about an even place between them within the 8 % of the globe.
    print_message("%.0f m\n", value_at(&earth->elevation, 37.7, -105.9));
    const double inset = value_at(&earth->colorado, 37.7, -105.9);
    assert_true(fabs(value_at(&earth->elevation, 37.7, -105.9) - inset) < 0.08 * inset);
}

int main(void)
{
    trl_context_desc desc = trl_context_desc_default();
    trl_context *ctx = NULL;
    if (trl_context_create(&desc, &ctx) != TRL_OK) {
        return 1;
    }
    char *path = mem_printf(ctx, "%s/earth/stamp", trl_context_data_dir(ctx));
    const bool is_there = path && access(path, R_OK) == 0;
    mem_free(ctx, path);
    trl_context_destroy(&ctx);
    if (!is_there) {
        printf("skipped: the rasters of Earth are not there; `make data` makes them\n");
        return EXIT_SKIP;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_places_have_their_height),
        cmocka_unit_test(the_coast_is_where_the_height_is_zero),
        cmocka_unit_test(slopes_have_no_terraces),
        cmocka_unit_test(snow_lies_where_it_is_known),
        cmocka_unit_test(the_inset_is_where_it_should_be),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
