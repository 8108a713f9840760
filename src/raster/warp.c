// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What is in no projection of ours, as a raster of longitude and latitude that GDAL computes while
// it is read.
#include "raster/georeference.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal_utils.h>
#include <ogr_srs_api.h>

static bool can_transform(OGRSpatialReferenceH from, OGRSpatialReferenceH to)
{
    CPLPushErrorHandler(CPLQuietErrorHandler); // "not the same celestial body" is an answer
    const OGRCoordinateTransformationH t = OCTNewCoordinateTransformation(from, to);
    if (t) {
        OCTDestroyCoordinateTransformation(t);
    }
    CPLErrorReset();
    CPLPopErrorHandler();
    return t != NULL;
}

// WGS 84 for Earth, else the system's own longitude and latitude. Free with CPLFree; may be NULL.
static char *choose_target(OGRSpatialReferenceH srs)
{
    char *wkt = NULL;
    OGRErr error = OGRERR_NONE;
    const double radius_m = OSRGetSemiMajor(srs, &error);
    const OGRSpatialReferenceH wgs84 = OSRNewSpatialReference(NULL);
    if (radius_m > 6.35e6 && radius_m < 6.4e6 && OSRImportFromEPSG(wgs84, 4326) == OGRERR_NONE &&
        can_transform(srs, wgs84)) {
        OSRExportToWkt(wgs84, &wkt);
    } else {
        const OGRSpatialReferenceH own = OSRCloneGeogCS(srs);
        if (own) {
            OSRExportToWkt(own, &wkt);
            OSRDestroySpatialReference(own);
        }
    }
    OSRDestroySpatialReference(wgs84);
    return wkt;
}

// Where the warped raster has no pixel of the source it must say so: in the source's own missing
// value, in an alpha band, or in one that heights do not have.
static char **add_missing_value(GDALDatasetH source, char **options)
{
    const GDALRasterBandH band = GDALGetRasterBand(source, 1);
    const GDALDataType type = GDALGetRasterDataType(band);
    const int bands = GDALGetRasterCount(source);
    int has_nodata = 0;
    GDALGetRasterNoDataValue(band, &has_nodata);
    if (has_nodata || (type == GDT_Byte && (bands == 2 || bands == 4))) {
        return options; // GDAL carries these over
    }
    if (type == GDT_Byte) {
        return CSLAddString(options, "-dstalpha");
    }
    options = CSLAddString(options, "-dstnodata");
    return CSLAddString(options, type == GDT_Int16 ? "-32768" : "nan");
}

static GDALDatasetH warp(GDALDatasetH source, const char *target)
{
    static const char *const WORDS[] = {"-of", "VRT", "-r", "bilinear", "-et", "0.05", "-t_srs"};
    char **words = NULL;
    for (size_t i = 0; i < sizeof WORDS / sizeof WORDS[0]; i++) {
        words = CSLAddString(words, WORDS[i]);
    }
    words = CSLAddString(words, target);
    words = add_missing_value(source, words);
    GDALWarpAppOptions *options = GDALWarpAppOptionsNew(words, NULL);
    CSLDestroy(words);
    int wrong_usage = 0;
    const GDALDatasetH warped = GDALWarp("", NULL, 1, &source, options, &wrong_usage);
    GDALWarpAppOptionsFree(options);
    return warped;
}

trl_result raster_warp(struct raster *raster)
{
    const OGRSpatialReferenceH srs = GDALGetSpatialRef(raster->dataset);
    const char *name = OSRGetName(srs);
    char *target = choose_target(srs);
    const GDALDatasetH warped = target ? warp(raster->dataset, target) : NULL;
    CPLFree(target);
    if (!warped) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: its coordinates (%s) cannot be turned into longitude and latitude",
                        raster->path, name ? name : "unnamed");
    }
    raster->source = raster->dataset;
    raster->dataset = warped;
    return TRL_OK;
}
