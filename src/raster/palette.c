// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pictures whose pixels are numbers of colours in a table, as pictures of those colours: numbers
// cannot be averaged or warped.
#include "raster/palette.h"

#include <cpl_string.h>
#include <gdal_utils.h>

// Whether some numbers stand for nothing, or for something transparent.
static bool has_holes(GDALRasterBandH band)
{
    const GDALColorTableH table = GDALGetRasterColorTable(band);
    int has_nodata = 0;
    GDALGetRasterNoDataValue(band, &has_nodata);
    for (int i = 0; i < GDALGetColorEntryCount(table) && !has_nodata; i++) {
        has_nodata = GDALGetColorEntry(table, i)->c4 < 255;
    }
    return has_nodata != 0;
}

bool palette_is_there(GDALDatasetH dataset)
{
    if (GDALGetRasterCount(dataset) != 1) {
        return false;
    }
    const GDALRasterBandH band = GDALGetRasterBand(dataset, 1);
    return GDALGetRasterDataType(band) == GDT_Byte && GDALGetRasterColorTable(band);
}

GDALDatasetH palette_expand(GDALDatasetH dataset)
{
    const char *colours = has_holes(GDALGetRasterBand(dataset, 1)) ? "rgba" : "rgb";
    const char *const words[] = {"-of", "VRT", "-expand", colours, "-a_nodata", "none", NULL};
    GDALTranslateOptions *options = GDALTranslateOptionsNew((char **)words, NULL);
    int wrong_usage = 0;
    const GDALDatasetH expanded = GDALTranslate("", dataset, options, &wrong_usage);
    GDALTranslateOptionsFree(options);
    // What is made holds on to what it is made from.
    GDALReleaseDataset(dataset);
    return expanded;
}
