// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Rasters from files that the tests make with GDAL: georeference, windows, overviews, missing data,
// and everything that must be refused with one line.
#include "raster/gdal.h"
#include "raster/grid.h"

// cmocka wants these before its own header
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <cpl_string.h>
#include <gdal.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double RADIAN = 3.14159265358979323846 / 180;

struct fixture {
    trl_context *ctx;
    char folder[64];
    int errors;      // lines logged as errors
    char last[2048]; // the latest of them
};

static void keep_log(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    (void)item;
    if (level == TRL_LOG_ERROR) {
        f->errors++;
        snprintf(f->last, sizeof f->last, "%s", message);
        assert_null(strchr(message, '\n')); // one line is one line
    }
}

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    snprintf(f->folder, sizeof f->folder, "/tmp/terrella-raster-XXXXXX");
    trl_context_desc desc = trl_context_desc_default();
    desc.log = keep_log;
    desc.log_user = f;
    gdal_register();
    *state = f;
    return mkdtemp(f->folder) && trl_context_create(&desc, &f->ctx) == TRL_OK ? 0 : -1;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", f->folder);
    const int status = system(command);
    trl_context_destroy(&f->ctx);
    free(f);
    return status;
}

// What a test file is. The georeference is left out when the pixel width is 0.
struct recipe {
    const char *name;
    const char *driver; // NULL: GTiff
    int width, height, bands;
    GDALDataType type;
    double transform[6];
    int epsg; // 0: none
    bool has_nodata;
    double nodata;
    const char *option; // of creation, "NAME=VALUE", or NULL
    bool has_overviews;
};

static const struct recipe GLOBE = {.name = "globe.tif",
                                    .width = 36,
                                    .height = 18,
                                    .bands = 1,
                                    .type = GDT_Int16,
                                    .transform = {-180, 10, 0, 90, 0, -10},
                                    .epsg = 4326};

// Value of a pixel: different everywhere, and within 8 bits where that is the type.
static double value_at(const struct recipe *r, int band, int x, int y)
{
    return r->type == GDT_Byte ? (x * 7 + y * 3 + band * 50) % 251 : x * 100 + y + band * 10000;
}

static const char *make_file(struct fixture *f, const struct recipe *r)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", f->folder, r->name);
    char **options = r->option ? CSLAddString(NULL, r->option) : NULL;
    const GDALDriverH driver = GDALGetDriverByName(r->driver ? r->driver : "GTiff");
    const GDALDatasetH dataset =
        GDALCreate(driver, path, r->width, r->height, r->bands, r->type, options);
    CSLDestroy(options);
    assert_non_null(dataset);
    if (r->transform[1] != 0) {
        double transform[6];
        memcpy(transform, r->transform, sizeof transform);
        assert_int_equal(GDALSetGeoTransform(dataset, transform), CE_None);
    }
    if (r->epsg) {
        const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
        assert_int_equal(OSRImportFromEPSG(srs, r->epsg), OGRERR_NONE);
        assert_int_equal(GDALSetSpatialRef(dataset, srs), CE_None);
        OSRDestroySpatialReference(srs);
    }
    double *row = calloc((size_t)r->width, sizeof *row);
    for (int band = 0; band < r->bands; band++) {
        const GDALRasterBandH to = GDALGetRasterBand(dataset, band + 1);
        if (r->has_nodata) {
            GDALSetRasterNoDataValue(to, r->nodata);
        }
        for (int y = 0; y < r->height; y++) {
            for (int x = 0; x < r->width; x++) {
                row[x] = value_at(r, band, x, y);
            }
            assert_int_equal(
                GDALRasterIO(to, GF_Write, 0, y, r->width, 1, row, r->width, 1, GDT_Float64, 0, 0),
                CE_None);
        }
    }
    free(row);
    if (r->has_overviews) {
        int factors[] = {2, 4};
        assert_int_equal(GDALBuildOverviews(dataset, "AVERAGE", 2, factors, 0, NULL, NULL, NULL),
                         CE_None);
    }
    GDALClose(dataset);
    return path;
}

static void open_made(struct fixture *f, const struct recipe *r, struct raster *raster)
{
    assert_int_equal(raster_open(f->ctx, make_file(f, r), raster), TRL_OK);
    assert_int_equal(f->errors, 0);
}

// Opens what must be refused: the result, one line that names the file and holds `why`, nothing
// left open.
static void expect_refused(struct fixture *f, const char *path, trl_result result, const char *why)
{
    struct raster raster;
    f->errors = 0;
    assert_int_equal(raster_open(f->ctx, path, &raster), result);
    assert_int_equal(f->errors, 1);
    assert_non_null(strstr(f->last, path));
    assert_non_null(strstr(f->last, why));
    assert_null(raster.dataset);
    assert_null(raster.path);
    raster_finish(&raster);
}

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
    r.epsg = 0;
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

static void wrong_georeferences_are_refused(void **state)
{
    struct recipe r = GLOBE;
    r.transform[2] = 1; // turned, in nothing that is known
    r.epsg = 0;
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
    r.epsg = 32633; // UTM, far from where it holds
    r.transform[0] = 1e9;
    r.transform[1] = 1e8;
    expect_refused(*state, make_file(*state, &r), TRL_ERROR_INVALID, "cannot be turned into");
}

// A place's value in the file, as the raster's own borders have it.
static double value_in(const struct raster *raster, double latitude, double longitude)
{
    const double x = (longitude - raster->west_deg) / raster->pixel_width_deg;
    const double y = (raster->north_deg - latitude) / raster->pixel_height_deg;
    assert_true(x >= 0 && x < raster->width && y >= 0 && y < raster->height);
    const struct raster_window one = {(uint32_t)x, (uint32_t)y, 1, 1, 1, 1};
    float value;
    assert_int_equal(raster_read_float(raster, &one, 0, &value), TRL_OK);
    return (double)value;
}

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
    r.epsg = 32662; // plate carree; the ellipsoid's larger radius
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
        r.epsg = i == 0 ? 3413 : 3031;
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
    r.epsg = 32633;
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
    r.epsg = 32660;
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
    r.epsg = 3571; // equal areas about the north pole
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
    r.epsg = 3857; // Mercator: 20 037 508 m are 180 degrees
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

static void load_grid(struct fixture *f, const struct recipe *r, struct raster_grid *grid)
{
    struct raster raster;
    open_made(f, r, &raster);
    assert_int_equal(raster_grid_load(&raster, 0, grid), TRL_OK);
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

static void *allocate_counted(void *user, size_t bytes)
{
    int *left = user;
    return (*left)-- > 0 ? malloc(bytes) : NULL;
}

static void *reallocate_plain(void *user, void *block, size_t bytes)
{
    (void)user;
    return realloc(block, bytes);
}

static void release_plain(void *user, void *block)
{
    (void)user;
    free(block);
}

// Each allocation in turn fails: the call says so and leaves nothing behind (the sanitised build
// looks for leaks).
static void every_failed_allocation_is_told(void **state)
{
    struct fixture *f = *state;
    const char *path = make_file(f, &GLOBE);
    int left = 100;
    trl_context_desc desc = trl_context_desc_default();
    desc.allocator = (trl_allocator){allocate_counted, reallocate_plain, release_plain, &left};
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    trl_result result = TRL_ERROR_MEMORY;
    int allowed = 0;
    for (; result != TRL_OK && allowed < 10; allowed++) {
        left = allowed;
        struct raster raster;
        struct raster_grid grid = {0};
        result = raster_open(ctx, path, &raster);
        if (result == TRL_OK) {
            result = raster_grid_load(&raster, 0, &grid);
        }
        assert_true(result == TRL_OK || (result == TRL_ERROR_MEMORY && !grid.values));
        raster_grid_finish(&grid);
        raster_finish(&raster);
    }
    assert_int_equal(allowed, 3); // path and values: fails with 0 and 1, goes through with 2
    trl_context_destroy(&ctx);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(facts_of_a_globe_are_read),
        TEST(a_globe_without_georeference_is_taken_for_one),
        TEST(a_left_edge_at_0_east_stays_there),
        TEST(wrong_georeferences_are_refused),
        TEST(rasters_with_the_south_first_are_turned_over),
        TEST(metres_of_an_equirectangular_map_are_degrees),
        TEST(polar_maps_are_known),
        TEST(other_projections_are_warped),
        TEST(warped_across_the_antimeridian_stays_in_one_piece),
        TEST(warped_rasters_have_no_hole_at_a_pole_and_no_seam),
        TEST(files_that_are_no_rasters_are_refused),
        TEST(nothing_but_local_files_is_opened),
        TEST(complex_pixels_are_refused),
        TEST(oversized_rasters_are_refused),
        TEST(windows_give_their_pixels),
        TEST(windows_outside_are_refused),
        TEST(half_size_averages),
        TEST(missing_data_become_nan),
        TEST(colours_come_as_rgba),
        TEST(numbers_of_colours_come_as_colours),
        TEST(masks_of_files_leave_pixels_out),
        TEST(truncated_files_are_errors),
        TEST(damaged_files_do_not_crash),
        TEST(samples_are_bilinear_between_centres),
        TEST(the_antimeridian_joins),
        TEST(poles_join_opposite_meridians),
        TEST(outside_an_inset_there_is_nothing),
        TEST(holes_take_their_neighbours_mean),
        TEST(every_failed_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
