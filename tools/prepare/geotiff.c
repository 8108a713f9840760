// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "prepare.h"

#include "base/file.h"
#include "raster/gdal.h"

#include <cpl_string.h>
#include <gdal.h>
#include <ogr_srs_api.h>

static const GDALDataType GDAL_TYPES[] = {
    [PIXEL_UINT8] = GDT_Byte, [PIXEL_INT16] = GDT_Int16, [PIXEL_FLOAT] = GDT_Float32};

static bool write_georeference(GDALDatasetH dataset, const struct geotiff *g)
{
    double transform[6] = {g->west_deg, g->pixel_width_deg,  0, g->north_deg,
                           0,           -g->pixel_height_deg};
    if (g->projection) {
        transform[0] = g->left_m;
        transform[3] = g->top_m;
        transform[1] = g->pixel_m;
        transform[5] = -g->pixel_m;
    }
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    const char *system = g->projection ? g->projection : "EPSG:4326";
    const bool is_written = OSRSetFromUserInput(srs, system) == OGRERR_NONE &&
                            GDALSetSpatialRef(dataset, srs) == CE_None &&
                            GDALSetGeoTransform(dataset, transform) == CE_None;
    OSRDestroySpatialReference(srs);
    return is_written;
}

static bool write_pixels(GDALDatasetH dataset, const struct geotiff *g)
{
    const GDALDataType type = GDAL_TYPES[g->kind];
    const int bytes = GDALGetDataTypeSizeBytes(type);
    if (g->unit) {
        GDALSetRasterUnitType(GDALGetRasterBand(dataset, 1), g->unit);
    }
    return GDALDatasetRasterIOEx(dataset, GF_Write, 0, 0, (int)g->width, (int)g->height,
                                 (void *)(uintptr_t)g->pixels, (int)g->width, (int)g->height, type,
                                 (int)g->bands, NULL, (GSpacing)bytes * g->bands,
                                 (GSpacing)bytes * g->bands * g->width, bytes, NULL) == CE_None;
}

// Halved until the longer side is at most this: a globe of that size fits any texture and any
// cache.
enum { SMALLEST_OVERVIEW = 512, MAX_OVERVIEWS = 16 };

static bool write_overviews(GDALDatasetH dataset, const struct geotiff *g)
{
    int factors[MAX_OVERVIEWS];
    int count = 0;
    const uint32_t longest = g->width > g->height ? g->width : g->height;
    for (int factor = 2;
         longest / (uint32_t)factor >= SMALLEST_OVERVIEW / 2 && count < MAX_OVERVIEWS;
         factor *= 2) {
        factors[count++] = factor;
    }
    return count == 0 ||
           GDALBuildOverviews(dataset, "AVERAGE", count, factors, 0, NULL, NULL, NULL) == CE_None;
}

static bool write_dataset(const char *path, const struct geotiff *g)
{
    char **options = NULL;
    // Strips, not tiles: the whole file is read at start, in the order it lies on the disk.
    options = CSLSetNameValue(options, "INTERLEAVE", "PIXEL");
    options = CSLSetNameValue(options, "BIGTIFF", "IF_SAFER");
    const GDALDriverH driver = GDALGetDriverByName("GTiff");
    const GDALDatasetH dataset = GDALCreate(driver, path, (int)g->width, (int)g->height,
                                            (int)g->bands, GDAL_TYPES[g->kind], options);
    CSLDestroy(options);
    if (!dataset) {
        return false;
    }
    const bool is_written =
        write_georeference(dataset, g) && write_pixels(dataset, g) && write_overviews(dataset, g);
    GDALClose(dataset);
    return is_written;
}

trl_result geotiff_write(const struct places *places, const struct geotiff *geotiff)
{
    const trl_context *ctx = places->ctx;
    char *path = mem_printf(ctx, "%s/%s", places->out_dir, geotiff->name);
    if (!path) {
        return TRL_ERROR_MEMORY;
    }
    struct file_replacement replacement;
    trl_result result = file_replacement_begin(ctx, path, &replacement);
    if (result == TRL_OK) {
        gdal_register();
        struct gdal_catcher catcher;
        gdal_catch_begin(&catcher, ctx);
        const bool is_written = write_dataset(replacement.temp_path, geotiff);
        gdal_catch_end(&catcher);
        // Closing flushes, and a full disk is only told there: the catcher has heard it.
        if (is_written && !catcher.message[0]) {
            result = file_replacement_commit(ctx, &replacement);
        } else {
            result = trl_fail(ctx, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_WRITE, "cannot write %s: %s",
                              path, catcher.message[0] ? catcher.message : "GDAL does not say why");
            file_replacement_abort(ctx, &replacement);
        }
    }
    mem_free(ctx, path);
    return result;
}
