// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters from files that the tests make with GDAL: georeference, windows, overviews, missing data,
// colours.
#include "fixture.h"

#include <math.h>
#include <string.h>

static void facts_of_a_globe_are_read(void **state)
{
    struct raster raster;
    open_made(*state, &GLOBE, &raster);
    assert_int_equal(raster.width, 36);
    assert_int_equal(raster.height, 18);
    assert_int_equal(raster.band_count, 1);
    assert_int_equal(raster.type, RASTER_INT16);
    assert_true(raster.west_deg == -180 && raster.east_deg == 180);
    assert_true(raster.south_deg == -90 && raster.north_deg == 90);
    assert_true(raster.is_whole_circle);
    assert_false(raster.has_nodata);
    raster_finish(&raster);
}

static void a_globe_without_georeference_is_taken_for_one(void **state)
{
    struct recipe r = GLOBE;
    r.transform[1] = 0;
    r.system = NULL;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_true(raster.west_deg == -180 && raster.pixel_height_deg == 10);
    assert_true(raster.is_whole_circle);
    raster_finish(&raster);
    r.width = 35;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "no georeference");
}

static void a_left_edge_at_0_east_stays_there(void **state)
{
    struct recipe r = GLOBE;
    r.transform[0] = 0;
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_true(raster.west_deg == 0 && raster.east_deg == 360);
    raster_finish(&raster);
    r.transform[0] = 190; // the same place as 170 W
    r.width = 4;
    open_made(*state, &r, &raster);
    assert_true(raster.west_deg == -170 && raster.east_deg == -130);
    assert_false(raster.is_whole_circle);
    raster_finish(&raster);
}

static void windows_give_their_pixels(void **state)
{
    struct fixture *f = *state;
    struct raster raster;
    open_made(f, &GLOBE, &raster);
    const struct raster_window window = {5, 3, 4, 2, 4, 2};
    float values[8];
    int16_t integers[8];
    assert_int_equal(raster_read_float(&raster, &window, 0, values), TRL_OK);
    assert_int_equal(raster_read_int16(&raster, &window, 0, integers), TRL_OK);
    for (int i = 0; i < 8; i++) {
        const double expected = value_at(&GLOBE, 0, 5 + i % 4, 3 + i / 4);
        assert_true((double)values[i] == expected);
        assert_true(integers[i] == expected);
    }
    raster_finish(&raster);
}

static void windows_outside_are_refused(void **state)
{
    struct fixture *f = *state;
    struct raster raster;
    open_made(f, &GLOBE, &raster);
    const struct raster_window wrong[] = {
        {36, 0, 1, 1, 1, 1}, {0, 18, 1, 1, 1, 1}, {35, 0, 2, 1, 2, 1},        {0, 0, 0, 1, 1, 1},
        {0, 0, 4, 4, 0, 4},  {0, 0, 4, 4, 5, 4},  {1, 0, UINT32_MAX, 1, 1, 1}};
    float values[64];
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        f->errors = 0;
        assert_int_equal(raster_read_float(&raster, &wrong[i], 0, values), TRL_ERROR_INVALID);
        assert_int_equal(f->errors, 1);
    }
    const struct raster_window right = {0, 0, 1, 1, 1, 1};
    assert_int_equal(raster_read_float(&raster, &right, 1, values), TRL_ERROR_INVALID);
    uint8_t pixel[4];
    assert_int_equal(raster_read_rgba8(&raster, &right, pixel), TRL_ERROR_INVALID); // int16
    assert_int_equal(raster_read_uint8(&raster, &right, 0, pixel), TRL_ERROR_INVALID);
    raster_finish(&raster);
}

// 2 x 2 means of the linear ramp of value_at are exact; the whole read at half size gives them
// whether the file has overviews or not.
static void half_size_averages(void **state)
{
    struct recipe r = GLOBE;
    r.type = GDT_Float32;
    for (int pass = 0; pass < 2; pass++) {
        r.has_overviews = pass == 1;
        struct raster raster;
        open_made(*state, &r, &raster);
        const struct raster_window window = raster_window_whole(&raster, 18);
        assert_int_equal(window.out_width, 18);
        assert_int_equal(window.out_height, 9);
        float values[18 * 9];
        assert_int_equal(raster_read_float(&raster, &window, 0, values), TRL_OK);
        for (int y = 0; y < 9; y++) {
            for (int x = 0; x < 18; x++) {
                const double mean = value_at(&r, 0, 2 * x, 2 * y) + 50.5;
                // floats of that size have steps of 2.4e-4
                assert_float_equal(values[y * 18 + x], (float)mean, 1e-3f);
            }
        }
        raster_finish(&raster);
    }
}

static void missing_data_become_nan(void **state)
{
    struct recipe r = GLOBE;
    r.has_nodata = true;
    r.nodata = value_at(&r, 0, 7, 4);
    struct raster raster;
    open_made(*state, &r, &raster);
    assert_true(raster.has_nodata && raster.nodata == r.nodata);
    const struct raster_window window = {6, 4, 3, 1, 3, 1};
    float values[3];
    assert_int_equal(raster_read_float(&raster, &window, 0, values), TRL_OK);
    assert_false(isnan(values[0]) || isnan(values[2]));
    assert_true(isnan(values[1]));
    raster_finish(&raster);
}

static void colours_come_as_rgba(void **state)
{
    struct recipe r = GLOBE;
    r.type = GDT_Byte;
    for (int bands = 1; bands <= 4; bands++) {
        r.bands = bands;
        r.option = bands % 2 == 0 ? "ALPHA=YES" : NULL;
        struct raster raster;
        open_made(*state, &r, &raster);
        const struct raster_window window = {2, 1, 2, 2, 2, 2};
        uint8_t pixels[16];
        assert_int_equal(raster_read_rgba8(&raster, &window, pixels), TRL_OK);
        for (int i = 0; i < 16; i++) {
            const int channel = i % 4;
            const bool is_alpha = channel == 3;
            const int band = is_alpha ? bands - 1 : bands < 3 ? 0 : channel;
            const double expected =
                is_alpha && bands % 2 == 1 ? 255 : value_at(&r, band, 2 + i / 4 % 2, 1 + i / 8);
            assert_int_equal(pixels[i], (int)expected);
        }
        raster_finish(&raster);
    }
}

static void expect_colours(struct fixture *f, const char *path, const int bands[3])
{
    struct recipe r = GLOBE;
    r.type = GDT_Byte;
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, path, &raster), TRL_OK);
    assert_false(raster.has_alpha);
    const struct raster_window one = {4, 9, 1, 1, 1, 1};
    uint8_t pixel[4];
    assert_int_equal(raster_read_rgba8(&raster, &one, pixel), TRL_OK);
    for (int c = 0; c < 3; c++) {
        assert_int_equal(pixel[c], (int)value_at(&r, bands[c], 4, 9));
    }
    assert_int_equal(pixel[3], 255);
    raster_finish(&raster);
}

// A further band may be infrared, and bands may come in any order: they say what they are.
static void only_what_says_so_is_alpha(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.type = GDT_Byte;
    r.bands = 4;
    r.option = "PHOTOMETRIC=MINISBLACK";
    const char *path = make_file(f, &r);
    expect_colours(f, path, (const int[3]){0, 1, 2});
    const GDALDatasetH made = GDALOpen(path, GA_Update);
    static const GDALColorInterp NAMES[4] = {GCI_BlueBand, GCI_GreenBand, GCI_RedBand,
                                             GCI_Undefined};
    for (int band = 0; band < 4; band++) {
        assert_int_equal(
            GDALSetRasterColorInterpretation(GDALGetRasterBand(made, band + 1), NAMES[band]),
            CE_None);
    }
    GDALClose(made);
    expect_colours(f, path, (const int[3]){2, 1, 0});
    r.bands = 2;
    expect_colours(f, make_file(f, &r), (const int[3]){0, 0, 0});
}

// Pixels 0 to 3 as red, green, blue, and a colour that is no data.
static void numbers_of_colours_come_as_colours(void **state)
{
    struct fixture *f = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/palette.tif", f->folder);
    const GDALDatasetH made =
        GDALCreate(GDALGetDriverByName("GTiff"), path, 4, 2, 1, GDT_Byte, NULL);
    const GDALRasterBandH band = GDALGetRasterBand(made, 1);
    const GDALColorTableH table = GDALCreateColorTable(GPI_RGB);
    for (int i = 0; i < 4; i++) {
        const GDALColorEntry entry = {i == 0 ? 200 : 9, i == 1 ? 150 : 9, i == 2 ? 100 : 9, 255};
        GDALSetColorEntry(table, i, &entry);
    }
    assert_int_equal(GDALSetRasterColorTable(band, table), CE_None);
    GDALDestroyColorTable(table);
    GDALSetRasterNoDataValue(band, 3);
    uint8_t numbers[8] = {0, 1, 2, 3, 3, 2, 1, 0};
    assert_int_equal(GDALRasterIO(band, GF_Write, 0, 0, 4, 2, numbers, 4, 2, GDT_Byte, 0, 0),
                     CE_None);
    GDALClose(made);
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, path, &raster), TRL_OK);
    assert_false(raster.has_alpha); // holes are not the file's own shape of borders
    const struct raster_window row = {0, 0, 4, 1, 4, 1};
    uint8_t rgba[16];
    assert_int_equal(raster_read_rgba8(&raster, &row, rgba), TRL_OK);
    const uint8_t expected[12] = {200, 9, 9, 255, 9, 150, 9, 255, 9, 9, 100, 255};
    assert_memory_equal(rgba, expected, sizeof expected);
    assert_int_equal(rgba[15], 0);
    raster_finish(&raster);
}

// Column 1 of 4 is masked in the file, not by a value.
static void masks_of_files_leave_pixels_out(void **state)
{
    struct recipe r = GLOBE;
    for (int i = 0; i < 2; i++) {
        r.type = i == 0 ? GDT_Int16 : GDT_Byte;
        r.bands = i == 0 ? 1 : 3;
        const char *path = make_file(*state, &r);
        const GDALDatasetH made = GDALOpen(path, GA_Update);
        assert_int_equal(GDALCreateDatasetMaskBand(made, GMF_PER_DATASET), CE_None);
        uint8_t mask[36 * 18];
        for (int k = 0; k < 36 * 18; k++) {
            mask[k] = k % 4 == 1 ? 0 : 255;
        }
        assert_int_equal(GDALRasterIO(GDALGetMaskBand(GDALGetRasterBand(made, 1)), GF_Write, 0, 0,
                                      36, 18, mask, 36, 18, GDT_Byte, 0, 0),
                         CE_None);
        GDALClose(made);
        struct raster raster;
        assert_int_equal(raster_open(((struct fixture *)*state)->ctx, path, &raster), TRL_OK);
        const struct raster_window two = {0, 5, 2, 1, 2, 1};
        float heights[2];
        uint8_t rgba[8];
        if (i == 0) {
            assert_int_equal(raster_read_float(&raster, &two, 0, heights), TRL_OK);
            assert_true((double)heights[0] == value_at(&r, 0, 0, 5) && isnan(heights[1]));
        } else {
            assert_int_equal(raster_read_rgba8(&raster, &two, rgba), TRL_OK);
            assert_true(rgba[3] == 255 && rgba[7] == 0 && rgba[1] == value_at(&r, 1, 0, 5));
        }
        assert_true(raster.type == (i == 0 ? RASTER_FLOAT : RASTER_UINT8));
        raster_finish(&raster);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(facts_of_a_globe_are_read),
        TEST(a_globe_without_georeference_is_taken_for_one),
        TEST(a_left_edge_at_0_east_stays_there),
        TEST(windows_give_their_pixels),
        TEST(windows_outside_are_refused),
        TEST(half_size_averages),
        TEST(missing_data_become_nan),
        TEST(colours_come_as_rgba),
        TEST(only_what_says_so_is_alpha),
        TEST(numbers_of_colours_come_as_colours),
        TEST(masks_of_files_leave_pixels_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
