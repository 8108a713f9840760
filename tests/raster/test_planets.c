// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The prepared rasters of other bodies than Earth at places that are known. A body whose rasters
// have not been made (`make data`) is passed over: only Earth's are needed for the tests.
#include "raster/grid.h"

// cmocka wants these before its own header
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdio.h>
#include <unistd.h>

static const double RADIAN = 3.14159265358979323846 / 180;

struct place {
    const char *name;
    double lat_deg, lon_deg;
    double min_m, max_m;
};

// Published heights of broad places, with room for what a cell of 7 to 15 km averages.
static const struct place MARS[] = {
    {"Olympus Mons, beside the caldera", 18.4, -134.4, 18500, 21500},
    {"Hellas", -42.7, 66, -8100, -6500},
    {"Gale crater, floor", -4.6, 137.4, -4700, -4200},
    {"Gale crater, central mound", -5.1, 137.9, -1500, 1200},
    {"Gusev crater", -14.57, 175.47, -2050, -1800},
    {"Vallis Marineris, Melas Chasma", -10.5, -72.5, -5000, -3000},
    {"Meridiani Planum", -1.95, -5.53, -1550, -1300},
    {"North pole", 88, 0, -2900, -2200}};
static const struct place MOON[] = {{"Tranquillity Base", 0.67, 23.47, -2100, -1700},
                                    {"South Pole-Aitken basin", -53, -169, -7000, -3500},
                                    {"Highest point", 5.4, -158.6, 8500, 10900},
                                    {"Mare Imbrium", 33, -16, -2900, -2200}};
static const struct place VENUS[] = {{"Maxwell Montes", 65.2, 3.3, 8500, 11500},
                                     {"Lakshmi Planum", 68, -25, 2000, 5000},
                                     {"Maat Mons", 0.5, -165.4, 4500, 9000},
                                     {"Atalanta Planitia", 65, 165, -2500, -800}};

static void check_body(const char *body, const struct place *places, size_t count)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    char *path = mem_printf(ctx, "%s/%s/elevation.tif", trl_context_data_dir(ctx), body);
    assert_non_null(path);
    if (access(path, R_OK) == 0) {
        struct raster raster;
        struct raster_grid grid;
        assert_int_equal(raster_open(ctx, path, &raster), TRL_OK);
        assert_int_equal(raster_grid_load(&raster, 0, 0, &grid), TRL_OK);
        for (size_t i = 0; i < count; i++) {
            const struct raster_sample s =
                raster_grid_sample(&grid, places[i].lat_deg * RADIAN, places[i].lon_deg * RADIAN);
            print_message("%-34s %8.1f m\n", places[i].name, s.value);
            assert_true(s.is_valid && s.value >= places[i].min_m && s.value <= places[i].max_m);
        }
        raster_grid_finish(&grid);
        raster_finish(&raster);
    }
    mem_free(ctx, path);
    trl_context_destroy(&ctx);
}

#define CHECK(body, places) check_body((body), (places), sizeof(places) / sizeof((places)[0]))

// The pole is the middle of a map about it, and has the height that the globe has there.
static void check_pole(const char *name, double pole, double min_m, double max_m)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    char *path = mem_printf(ctx, "%s/%s", trl_context_data_dir(ctx), name);
    assert_non_null(path);
    if (access(path, R_OK) == 0) {
        struct raster raster;
        assert_int_equal(raster_open(ctx, path, &raster), TRL_OK);
        assert_true(raster.plane.pole == pole);
        assert_true(raster.plane.left + raster.width * raster.plane.pixel_width / 2 < 1e-9);
        const struct raster_window middle = {raster.width / 2, raster.height / 2, 1, 1, 1, 1};
        float metres;
        assert_int_equal(raster_read_float(&raster, &middle, 0, &metres), TRL_OK);
        print_message("%-34s %8.1f m\n", name, (double)metres);
        assert_true((double)metres >= min_m && (double)metres <= max_m);
        raster_finish(&raster);
    }
    mem_free(ctx, path);
    trl_context_destroy(&ctx);
}

// Earth's south pole lies on ice 2835 m above the sea, the sea floor at its north
// pole is 4000 to 4300 m deep. Mars' caps are 2000 m below and 3850 m above the areoid there.
static void poles_have_their_height(void **state)
{
    (void)state;
    check_pole("earth/elevation-north.tif", 1, -4600, -3500);
    check_pole("earth/elevation-south.tif", -1, 2600, 3000);
    check_pole("mars/elevation-north.tif", 1, -2300, -1700);
    check_pole("mars/elevation-south.tif", -1, 3500, 4300);
}

static void known_places_have_their_height(void **state)
{
    (void)state;
    CHECK("mars", MARS);
    CHECK("moon", MOON);
    CHECK("venus", VENUS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(known_places_have_their_height),
                                       cmocka_unit_test(poles_have_their_height)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
