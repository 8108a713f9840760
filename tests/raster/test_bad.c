// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters that are no good: each is refused with one line that names it and tells what to do, and
// none crashes.
#include "fixture.h"

#include <cpl_string.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void wrong_georeferences_are_refused(void **state)
{
    struct recipe r = GLOBE;
    r.transform[2] = 1; // turned, in nothing that is known
    r.system = NULL;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "turned");
    r = GLOBE;
    r.transform[5] = 0;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "no area");
    r = GLOBE;
    r.transform[1] = 11; // 396 degrees round
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "outside the globe");
    r = GLOBE;
    r.transform[3] = 100; // beyond the pole
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "outside the globe");
    r = GLOBE;
    r.transform[0] = NAN;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "not finite");
    r = GLOBE;
    r.system = "EPSG:32633"; // UTM, far from where it holds
    r.transform[0] = 1e9;
    r.transform[1] = 1e8;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "cannot be turned into");
}

static void files_that_are_no_rasters_are_refused(void **state)
{
    struct fixture *f = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/none.tif", f->folder);
    expect_refused(f, path, TRL_ERROR_IO, "No such file");
    expect_refused(f, f->folder, TRL_ERROR_IO, "not a file");
    FILE *file = fopen(path, "w");
    fclose(file);
    expect_refused(f, path, TRL_ERROR_INVALID, "empty");
    file = fopen(path, "w");
    fputs("height,of,land\n1,2,3\n", file);
    fclose(file);
    expect_refused(f, path, TRL_ERROR_INVALID, "");
}

static void nothing_but_local_files_is_opened(void **state)
{
    struct fixture *f = *state;
    expect_refused(f, "/vsicurl/http://example.org/a.tif", TRL_ERROR_INVALID, "local files");
    expect_refused(f, "https://example.org/a.tif", TRL_ERROR_INVALID, "local files");
    expect_refused(f, "/vsimem/a.tif", TRL_ERROR_INVALID, "local files");
    expect_refused(f, "WMS:a", TRL_ERROR_IO, "No such file");
    // A local file that points elsewhere.
    char path[128];
    snprintf(path, sizeof path, "%s/elsewhere.vrt", f->folder);
    FILE *file = fopen(path, "w");
    fputs("<VRTDataset rasterXSize=\"4\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Byte\" "
          "band=\"1\"/></VRTDataset>",
          file);
    fclose(file);
    expect_refused(f, path, TRL_ERROR_INVALID, "");
}

static void complex_pixels_are_refused(void **state)
{
    struct recipe r = GLOBE;
    r.type = GDT_CFloat32;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "complex");
}

static void oversized_rasters_are_refused(void **state)
{
    // One row, so that the file stays small; sparse, so that no pixel of it is written.
    struct fixture *f = *state;
    char path[128];
    snprintf(path, sizeof path, "%s/wide.tif", f->folder);
    char **options = CSLAddString(NULL, "SPARSE_OK=TRUE");
    GDALClose(GDALCreate(GDALGetDriverByName("GTiff"), path, RASTER_MAX_SIDE + 1, 1, 1, GDT_Byte,
                         options));
    expect_refused(f, path, TRL_ERROR_INVALID, "pixels");
    snprintf(path, sizeof path, "%s/deep.tif", f->folder);
    GDALClose(GDALCreate(GDALGetDriverByName("GTiff"), path, 4, 2, RASTER_MAX_BANDS + 1, GDT_Byte,
                         options));
    CSLDestroy(options);
    expect_refused(f, path, TRL_ERROR_INVALID, "bands");
}

// Every file cut short at any length must give an error when opened or read, never a crash, and
// never pixels that are not in it.
static void check_truncated(struct fixture *f, const char *data, size_t size,
                            const struct recipe *r)
{
    char path[128];
    snprintf(path, sizeof path, "%s/cut", f->folder);
    FILE *file = fopen(path, "wb");
    assert_int_equal(fwrite(data, 1, size, file), size);
    fclose(file);
    struct raster raster;
    f->errors = 0;
    if (raster_open(f->ctx, path, &raster) != TRL_OK) {
        assert_int_equal(f->errors, 1);
        return;
    }
    const struct raster_window window = raster_window_whole(&raster, 0);
    float *values = calloc((size_t)window.out_width * window.out_height, sizeof *values);
    const trl_result result = raster_read_float(&raster, &window, 0, values);
    if (result == TRL_OK) {
        // Only what lies behind the pixels (tags, padding) may be missing.
        for (uint32_t i = 0; i < raster.width * raster.height; i++) {
            const int x = (int)(i % raster.width);
            const int y = (int)(i / raster.width);
            assert_true((double)values[i] == value_at(r, 0, x, y));
        }
    } else {
        assert_int_equal(f->errors, 1);
    }
    free(values);
    raster_finish(&raster);
}

static void truncated_files_are_errors(void **state)
{
    struct fixture *f = *state;
    struct recipe recipes[] = {GLOBE, GLOBE, GLOBE};
    recipes[1].option = "COMPRESS=DEFLATE";
    recipes[2].option = "TILED=YES";
    for (size_t i = 0; i < sizeof recipes / sizeof recipes[0]; i++) {
        FILE *file = fopen(make_file(f, &recipes[i]), "rb");
        static char data[1 << 18];
        const size_t size = fread(data, 1, sizeof data, file);
        fclose(file);
        assert_true(size > 200 && size < sizeof data);
        // Every length of the header, then in strides that are prime to any structure.
        for (size_t length = 1; length < size; length += length < 400 ? 1 : 97) {
            check_truncated(f, data, length, &recipes[i]);
        }
    }
}

// Bytes changed at random (a fixed sequence) must not crash it; what it reads may be wrong.
static void damaged_files_do_not_crash(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.option = "COMPRESS=DEFLATE";
    FILE *file = fopen(make_file(f, &r), "rb");
    static char data[1 << 16];
    const size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    char path[128];
    snprintf(path, sizeof path, "%s/damaged", f->folder);
    uint32_t seed = 1;
    for (int round = 0; round < 500; round++) {
        char copy[sizeof data];
        memcpy(copy, data, size);
        for (int k = 0; k < 4; k++) {
            seed = seed * 1664525u + 1013904223u;
            copy[(seed >> 8) % size] = (char)(seed >> 24);
        }
        file = fopen(path, "wb");
        fwrite(copy, 1, size, file);
        fclose(file);
        struct raster raster;
        if (raster_open(f->ctx, path, &raster) == TRL_OK) {
            const struct raster_window window = raster_window_whole(&raster, 64);
            float values[64 * 64];
            assert_true(window.out_width <= 64 && window.out_height <= 64);
            const trl_result result = raster_read_float(&raster, &window, 0, values);
            assert_true(result == TRL_OK || result == TRL_ERROR_IO);
            raster_finish(&raster);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(wrong_georeferences_are_refused),   TEST(files_that_are_no_rasters_are_refused),
        TEST(nothing_but_local_files_is_opened), TEST(complex_pixels_are_refused),
        TEST(oversized_rasters_are_refused),     TEST(truncated_files_are_errors),
        TEST(damaged_files_do_not_crash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
