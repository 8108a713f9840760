// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What an opened raster says of itself: size, type, missing value, units, what its bands are.
#include "raster/georeference.h"

#include <gdal.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static trl_result fail_type(const struct raster *raster, const char *why)
{
    return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER, "%s: %s", raster->path,
                    why);
}

static trl_result read_size(struct raster *raster)
{
    const int width = GDALGetRasterXSize(raster->dataset);
    const int height = GDALGetRasterYSize(raster->dataset);
    const int bands = GDALGetRasterCount(raster->dataset);
    if (width < 1 || height < 1 || width > RASTER_MAX_SIDE || height > RASTER_MAX_SIDE) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d x %d pixels; sides from 1 to %d can be read: cut it in pieces or "
                        "make it smaller (gdal_translate -srcwin, -outsize)",
                        raster->path, width, height, RASTER_MAX_SIDE);
    }
    if (bands < 1 || bands > RASTER_MAX_BANDS) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d bands; 1 to %d can be read: choose some (gdal_translate -b)",
                        raster->path, bands, RASTER_MAX_BANDS);
    }
    raster->width = raster->file_width = (uint32_t)width;
    raster->height = raster->file_height = (uint32_t)height;
    raster->band_count = (uint32_t)bands;
    return TRL_OK;
}

static trl_result read_type(struct raster *raster, GDALRasterBandH band)
{
    const GDALDataType type = GDALGetRasterDataType(band);
    if (GDALDataTypeIsComplex(type)) {
        return fail_type(raster, "its pixels are complex numbers; their real parts can be read "
                                 "(gdal_translate -ot Float32)");
    }
    // Before GDAL 3.7 a byte with a sign is a byte with a remark.
    const char *pixel_type = GDALGetMetadataItem(band, "PIXELTYPE", "IMAGE_STRUCTURE");
    if (pixel_type && strcmp(pixel_type, "SIGNEDBYTE") == 0) {
        return fail_type(raster, "its pixels are of 8 bits with a sign; make them 16 bits "
                                 "(gdal_calc.py --type=Int16)");
    }
    raster->type = type == GDT_Byte    ? RASTER_UINT8
                   : type == GDT_Int16 ? RASTER_INT16
                                       : RASTER_FLOAT;
    return TRL_OK;
}

static void read_nodata(struct raster *raster, GDALRasterBandH band)
{
    int has_nodata = 0;
    switch (GDALGetRasterDataType(band)) {
    case GDT_Int64:
        raster->nodata = (double)GDALGetRasterNoDataValueAsInt64(band, &has_nodata);
        break;
    case GDT_UInt64:
        raster->nodata = (double)GDALGetRasterNoDataValueAsUInt64(band, &has_nodata);
        break;
    default:
        raster->nodata = GDALGetRasterNoDataValue(band, &has_nodata);
    }
    raster->has_nodata = has_nodata != 0;
}

// As GDAL's drivers write them: formats' words, EPSG's names.
static const struct {
    const char *name;
    double metres;
} UNITS[] = {{"m", 1},
             {"metre", 1},
             {"metres", 1},
             {"meter", 1},
             {"meters", 1},
             {"km", 1000},
             {"kilometre", 1000},
             {"kilometer", 1000},
             {"dm", 0.1},
             {"cm", 0.01},
             {"centimetre", 0.01},
             {"centimeter", 0.01},
             {"mm", 0.001},
             {"ft", 0.3048},
             {"foot", 0.3048},
             {"feet", 0.3048},
             // The survey foot, 1200/3937 m (Federal Register 24 FR 5348, 1959).
             {"us-ft", 1200.0 / 3937},
             {"ftus", 1200.0 / 3937},
             {"us_ft", 1200.0 / 3937},
             {"foot_us", 1200.0 / 3937},
             {"us survey foot", 1200.0 / 3937},
             {"u.s. survey foot", 1200.0 / 3937},
             {"us survey feet", 1200.0 / 3937}};
enum { UNIT_COUNT = sizeof UNITS / sizeof UNITS[0] };

static void read_values(struct raster *raster, GDALRasterBandH band)
{
    struct raster_values *v = &raster->values;
    int is_told = 0;
    const double scale = GDALGetRasterScale(band, &is_told);
    v->scale = is_told ? scale : 1;
    const double offset = GDALGetRasterOffset(band, &is_told);
    v->offset = is_told ? offset : 0;
    const char *unit = GDALGetRasterUnitType(band);
    snprintf(v->unit, sizeof v->unit, "%s", unit ? unit : "");
    v->unit_m = v->unit[0] ? 0 : 1;
    for (int i = 0; i < UNIT_COUNT && v->unit_m == 0; i++) {
        v->unit_m = strcasecmp(v->unit, UNITS[i].name) == 0 ? UNITS[i].metres : 0;
    }
}

// The first band of an interpretation, or -1.
static int find_band(const struct raster *raster, GDALColorInterp wanted)
{
    for (int i = 0; i < (int)raster->band_count; i++) {
        if (GDALGetRasterColorInterpretation(GDALGetRasterBand(raster->dataset, i + 1)) == wanted) {
            return i;
        }
    }
    return -1;
}

// Which bands are red, green, blue: those that say so, else the first three that are not alpha,
// else the first for all. Alpha is only what says that it is: a fourth band may be infrared.
static void find_colours(struct raster *raster)
{
    static const GDALColorInterp COLOURS[3] = {GCI_RedBand, GCI_GreenBand, GCI_BlueBand};
    const int alpha = find_band(raster, GCI_AlphaBand);
    bool are_told = true;
    for (int c = 0; c < 3; c++) {
        raster->colour_bands[c] = find_band(raster, COLOURS[c]);
        are_told = are_told && raster->colour_bands[c] >= 0;
    }
    const int others = (int)raster->band_count - (alpha >= 0);
    for (int c = 0; c < 3 && !are_told; c++) {
        const int band = others >= 3 ? c : 0;
        raster->colour_bands[c] = band + (alpha >= 0 && alpha <= band && others > 0);
    }
    raster->colour_bands[3] = alpha;
}

trl_result raster_read_facts(struct raster *raster)
{
    trl_result result = read_size(raster);
    const GDALRasterBandH band = result == TRL_OK ? GDALGetRasterBand(raster->dataset, 1) : NULL;
    if (result == TRL_OK) {
        result = read_type(raster, band);
    }
    if (result != TRL_OK) {
        return result;
    }
    find_colours(raster);
    // Warping (source is set) keeps numbers as they are. An alpha band that it or a palette adds
    // only says where nothing is.
    if (!raster->source) {
        const bool has_alpha = raster->colour_bands[3] >= 0;
        raster->has_alpha = !raster->has_palette && raster->type == RASTER_UINT8 && has_alpha;
        read_values(raster, band);
    }
    const int flags = GDALGetMaskFlags(band);
    const bool is_mask_alpha = (flags & GMF_ALPHA) && raster->type == RASTER_UINT8;
    raster->has_mask = (flags & GMF_PER_DATASET) && !(flags & GMF_NODATA) && !is_mask_alpha;
    if (raster->has_mask && raster->type == RASTER_INT16) {
        raster->type = RASTER_FLOAT; // with a number for what the mask leaves out
    }
    read_nodata(raster, band);
    return TRL_OK;
}
