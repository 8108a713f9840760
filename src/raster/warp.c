// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What is in no projection of ours, as a raster of one that GDAL computes while it is read.
#include "raster/georeference.h"
#include "raster/warp_target.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <cpl_string.h>
#include <gdal_utils.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>

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

// WGS 84 for Earth, else the system's own longitude and latitude; NULL when it has none.
static OGRSpatialReferenceH choose_degrees(OGRSpatialReferenceH srs)
{
    OGRErr error = OGRERR_NONE;
    const double radius_m = OSRGetSemiMajor(srs, &error);
    const OGRSpatialReferenceH wgs84 = OSRNewSpatialReference(NULL);
    if (radius_m > 6.35e6 && radius_m < 6.4e6 && OSRImportFromEPSG(wgs84, 4326) == OGRERR_NONE &&
        can_transform(srs, wgs84)) {
        return wgs84;
    }
    OSRDestroySpatialReference(wgs84);
    return OSRCloneGeogCS(srs);
}

// Where the warped raster has no pixel of the source it must say so: in the source's own missing
// value, in an alpha band, or in one that heights do not have.
static char **add_missing_value(GDALDatasetH source, char **options)
{
    const GDALRasterBandH band = GDALGetRasterBand(source, 1);
    const GDALDataType type = GDALGetRasterDataType(band);
    int has_nodata = 0;
    GDALGetRasterNoDataValue(band, &has_nodata);
    const GDALRasterBandH last = GDALGetRasterBand(source, GDALGetRasterCount(source));
    if (has_nodata || GDALGetRasterColorInterpretation(last) == GCI_AlphaBand) {
        return options; // GDAL carries these over
    }
    if (type == GDT_Byte) {
        return CSLAddString(options, "-dstalpha");
    }
    options = CSLAddString(options, "-dstnodata");
    return CSLAddString(options, type == GDT_Int16 ? "-32768" : "nan");
}

// To `target`, at GDAL's choice of size and borders, or as `more` options say (taken over).
static GDALDatasetH warp(GDALDatasetH source, const char *target, char **more)
{
    static const char *const WORDS[] = {"-of", "VRT", "-r", "bilinear", "-et", "0.05", "-t_srs"};
    char **words = NULL;
    for (size_t i = 0; i < sizeof WORDS / sizeof WORDS[0]; i++) {
        words = CSLAddString(words, WORDS[i]);
    }
    words = CSLAddString(words, target);
    words = add_missing_value(source, words);
    for (char **word = more; word && *word; word++) {
        words = CSLAddString(words, *word);
    }
    CSLDestroy(more);
    GDALWarpAppOptions *options = GDALWarpAppOptionsNew(words, NULL);
    CSLDestroy(words);
    int wrong_usage = 0;
    const GDALDatasetH warped = GDALWarp("", NULL, 1, &source, options, &wrong_usage);
    GDALWarpAppOptionsFree(options);
    return warped;
}

// GDAL's borders come from a sample of places and may miss the antimeridian and the pole by a part
// of a pixel, which would stay open: the same size of pixels, from 180 W to 180 E.
static char **close_circle(GDALDatasetH warped, const struct warp_target *target)
{
    double t[6];
    if (GDALGetGeoTransform(warped, t) != CE_None) {
        return NULL;
    }
    const double north = target->has_north_pole ? 90 : fmin(t[3], 90);
    const double bottom = t[3] + t[5] * GDALGetRasterYSize(warped);
    const double south = target->has_south_pole ? -90 : fmax(bottom, -90);
    const double numbers[] = {
        -180, south, 180, north, 2 * ceil(180 / t[1]), ceil((north - south) / -t[5])};
    char **words = NULL;
    for (int i = 0; i < 6; i++) {
        char text[40];
        snprintf(text, sizeof text, "%.*f", i < 4 ? 12 : 0, numbers[i]);
        words = i == 0 ? CSLAddString(words, "-te") : words;
        words = i == 4 ? CSLAddString(words, "-ts") : words;
        words = CSLAddString(words, text);
    }
    return words;
}

static GDALDatasetH warp_to(GDALDatasetH source, const struct warp_target *target)
{
    GDALDatasetH warped = warp(source, target->wkt, NULL);
    char **words = warped && target->is_whole_circle ? close_circle(warped, target) : NULL;
    if (words) {
        GDALClose(warped);
        warped = warp(source, target->wkt, words);
    }
    return warped;
}

trl_result raster_warp(struct raster *raster)
{
    const OGRSpatialReferenceH srs = GDALGetSpatialRef(raster->dataset);
    const char *name = OSRGetName(srs);
    const OGRSpatialReferenceH degrees = choose_degrees(srs);
    struct warp_target target = {0};
    GDALDatasetH warped = NULL;
    if (degrees && warp_target_choose(raster->dataset, degrees, &target)) {
        warped = warp_to(raster->dataset, &target);
    }
    warp_target_finish(&target);
    OSRDestroySpatialReference(degrees);
    if (!warped) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: its coordinates (%s) cannot be turned into longitude and latitude; "
                        "correct them (gdal_edit.py -a_srs, -a_ullr)",
                        raster->path, name ? name : "unnamed");
    }
    raster->source = raster->dataset;
    raster->dataset = warped;
    return TRL_OK;
}
