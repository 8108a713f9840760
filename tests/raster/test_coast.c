// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The bed that tools/prepare makes for insets whose sea is at 0 m: around an island whose heights
// are whole metres, as models of land have them.
#include "fixture.h"

#include "../../tools/prepare/prepare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { SIDE = 120, MARGIN = 10, HOLLOW = 54 };
static const double MIDDLE = 59.5, RADIUS = 40.3, RISE = 30, FLOOR = -60;

static double floor_of(int x, int y)
{
    (void)x;
    (void)y;
    return FLOOR;
}

static double distance(uint32_t x, uint32_t y)
{
    return hypot(x - MIDDLE, y - MIDDLE);
}

// NaN in the margin; a hollow of dry land in the island.
static void make_island(float *metres)
{
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const uint32_t x = i % SIDE, y = i / SIDE;
        const double height = rint(RISE * (RADIUS - distance(x, y)));
        const bool is_margin = x < MARGIN || y < MARGIN || x >= SIDE - MARGIN || y >= SIDE - MARGIN;
        metres[i] = is_margin ? NAN : (float)fmax(height, 0);
    }
    metres[HOLLOW * SIDE + HOLLOW] = -2;
}

// Along a ray from the middle, where heights between cells fall to a level.
static double find_shore(const float *metres, double azimuth, double level)
{
    for (double r = RADIUS - 4;; r += 0.005) {
        const double x = MIDDLE + r * cos(azimuth), y = MIDDLE + r * sin(azimuth);
        const float *at = metres + (size_t)y * SIDE + (size_t)x;
        const double fx = x - floor(x), fy = y - floor(y);
        const double h = (1 - fy) * ((1 - fx) * (double)at[0] + fx * (double)at[1]) +
                         fy * ((1 - fx) * (double)at[SIDE] + fx * (double)at[SIDE + 1]);
        if (h < level || r > RADIUS + 4) {
            return r;
        }
    }
}

// Deviation of the shore from a circle, in cells.
static double find_steps(const float *metres, double level)
{
    enum { RAYS = 720 };
    double sum = 0, squares = 0;
    for (int k = 0; k < RAYS; k++) {
        const double r = find_shore(metres, 2 * 3.14159265358979 * k / RAYS, level);
        sum += r;
        squares += r * r;
    }
    return sqrt(squares / RAYS - sum / RAYS * sum / RAYS);
}

static void a_shore_goes_on_below_the_sea(void **state)
{
    struct fixture *f = *state;
    const struct recipe globe = {.name = "elevation.tif",
                                 .width = 360,
                                 .height = 180,
                                 .bands = 1,
                                 .type = GDT_Int16,
                                 .transform = {-180, 1, 0, 90, 0, -1},
                                 .system = "EPSG:4326",
                                 .value = floor_of};
    make_file(f, &globe);
    static float file[SIDE * SIDE], metres[SIDE * SIDE];
    make_island(file);
    memcpy(metres, file, sizeof file);
    const struct places places = {f->ctx, f->folder, f->folder};
    const struct inset_grid grid = {SIDE, SIDE, 10, 40, 1.0 / 1200, metres};
    assert_int_equal(coast_make_bed(&places, &grid), TRL_OK);
    for (uint32_t i = 0; i < SIDE * SIDE; i++) {
        const double from = distance(i % SIDE, i / SIDE);
        if (!isfinite(file[i]) || from > RADIUS + 12) {
            assert_float_equal(metres[i], FLOOR, 1e-3);
        } else if (file[i] > 0) {
            assert_true(metres[i] > 0);
            assert_float_equal(metres[i], file[i], 0.5);
        } else if (from > RADIUS) {
            assert_true(metres[i] < 0);
        }
    }
    assert_true(metres[HOLLOW * SIDE + HOLLOW] > 0);
    const double before = find_steps(file, 0.3), after = find_steps(metres, 0);
    print_message("shore off a circle by %.3f cells, by the file's heights %.3f\n", after, before);
    assert_true(after < 0.08 && before > 0.2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(a_shore_goes_on_below_the_sea)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
