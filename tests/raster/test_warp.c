// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters in other projections than longitude and latitude: known as they are, or warped.
#include "fixture.h"

#include <math.h>

static void rasters_with_the_south_first_are_turned_over(void **state)
{
    struct recipe r = GLOBE;
    r.transform[3] = -90;
    r.transform[5] = 10;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_true(raster.north_deg == 90 && raster.is_whole_circle);
    // Row 0 of the file is the southernmost.
    assert_true(value_in(&raster, -85, -175) == value_at(&r, 0, 0, 0));
    assert_true(value_in(&raster, 85, 175) == value_at(&r, 0, 35, 17));
    raster_finish(&raster);
}

static void metres_of_an_equirectangular_map_are_degrees(void **state)
{
    struct recipe r = GLOBE;
    r.system = "EPSG:32662"; // plate carree; the ellipsoid's larger radius
    const double degree = 6378137 * RADIAN;
    r.transform[0] = -180 * degree;
    r.transform[1] = 10 * degree;
    r.transform[3] = 90 * degree;
    r.transform[5] = -10 * degree;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_null(raster.source); // as it is, not warped
    assert_true(fabs(raster.west_deg + 180) < 1e-9 && fabs(raster.north_deg - 90) < 1e-9);
    assert_true(raster.is_whole_circle && fabs(raster.pixel_width_deg - 10) < 1e-9);
    raster_finish(&raster);
}

// EPSG 3413 and 3031: WGS 84, true to scale at 70 N and 71 S, meridian 45 W straight down; 0 E
// straight up.
static void polar_maps_are_known(void **state)
{
    for (int i = 0; i < 2; i++) {
        struct recipe r = GLOBE;
        r.width = r.height = 20;
        r.system = i == 0 ? "EPSG:3413" : "EPSG:3031";
        r.transform[0] = -1e6;
        r.transform[1] = 1e5;
        r.transform[3] = 1e6;
        r.transform[5] = -1e5;
        struct raster raster;
        open_made(*state, &r, &raster);
        assert_null(raster.source);
        assert_true(raster.plane.pole == (i == 0 ? 1 : -1));
        assert_true(fabs(raster.plane.longitude_deg - (i == 0 ? -45 : 0)) < 1e-9);
        assert_true(fabs(raster.plane.e2 - 0.00669438) < 1e-8);
        assert_true(fabs(raster.plane.left + 10 * raster.plane.pixel_width) < 1e-12);
        // The map is 3 % smaller than the ground at the pole, where an ellipsoid's radius of
        // curvature is 6399594 m. Snyder 1987, Eq. 21-33 to 21-35.
        const double scale = i == 0 ? 0.969858 : 0.972769;
        assert_true(fabs(raster.plane.pixel_width * 6399594 * scale / 1e5 - 1) < 2e-6);
        raster_finish(&raster);
    }
}

// Zone 33, on the 15th meridian: 4 km a pixel, 500 km east of the zone's origin.
static void other_projections_are_warped(void **state)
{
    struct recipe r = GLOBE;
    r.width = 40;
    r.height = 50;
    r.system = "EPSG:32633";
    r.transform[0] = 500000 - 20 * 4000;
    r.transform[1] = 4000;
    r.transform[3] = 5000000;
    r.transform[5] = -4000;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_non_null(raster.source);
    assert_true(raster.plane.pole == 0);
    // 5 000 000 m north is 45.153 N on the middle meridian; its pixels are those of 15 E.
    assert_true(raster.west_deg < 14 && raster.east_deg > 16);
    assert_true(fabs(raster.north_deg - 45.16) < 0.03);
    // 4 km are a step of 100 to the east and 1 to the south.
    assert_true(fabs(value_in(&raster, 44.5, 15.0) - value_at(&r, 0, 20, 18)) < 60);
    assert_true(fabs(value_in(&raster, 44.5, 15.5) - value_at(&r, 0, 30, 18)) < 100);
    // A corner that the warped raster has and the file has not.
    assert_true(raster.has_nodata && raster.type == RASTER_INT16);
    // Another thread's copy is warped too.
    struct raster again;
    assert_int_equal(raster_open_again(&raster, &again), TRL_OK);
    assert_true(value_in(&again, 44.5, 15.2) == value_in(&raster, 44.5, 15.2));
    raster_finish(&again);
    raster_finish(&raster);
}

// Zone 60 ends at the antimeridian: 20 columns of 20 km on either side of it are 8 degrees wide at
// 60 N, in one piece, with pixels as small as the file's.
static void warped_across_the_antimeridian_stays_in_one_piece(void **state)
{
    struct recipe r = GLOBE;
    r.width = r.height = 40;
    r.system = "EPSG:32660";
    r.transform[0] = 667000 - 20 * 20000; // 180 E at 60 N
    r.transform[1] = 20000;
    r.transform[3] = 6.654e6 + 20 * 20000;
    r.transform[5] = -20000;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_non_null(raster.source);
    assert_false(raster.is_whole_circle);
    assert_true(raster.west_deg > 170 && raster.east_deg > 185 && raster.east_deg < 192);
    assert_true(raster.pixel_width_deg < 0.4);
    assert_true(fabs(value_in(&raster, 60, 180) - value_at(&r, 0, 20, 20)) < 110);
    struct raster again;
    assert_int_equal(raster_open_again(&raster, &again), TRL_OK);
    raster_finish(&again);
    raster_finish(&raster);
}

// Where meridians meet it becomes a map about the pole; one around the globe closes.
static void warped_rasters_have_no_hole_at_a_pole_and_no_seam(void **state)
{
    struct recipe r = GLOBE;
    r.width = r.height = 20;
    r.system = "EPSG:3571"; // equal areas about the north pole
    r.transform[0] = -2e6;
    r.transform[1] = 2e5;
    r.transform[3] = 2e6;
    r.transform[5] = -2e5;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_non_null(raster.source);
    assert_true(raster.plane.pole == 1);
    struct raster_window middle = {raster.width / 2, raster.height / 2, 1, 1, 1, 1};
    float value;
    assert_int_equal(raster_read_float(&raster, &middle, 0, &value), TRL_OK);
    assert_true(fabs((double)value - value_at(&r, 0, 10, 10)) < 120);
    raster_finish(&raster);
    r.system = "EPSG:3857"; // Mercator: 20 037 508 m are 180 degrees
    r.transform[0] = -20037508;
    r.transform[1] = 2003750.8;
    r.transform[3] = 20037508;
    r.transform[5] = -2003750.8;
    open_made(*state, &r, &raster);
    assert_true(raster.is_whole_circle && raster.west_deg == -180);
    assert_true(fabs(value_in(&raster, 0.1, -179.9) - value_at(&r, 0, 0, 9)) < 3);
    assert_true(fabs(value_in(&raster, 0.1, 179.9) - value_at(&r, 0, 19, 9)) < 3);
    raster_finish(&raster);
}

// Infrared stays what it is, and corners that the file has not are transparent.
static void warping_keeps_what_bands_are(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.type = GDT_Byte;
    r.bands = 4;
    r.option = "PHOTOMETRIC=MINISBLACK";
    r.width = 40;
    r.height = 50;
    r.system = "EPSG:32633";
    r.transform[0] = 500000 - 20 * 20000;
    r.transform[1] = 20000;
    r.transform[3] = 5000000;
    r.transform[5] = -20000;
    struct raster raster;
    open_made(f, &r, &raster);
    assert_non_null(raster.source);
    assert_false(raster.has_alpha);
    const struct raster_window middle = {raster.width / 2, raster.height / 2, 1, 1, 1, 1};
    const struct raster_window corner = {0, raster.height - 1, 1, 1, 1, 1};
    uint8_t pixel[4];
    assert_int_equal(raster_read_rgba8(&raster, &middle, pixel), TRL_OK);
    assert_int_equal(pixel[3], 255);
    assert_int_equal(raster_read_rgba8(&raster, &corner, pixel), TRL_OK);
    assert_int_equal(pixel[3], 0);
    raster_finish(&raster);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(rasters_with_the_south_first_are_turned_over),
        TEST(metres_of_an_equirectangular_map_are_degrees),
        TEST(polar_maps_are_known),
        TEST(other_projections_are_warped),
        TEST(warped_across_the_antimeridian_stays_in_one_piece),
        TEST(warped_rasters_have_no_hole_at_a_pole_and_no_seam),
        TEST(warping_keeps_what_bands_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
