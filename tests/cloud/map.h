// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_CLOUD_MAP_H
#define TESTS_CLOUD_MAP_H
// Writes maps of clouds; after cmocka.h.

#include <gdal.h>
#include <ogr_srs_api.h>
#include <stdbool.h>
#include <stdint.h>

struct map_desc {
    int width, height, bands; // of the whole globe
    const uint8_t *texels;    // band by band; NULL: all 0
    bool is_void;             // 0 stands for no data
};

static inline void write_map(const char *path, const struct map_desc *map)
{
    GDALAllRegister();
    const GDALDatasetH file = GDALCreate(GDALGetDriverByName("GTiff"), path, map->width,
                                         map->height, map->bands, GDT_Byte, NULL);
    assert_non_null(file);
    double transform[6] = {-180, 360.0 / map->width, 0, 90, 0, -180.0 / map->height};
    assert_int_equal(GDALSetGeoTransform(file, transform), CE_None);
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    assert_int_equal(OSRImportFromEPSG(srs, 4326), OGRERR_NONE);
    assert_int_equal(GDALSetSpatialRef(file, srs), CE_None);
    OSRDestroySpatialReference(srs);
    if (map->is_void) {
        assert_int_equal(GDALSetRasterNoDataValue(GDALGetRasterBand(file, 1), 0), CE_None);
    }
    if (map->texels) {
        assert_int_equal(GDALDatasetRasterIO(file, GF_Write, 0, 0, map->width, map->height,
                                             (void *)(uintptr_t)map->texels, map->width,
                                             map->height, GDT_Byte, map->bands, NULL, 0, 0, 0),
                         CE_None);
    }
    GDALClose(file);
}

#endif // TESTS_CLOUD_MAP_H
