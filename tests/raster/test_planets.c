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
        assert_int_equal(raster_grid_load(&raster, 0, &grid), TRL_OK);
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

static void known_places_have_their_height(void **state)
{
    (void)state;
    CHECK("mars", MARS);
    CHECK("moon", MOON);
    CHECK("venus", VENUS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(known_places_have_their_height)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
