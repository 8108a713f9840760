// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_BESIDE_H
#define RASTER_BESIDE_H
// Files that GDAL opens with a raster: overviews (.ovr) and masks (.msk) beside it, and overviews
// that it names. It takes them as whatever they are, also as descriptions of what lies behind a
// network.

#include <gdal.h>
#include <stdbool.h>

// The name of a file beside a raster that is such an overview or mask and no plain TIFF; NULL:
// there is none. Free with CPLFree.
char *beside_find_stranger(const char *path);

// Whether a dataset says that its overviews are in a file of another name. To be asked before
// anything else is: GDAL looks at overviews when it is asked for them.
bool beside_is_pointed_at(GDALDatasetH dataset);

#endif // RASTER_BESIDE_H
