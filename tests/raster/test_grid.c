// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Grids of one band, sampled anywhere on the sphere.
#include "fixture.h"
#include "raster/grid.h"

#include <math.h>

static void load_grid(struct fixture *f, const struct recipe *r, struct raster_grid *grid)
{
    struct raster raster;
    open_made(f, r, &raster);
    assert_int_equal(raster_grid_load(&raster, 0, 0, grid), TRL_OK);
    raster_finish(&raster);
}

static void expect_sample(const struct raster_grid *grid, double lat_deg, double lon_deg,
                          double value)
{
    const struct raster_sample s = raster_grid_sample(grid, lat_deg * RADIAN, lon_deg * RADIAN);
    assert_true(s.is_valid);
    // radians and back cost a few units in the last place of coordinates up to 720 degrees
    assert_true(fabs(s.value - value) < 1e-9);
}

static void samples_are_bilinear_between_centres(void **state)
{
    struct raster_grid grid;
    load_grid(*state, &GLOBE, &grid);
    expect_sample(&grid, 85, -175, value_at(&GLOBE, 0, 0, 0));
    expect_sample(&grid, 85, -170, 50);
    expect_sample(&grid, 80, -175, 0.5);
    expect_sample(&grid, 45, 5, value_at(&GLOBE, 0, 18, 4));
    expect_sample(&grid, 45, 5 + 720, value_at(&GLOBE, 0, 18, 4));
    const struct raster_sample s = raster_grid_sample(&grid, 41 * RADIAN, 8 * RADIAN);
    // 100 a column and 1 a row of 10 degrees
    assert_true(fabs(s.per_longitude_rad - 100 / (10 * RADIAN)) < 1e-9);
    assert_true(fabs(s.per_latitude_rad + 1 / (10 * RADIAN)) < 1e-9);
    raster_grid_finish(&grid);
}

static void the_antimeridian_joins(void **state)
{
    struct raster_grid grid;
    load_grid(*state, &GLOBE, &grid);
    const double middle = (value_at(&GLOBE, 0, 0, 8) + value_at(&GLOBE, 0, 35, 8)) / 2;
    expect_sample(&grid, 5, 180, middle);
    expect_sample(&grid, 5, -180, middle);
    expect_sample(&grid, 5, 177.5, 0.75 * 3508 + 0.25 * 8);
    raster_grid_finish(&grid);
}

// At the pole every longitude must give one value per meridian plane: the mean of the two columns
// that face each other there.
static void poles_join_opposite_meridians(void **state)
{
    struct raster_grid grid;
    load_grid(*state, &GLOBE, &grid);
    for (int column = 0; column < 18; column++) {
        const double lon = -175 + 10.0 * column;
        const double north =
            (value_at(&GLOBE, 0, column, 0) + value_at(&GLOBE, 0, column + 18, 0)) / 2;
        expect_sample(&grid, 90, lon, north);
        expect_sample(&grid, 90, lon + 180, north);
        expect_sample(&grid, -90, lon, north + 17);
    }
    raster_grid_finish(&grid);
}

static void outside_an_inset_there_is_nothing(void **state)
{
    struct recipe r = GLOBE;
    r.width = 4;
    r.height = 2;
    r.transform[0] = 170; // across the antimeridian, to 150 W
    r.transform[3] = 50;
    struct raster_grid grid;
    load_grid(*state, &r, &grid);
    expect_sample(&grid, 45, 175, 0);
    expect_sample(&grid, 45, -155, 300);
    expect_sample(&grid, 50, 170, 0); // the border belongs to it, and holds its value
    assert_false(raster_grid_sample(&grid, 45 * RADIAN, 169 * RADIAN).is_valid);
    assert_false(raster_grid_sample(&grid, 45 * RADIAN, -149 * RADIAN).is_valid);
    assert_false(raster_grid_sample(&grid, 51 * RADIAN, 175 * RADIAN).is_valid);
    assert_false(raster_grid_sample(&grid, 29 * RADIAN, 175 * RADIAN).is_valid);
    assert_false(raster_grid_sample(&grid, NAN, 175 * RADIAN).is_valid);
    raster_grid_finish(&grid);
}

static void holes_take_their_neighbours_mean(void **state)
{
    struct recipe r = GLOBE;
    r.has_nodata = true;
    r.nodata = value_at(&r, 0, 7, 4);
    struct raster_grid grid;
    load_grid(*state, &r, &grid);
    // Between the hole's centre and its north-west neighbours: the mean of the three that are
    // there.
    expect_sample(&grid, 50, -110, (603 + 703 + 604) / 4.0 + (603 + 703 + 604) / 12.0);
    float min;
    float max;
    raster_grid_range(&grid, &min, &max);
    assert_true(min == 0 && max == 3517);
    raster_grid_finish(&grid);
}

// Each allocation in turn fails: the call says so and leaves nothing behind (the sanitised build
// looks for leaks).
static void every_failed_allocation_is_told(void **state)
{
    struct fixture *f = *state;
    const char *path = make_file(f, &GLOBE);
    int left = 100;
    trl_context *ctx = make_counting_context(&left);
    trl_result result = TRL_ERROR_MEMORY;
    int allowed = 0;
    for (; result != TRL_OK && allowed < 10; allowed++) {
        left = allowed;
        struct raster raster;
        struct raster_grid grid = {0};
        result = raster_open(ctx, path, &raster);
        if (result == TRL_OK) {
            result = raster_grid_load(&raster, 0, 0, &grid);
        }
        assert_true(result == TRL_OK || (result == TRL_ERROR_MEMORY && !grid.values));
        raster_grid_finish(&grid);
        raster_finish(&raster);
    }
    assert_int_equal(allowed, 3); // path and values: fails with 0 and 1, goes through with 2
    trl_context_destroy(&ctx);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(samples_are_bilinear_between_centres), TEST(the_antimeridian_joins),
        TEST(poles_join_opposite_meridians),        TEST(outside_an_inset_there_is_nothing),
        TEST(holes_take_their_neighbours_mean),     TEST(every_failed_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
