// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Bad and odd rasters as layers of a surface over a good globe, held whole and in tiles: what is no
// good is told in one line, with its key and what to do, and left out; the ground is the good one.
#include "fixture.h"
#include "terrain/surface.h"

#include <cpl_string.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { GOOD_M = 700 };
static const double WHOLE = 3e9, TILED = 1; // bytes for rasters

static double good_height(int x, int y)
{
    (void)x;
    (void)y;
    return GOOD_M;
}

static const struct recipe GOOD = {.name = "good.tif",
                                   .width = 72,
                                   .height = 36,
                                   .bands = 1,
                                   .type = GDT_Int16,
                                   .transform = {-180, 5, 0, 90, 0, -5},
                                   .system = "EPSG:4326",
                                   .value = good_height};

// Makes a surface of the good globe and one more raster; what it says of that is in the fixture.
static void make_surface(struct fixture *f, const struct surface_layer_desc *more, double max_bytes,
                         struct surface *out)
{
    char good[256];
    snprintf(good, sizeof good, "%s", make_file(f, &GOOD));
    const struct surface_layer_desc layers[2] = {
        {.kind = SURFACE_ELEVATION, .path = good, .scale = 1}, *more};
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6371000;
    desc.layers = layers;
    desc.layer_count = 2;
    desc.max_bytes = max_bytes;
    f->errors = f->warnings = 0;
    f->warning[0] = f->last[0] = '\0';
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, out), TRL_OK);
}

static double altitude(const struct surface *s, double latitude, double longitude)
{
    return surface_altitude(s, vec3_from_lat_lon(latitude * RADIAN, longitude * RADIAN));
}

// One line that names the file and its key and holds `why`; the good globe is there.
static void expect_left_out(struct fixture *f, const struct surface_layer_desc *layer,
                            const char *key, const char *why)
{
    char path[256];
    struct surface_layer_desc bad = *layer;
    bad.path = path;
    snprintf(path, sizeof path, "%s", layer->path);
    for (int i = 0; i < 2; i++) {
        struct surface s;
        make_surface(f, &bad, i == 0 ? WHOLE : TILED, &s);
        assert_int_equal(f->errors, 0);
        assert_int_equal(f->warnings, 1);
        assert_non_null(strstr(f->warning, path));
        assert_true(strncmp(f->warning, key, strlen(key)) == 0);
        assert_non_null(strstr(f->warning, why));
        assert_non_null(strstr(f->warning, "left out"));
        assert_true(fabs(altitude(&s, 10, 20) - GOOD_M) < 1e-6);
        surface_finish(&s);
    }
}

static void expect_height_left_out(struct fixture *f, const char *path, const char *why)
{
    expect_left_out(
        f, &(struct surface_layer_desc){.kind = SURFACE_ELEVATION, .path = path, .scale = 1},
        "elevation ", why);
}

static void expect_colour_left_out(struct fixture *f, const char *path, const char *why)
{
    expect_left_out(f, &(struct surface_layer_desc){.kind = SURFACE_COLOUR, .path = path},
                    "colour ", why);
}

static const char *put_bytes(const struct fixture *f, const char *name, const void *bytes,
                             size_t count)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", f->folder, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    fclose(file);
    return path;
}

static const char *put_text(const struct fixture *f, const char *name, const char *text)
{
    return put_bytes(f, name, text, strlen(text));
}

static void what_is_no_raster(void **state)
{
    struct fixture *f = *state;
    expect_height_left_out(f, put_text(f, "empty.tif", ""), "fetch or copy it again");
    expect_height_left_out(f, put_text(f, "words.tif", "height,of,land\n"), "no raster");
    char folder[128];
    snprintf(folder, sizeof folder, "%s/folder.tif", f->folder);
    assert_int_equal(mkdir(folder, 0700), 0);
    expect_height_left_out(f, folder, "a folder");
}

static void cut(const char *path, int part, int of)
{
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    assert_int_equal(truncate(path, info.st_size * part / of), 0);
}

static void what_is_cut_short(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    for (int i = 0; i < 3; i++) {
        r.option = i == 1 ? "TILED=YES" : i == 2 ? "COMPRESS=DEFLATE" : NULL;
        const char *path = make_file(f, &r);
        cut(path, 1, 2);
        expect_height_left_out(f, path, "broken");
    }
    // Formats that are read through a copy of what is made.
    static const char *const COPIED[2] = {"PNG", "JPEG"};
    r.type = GDT_Byte;
    r.bands = 3;
    r.width = 720;
    r.height = 360;
    r.transform[1] = 0.5;
    r.transform[5] = -0.5;
    r.option = NULL;
    for (int i = 0; i < 2; i++) {
        const GDALDatasetH made = GDALOpen(make_file(f, &r), GA_ReadOnly);
        char path[128];
        snprintf(path, sizeof path, "%s/cut.%s", f->folder, i == 0 ? "png" : "jpg");
        const GDALDatasetH copy =
            GDALCreateCopy(GDALGetDriverByName(COPIED[i]), path, made, FALSE, NULL, NULL, NULL);
        GDALClose(copy);
        GDALClose(made);
        cut(path, 1, 2);
        expect_colour_left_out(f, path, "broken");
    }
}

static void what_is_of_no_use_by_its_type(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.type = GDT_CFloat32;
    expect_height_left_out(f, make_file(f, &r), "gdal_translate -ot Float32");
    r.type = GDT_Int16;
    expect_colour_left_out(f, make_file(f, &r), "gdal_translate -ot Byte");
    r.type = GDT_Byte;
    r.option = "PIXELTYPE=SIGNEDBYTE";
    if (atoi(GDALVersionInfo("VERSION_NUM")) < 3070000) {
        expect_height_left_out(f, make_file(f, &r), "with a sign");
    }
}

static double nothing(int x, int y)
{
    (void)x;
    (void)y;
    return -9999;
}

static double not_a_number(int x, int y)
{
    (void)x;
    (void)y;
    return NAN;
}

static void what_has_no_data(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.has_nodata = true;
    r.nodata = -9999;
    r.value = nothing;
    expect_height_left_out(f, make_file(f, &r), "no pixel of it has data");
    r.has_nodata = false;
    r.type = GDT_Float32;
    r.value = not_a_number;
    expect_height_left_out(f, make_file(f, &r), "no pixel of it has data");
}

static void what_has_no_area(void **state)
{
    struct fixture *f = *state;
    static const int SIZES[4][2] = {{1, 1}, {100000, 1}, {1, 100000}, {2, 1}};
    for (int i = 0; i < 4; i++) {
        struct recipe r = GLOBE;
        r.width = SIZES[i][0];
        r.height = SIZES[i][1];
        r.transform[1] = 360.0 / r.width;
        r.transform[5] = -180.0 / r.height;
        r.value = good_height;
        expect_height_left_out(f, make_file(f, &r), "at least 2 x 2");
    }
}

static void what_lies_nowhere(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.transform[1] = 0;
    r.system = NULL;
    r.width = 50;
    expect_height_left_out(f, make_file(f, &r), "gdal_translate -a_srs");
    r = GLOBE;
    r.transform[5] = 0;
    expect_height_left_out(f, make_file(f, &r), "gdal_translate -a_ullr");
    r = GLOBE;
    r.transform[2] = 3;
    r.transform[4] = 2;
    r.system = NULL;
    expect_height_left_out(f, make_file(f, &r), "gdal_edit.py -a_srs");
    // Metres that do not say so.
    r = GLOBE;
    r.system = NULL;
    r.transform[0] = 420000;
    r.transform[1] = 1000;
    r.transform[3] = 5200000;
    r.transform[5] = -1000;
    expect_height_left_out(f, make_file(f, &r), "if they are not degrees");
}

static void what_has_only_control_points(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.name = "points.tif";
    r.transform[1] = 0;
    r.system = NULL;
    const char *path = make_file(f, &r);
    const GDALDatasetH made = GDALOpen(path, GA_Update);
    const GDAL_GCP points[3] = {
        {"1", "", 0, 0, 10, 40, 0}, {"2", "", 36, 0, 12, 40, 0}, {"3", "", 0, 18, 10, 39, 0}};
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(srs, 4326), OGRERR_NONE);
    assert_int_equal(GDALSetGCPs2(made, 3, points, srs), CE_None);
    OSRDestroySpatialReference(srs);
    GDALClose(made);
    expect_height_left_out(f, path, "gdalwarp");
}

// A TIFF of one strip whose header says how large it is; nothing of that is there.
static const char *put_declared(const struct fixture *f, const char *name, uint32_t width,
                                uint32_t height)
{
    const uint32_t entries[][3] = {
        {256 | 4u << 16, 1, width}, {257 | 4u << 16, 1, height}, {258 | 3u << 16, 1, 16},
        {259 | 3u << 16, 1, 1},     {262 | 3u << 16, 1, 1},      {273 | 4u << 16, 1, 8},
        {277 | 3u << 16, 1, 1},     {278 | 4u << 16, 1, height}, {279 | 4u << 16, 1, 1u << 31}};
    uint8_t bytes[10 + sizeof entries + 4] = {
        'I', 'I', 42, 0, 8, 0, 0, 0, sizeof entries / sizeof entries[0]};
    memcpy(bytes + 10, entries, sizeof entries);
    return put_bytes(f, name, bytes, sizeof bytes);
}

static void what_says_that_it_is_huge(void **state)
{
    struct fixture *f = *state;
    expect_height_left_out(f, put_declared(f, "a.tif", INT32_MAX, INT32_MAX), "");
    expect_height_left_out(f, put_declared(f, "b.tif", 1u << 31, 1u << 31), "");
    expect_height_left_out(f, put_declared(f, "c.tif", 1u << 21, 1u << 20), "");
    expect_height_left_out(f, put_declared(f, "d.tif", 1u << 20, 1u << 19), "");
    // With tiles that may all be missing, and no overviews.
    char path[128];
    snprintf(path, sizeof path, "%s/sparse.tif", f->folder);
    char **options = CSLAddString(CSLAddString(NULL, "SPARSE_OK=YES"), "TILED=YES");
    options = CSLAddString(CSLAddString(options, "BLOCKXSIZE=16384"), "BLOCKYSIZE=16384");
    GDALClose(
        GDALCreate(GDALGetDriverByName("GTiff"), path, 1 << 20, 1 << 19, 1, GDT_Byte, options));
    CSLDestroy(options);
    expect_height_left_out(f, path, "gdaladdo");
}

// Values of the file's own in feet, tenths of them from 1000 on.
static double tenths_of_feet(int x, int y)
{
    return 100 * x + y;
}

static void set_values(const char *path, double scale, double offset, const char *unit)
{
    const GDALDatasetH made = GDALOpen(path, GA_Update);
    const GDALRasterBandH band = GDALGetRasterBand(made, 1);
    assert_int_equal(GDALSetRasterScale(band, scale), CE_None);
    assert_int_equal(GDALSetRasterOffset(band, offset), CE_None);
    assert_int_equal(GDALSetRasterUnitType(band, unit), CE_None);
    GDALClose(made);
}

// At 45 N, 45 E lies the middle of column 22 and row 4. The scene's scale and offset are of the
// metres that come out.
static void heights_are_in_the_units_of_the_file(void **state)
{
    struct fixture *f = *state;
    static const struct {
        const char *unit;
        double metres;
    } UNITS[5] = {
        {"ft", 0.3048}, {"US survey foot", 1200.0 / 3937}, {"km", 1000}, {"", 1}, {"m", 1}};
    struct recipe r = GLOBE;
    r.value = tenths_of_feet;
    for (int i = 0; i < 10; i++) {
        char path[256];
        snprintf(path, sizeof path, "%s", make_file(f, &r));
        set_values(path, 0.1, 1000, UNITS[i % 5].unit);
        const struct surface_layer_desc layer = {
            .kind = SURFACE_ELEVATION, .path = path, .scale = 2, .offset_m = 7};
        struct surface s;
        make_surface(f, &layer, i < 5 ? WHOLE : TILED, &s);
        assert_int_equal(f->errors + f->warnings, 0);
        const double file = 1000 + 0.1 * tenths_of_feet(22, 4);
        const double wanted = 7 + 2 * UNITS[i % 5].metres * file;
        assert_true(fabs(altitude(&s, 45, 45) / wanted - 1) < 1e-3);
        surface_finish(&s);
    }
}

static void units_that_nobody_knows_are_told(void **state)
{
    struct fixture *f = *state;
    char path[256];
    snprintf(path, sizeof path, "%s", make_file(f, &GLOBE));
    set_values(path, 1, 0, "furlong");
    const struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    struct surface s;
    make_surface(f, &layer, WHOLE, &s);
    assert_int_equal(f->warnings, 1);
    assert_non_null(strstr(f->warning, "furlong"));
    assert_true(fabs(altitude(&s, 45, 45) / 2204 - 1) < 1e-3);
    surface_finish(&s);
    set_values(path, 0, 5, "m");
    expect_height_left_out(f, path, "give no heights");
}

static void wide_numbers_are_heights(void **state)
{
    struct fixture *f = *state;
    static const GDALDataType TYPES[6] = {GDT_UInt16, GDT_UInt32, GDT_Int32,
                                          GDT_UInt64, GDT_Int64,  GDT_Float64};
    for (int i = 0; i < 12; i++) {
        struct recipe r = GLOBE;
        r.type = TYPES[i % 6];
        const struct surface_layer_desc layer = {
            .kind = SURFACE_ELEVATION, .path = make_file(f, &r), .scale = 1};
        char path[256];
        snprintf(path, sizeof path, "%s", layer.path);
        struct surface_layer_desc copy = layer;
        copy.path = path;
        struct surface s;
        make_surface(f, &copy, i < 6 ? WHOLE : TILED, &s);
        assert_int_equal(f->errors + f->warnings, 0);
        assert_true(fabs(altitude(&s, 45, 45) / 2204 - 1) < 1e-3);
        surface_finish(&s);
    }
}

// No numbers, infinite ones, and the least float as a missing value that nobody named.
static double no_numbers_in_the_west(int x, int y)
{
    const double no_numbers[4] = {NAN, INFINITY, -INFINITY, -3.4028234663852886e38};
    return x < 12 ? no_numbers[y % 4] : 2000;
}

static void what_is_no_number_is_a_gap(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.type = GDT_Float32;
    r.value = no_numbers_in_the_west;
    for (int i = 0; i < 2; i++) {
        char path[256];
        snprintf(path, sizeof path, "%s", make_file(f, &r));
        const struct surface_layer_desc layer = {
            .kind = SURFACE_ELEVATION, .path = path, .scale = 1, .feather_rad = RADIAN};
        struct surface s;
        make_surface(f, &layer, i == 0 ? WHOLE : TILED, &s);
        assert_int_equal(f->errors + f->warnings, 0);
        assert_true(fabs(altitude(&s, 5, 60) - 2000) < 1);
        for (int k = 0; k < 100; k++) {
            const double there = altitude(&s, 90 - 1.7 * k, -179.9 + 1.2 * k);
            assert_true(there > GOOD_M - 100 && there < 2100);
        }
        assert_true(fabs(altitude(&s, 5, -120) - GOOD_M) < 1);
        surface_finish(&s);
    }
}

static double by_row(int x, int y)
{
    (void)x;
    return y;
}

static double by_column(int x, int y)
{
    (void)y;
    return x;
}

// Around the planet, in two columns or two rows: tiles are wider than they.
static void strips_are_drawn(void **state)
{
    struct fixture *f = *state;
    for (int i = 0; i < 4; i++) {
        struct recipe r = GLOBE;
        const bool is_high = i % 2 == 0;
        r.width = is_high ? 2 : 20000;
        r.height = is_high ? 20000 : 2;
        r.transform[1] = 360.0 / r.width;
        r.transform[5] = -180.0 / r.height;
        r.value = is_high ? by_row : by_column;
        char path[256];
        snprintf(path, sizeof path, "%s", make_file(f, &r));
        const struct surface_layer_desc layer = {
            .kind = SURFACE_ELEVATION, .path = path, .scale = 1};
        struct surface s;
        make_surface(f, &layer, i < 2 ? WHOLE : TILED, &s);
        // A row that reaches to the pole is levelled out over as many columns as it is high.
        const double there = altitude(&s, 45, 45);
        assert_true(is_high ? fabs(there - 20000 * 45 / 180.0 + 0.5) < 1
                            : there >= 0 && there < 20000);
        assert_int_equal(f->errors + f->warnings, 0);
        surface_finish(&s);
        assert_int_equal(f->errors + f->warnings, 0);
    }
}

static void maps_of_other_bodies_are_told_and_drawn(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.system = "+proj=longlat +R=3396190 +no_defs";
    char path[256];
    snprintf(path, sizeof path, "%s", make_file(f, &r));
    const struct surface_layer_desc layer = {.kind = SURFACE_ELEVATION, .path = path, .scale = 1};
    struct surface s;
    make_surface(f, &layer, WHOLE, &s);
    assert_int_equal(f->warnings, 1);
    assert_non_null(strstr(f->warning, "elevation "));
    assert_non_null(strstr(f->warning, path));
    assert_non_null(strstr(f->warning, "3396 km"));
    assert_true(fabs(altitude(&s, 45, 45) / 2204 - 1) < 1e-3);
    surface_finish(&s);
}

// A picture, and a file of six lines beside it.
static void world_files_place_pictures(void **state)
{
    struct fixture *f = *state;
    struct recipe r = GLOBE;
    r.type = GDT_Byte;
    r.bands = 3;
    const GDALDatasetH made = GDALOpen(make_file(f, &r), GA_ReadOnly);
    char path[128], aside[160];
    snprintf(path, sizeof path, "%s/placed.png", f->folder);
    GDALClose(GDALCreateCopy(GDALGetDriverByName("PNG"), path, made, FALSE, NULL, NULL, NULL));
    GDALClose(made);
    snprintf(aside, sizeof aside, "%s.aux.xml", path);
    (void)unlink(aside);
    put_text(f, "placed.pgw", "0.5\n0\n0\n-0.5\n10.25\n49.75\n");
    struct raster raster;
    assert_int_equal(raster_open(f->ctx, path, &raster), TRL_OK);
    assert_true(fabs(raster.west_deg - 10) < 1e-9 && fabs(raster.north_deg - 50) < 1e-9);
    assert_true(fabs(raster.east_deg - 28) < 1e-9 && fabs(raster.south_deg - 41) < 1e-9);
    raster_finish(&raster);
    put_text(f, "placed.pgw", "30\n0\n0\n-30\n420000\n5200000\n");
    expect_colour_left_out(f, path, "if they are not degrees");
}

// A degree wide about 46 degrees north; the second is seen from far behind the horizon.
static double high_height(int x, int y)
{
    (void)x;
    (void)y;
    return 30000;
}

static void a_layer_is_in_view_by_its_own_highest_ground(void **state)
{
    struct fixture *f = *state;
    struct recipe recipe = {.width = 20,
                            .height = 20,
                            .bands = 1,
                            .type = GDT_Int16,
                            .transform = {-100, 0.05, 0, 46.5, 0, -0.05},
                            .system = "EPSG:4326"};
    char paths[3][256];
    snprintf(paths[0], sizeof paths[0], "%s", make_file(f, &GOOD));
    for (int i = 0; i < 2; i++) {
        recipe.name = i == 0 ? "flat.tif" : "high.tif";
        recipe.value = i == 0 ? good_height : high_height;
        recipe.transform[0] = i == 0 ? -100 : 80;
        snprintf(paths[1 + i], sizeof paths[1 + i], "%s", make_file(f, &recipe));
    }
    struct surface_layer_desc layers[3];
    for (int i = 0; i < 3; i++) {
        layers[i] =
            (struct surface_layer_desc){.kind = SURFACE_ELEVATION, .path = paths[i], .scale = 1};
    }
    struct surface_desc desc = surface_desc_default();
    desc.radius_m = 6371000;
    desc.layers = layers;
    desc.layer_count = 3;
    struct surface s;
    assert_int_equal(surface_init_on_cpu(f->ctx, &desc, &s), TRL_OK);
    // 2000 km above the pole the horizon is 40.4 degrees away, 44 are to the middles; ground of
    // 700 m is seen from 0.8 degrees behind it, of 30 km from 5.6.
    struct surface_eye eye = {
        .up = {0, 0, 1}, .reach_rad = 50 * RADIAN, .height_rad = 2000.0 / 6371};
    assert_int_equal(surface_select(&s, &eye).counts[SURFACE_ELEVATION], 3);
    eye.solid_m = desc.radius_m;
    eye.horizon_rad = acos(6371.0 / 8371);
    const struct surface_selection seen = surface_select(&s, &eye);
    assert_int_equal(seen.counts[SURFACE_ELEVATION], 2);
    assert_int_equal(seen.indices[SURFACE_ELEVATION][1], 2);
    surface_finish(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(what_is_no_raster),
        TEST(what_is_cut_short),
        TEST(what_is_of_no_use_by_its_type),
        TEST(what_has_no_data),
        TEST(what_has_no_area),
        TEST(what_lies_nowhere),
        TEST(what_has_only_control_points),
        TEST(what_says_that_it_is_huge),
        TEST(heights_are_in_the_units_of_the_file),
        TEST(units_that_nobody_knows_are_told),
        TEST(wide_numbers_are_heights),
        TEST(what_is_no_number_is_a_gap),
        TEST(strips_are_drawn),
        TEST(maps_of_other_bodies_are_told_and_drawn),
        TEST(world_files_place_pictures),
        TEST(a_layer_is_in_view_by_its_own_highest_ground),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
