// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Where a raster says that it lies: a line of width, height and the six numbers of its transform,
// then its coordinate system as WKT or for PROJ. What is accepted has finite borders, and places of
// it that are found again.
#include <gdal.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdlib.h>
#include <string.h>

#include "raster/gdal.h"
#include "raster/georeference.h"
#include "terrain/frame.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { TEXT_MAX = 1 << 14, SIDE_MAX = 4096 };

// A dataset without pixels; NULL where the text has no eight numbers.
static GDALDatasetH make_dataset(char *text)
{
    double numbers[8];
    for (int i = 0; i < 8; i++) {
        char *end = text;
        numbers[i] = strtod(text, &end);
        if (end == text) {
            return NULL;
        }
        text = end;
    }
    const int width = (int)fmax(1, fmin(SIDE_MAX, numbers[0]));
    const int height = (int)fmax(1, fmin(SIDE_MAX, numbers[1]));
    const GDALDatasetH dataset =
        GDALCreate(GDALGetDriverByName("MEM"), "", width, height, 0, GDT_Byte, NULL);
    if (!dataset) {
        return NULL;
    }
    GDALAddBand(dataset, GDT_Int16, NULL);
    GDALSetGeoTransform(dataset, numbers + 2);
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    char *wkt = text + strspn(text, " \n");
    if (OSRImportFromWkt(srs, &wkt) == OGRERR_NONE || OSRImportFromProj4(srs, wkt) == OGRERR_NONE) {
        GDALSetSpatialRef(dataset, srs);
    }
    OSRDestroySpatialReference(srs);
    return dataset;
}

static void check(const struct raster *raster)
{
    const struct layer_frame frame = layer_frame_of(raster, raster->width, raster->height, 0);
    const double x = 0.5 * raster->width - 0.5, y = 0.5 * raster->height - 0.5;
    const struct layer_geo geo = layer_geo_of(&frame, x, y);
    const struct layer_place place = layer_locate(&frame, geo.latitude, geo.longitude);
    const bool is_found = fabs(place.x - x) < 1e-3 * (1 + x) && fabs(place.y - y) < 1e-3 * (1 + y);
    if (!isfinite(geo.latitude + geo.longitude + frame.reach_rad) || !is_found) {
        abort();
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static char text[TEXT_MAX];
    if (size >= TEXT_MAX) {
        return 0;
    }
    memcpy(text, data, size);
    text[size] = '\0';
    trl_context_desc desc = trl_context_desc_default();
    desc.data_dir = "/nonexistent";
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    if (trl_context_create(&desc, &ctx) != TRL_OK) {
        abort();
    }
    gdal_register();
    struct gdal_catcher catcher;
    gdal_catch_begin(&catcher, ctx);
    struct raster raster = {.ctx = ctx, .path = mem_strdup(ctx, "fuzz")};
    raster.dataset = make_dataset(text);
    if (raster.dataset && raster_read_facts(&raster) == TRL_OK &&
        raster_read_georeference(&raster) == TRL_OK) {
        check(&raster);
    }
    gdal_catch_end(&catcher);
    raster_finish(&raster);
    trl_context_destroy(&ctx);
    return 0;
}
