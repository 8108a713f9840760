// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fixture.h"

#include "raster/gdal.h"

#include <cpl_string.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static void keep_log(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    (void)item;
    if (level == TRL_LOG_ERROR) {
        f->errors++;
        snprintf(f->last, sizeof f->last, "%s", message);
    } else if (level == TRL_LOG_WARN) {
        f->warnings++;
        snprintf(f->warning, sizeof f->warning, "%s", message);
    }
    assert_true(level > TRL_LOG_WARN || !strchr(message, '\n')); // one line is one line
}

int set_up_allowed(void **state, bool allows_remote)
{
    struct fixture *f = calloc(1, sizeof *f);
    snprintf(f->folder, sizeof f->folder, "/tmp/terrella-raster-XXXXXX");
    trl_context_desc desc = trl_context_desc_default();
    desc.log = keep_log;
    desc.log_user = f;
    desc.allows_remote = allows_remote;
    gdal_register();
    *state = f;
    return mkdtemp(f->folder) && trl_context_create(&desc, &f->ctx) == TRL_OK ? 0 : -1;
}

int set_up(void **state)
{
    return set_up_allowed(state, false);
}

int tear_down(void **state)
{
    struct fixture *f = *state;
    char command[128];
    snprintf(command, sizeof command, "rm -rf '%s'", f->folder);
    const int status = system(command);
    trl_context_destroy(&f->ctx);
    free(f);
    return status;
}

const struct recipe GLOBE = {.name = "globe.tif",
                             .width = 36,
                             .height = 18,
                             .bands = 1,
                             .type = GDT_Int16,
                             .transform = {-180, 10, 0, 90, 0, -10},
                             .system = "EPSG:4326"};

double value_at(const struct recipe *r, int band, int x, int y)
{
    if (r->value) {
        return r->value(x, y);
    }
    return r->type == GDT_Byte ? (x * 7 + y * 3 + band * 50) % 251 : x * 100 + y + band * 10000;
}

const char *make_file(struct fixture *f, const struct recipe *r)
{
    static char path[256];
    snprintf(path, sizeof path, "%s/%s", f->folder, r->name);
    remove(path); // GDAL looks at what is there, and complains
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
    if (r->system) {
        const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
        assert_int_equal(OSRSetFromUserInput(srs, r->system), OGRERR_NONE);
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

void open_made(struct fixture *f, const struct recipe *r, struct raster *raster)
{
    assert_int_equal(raster_open(f->ctx, make_file(f, r), raster), TRL_OK);
    assert_int_equal(f->errors, 0);
}

void expect_refused(struct fixture *f, const char *path, trl_result result, const char *why)
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

double value_in(const struct raster *raster, double latitude, double longitude)
{
    const double x = (longitude - raster->west_deg) / raster->pixel_width_deg;
    const double y = (raster->north_deg - latitude) / raster->pixel_height_deg;
    assert_true(x >= 0 && x < raster->width && y >= 0 && y < raster->height);
    const struct raster_window one = {(uint32_t)x, (uint32_t)y, 1, 1, 1, 1};
    float value;
    assert_int_equal(raster_read_float(raster, &one, 0, &value), TRL_OK);
    return (double)value;
}

static void *allocate_counted(void *user, size_t bytes)
{
    int *left = user;
    return __atomic_fetch_sub(left, 1, __ATOMIC_RELAXED) > 0 ? malloc(bytes) : NULL;
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

trl_context *make_counting_context(int *left)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.allocator = (trl_allocator){allocate_counted, reallocate_plain, release_plain, left};
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    return ctx;
}
