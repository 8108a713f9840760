// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_PALETTE_H
#define RASTER_PALETTE_H
// Call these between gdal_catch_begin and gdal_catch_end.

#include <gdal.h>
#include <stdbool.h>

// Whether it is a picture of one band of numbers of colours.
bool palette_is_there(GDALDatasetH dataset);

// The same as red, green and blue, with alpha where some numbers have no colour. Takes `dataset`
// over. NULL when it cannot be done.
GDALDatasetH palette_expand(GDALDatasetH dataset);

#endif // RASTER_PALETTE_H
