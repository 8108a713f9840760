// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_WARP_TARGET_H
#define RASTER_WARP_TARGET_H
// Which system a raster in none of our projections is warped to.

#include <gdal.h>
#include <ogr_srs_api.h>
#include <stdbool.h>

struct warp_target {
    char *wkt; // owned
    // Of longitudes and latitudes: the raster goes around the globe, and covers the poles.
    bool is_whole_circle, has_north_pole, has_south_pole;
};

// `degrees`: the longitudes and latitudes to use. False when they cannot be written down.
bool warp_target_choose(GDALDatasetH dataset, OGRSpatialReferenceH degrees,
                        struct warp_target *out);

void warp_target_finish(struct warp_target *target);

#endif // RASTER_WARP_TARGET_H
