// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_GEOREFERENCE_H
#define RASTER_GEOREFERENCE_H
// Where an opened raster lies. Used by raster.c, and by tests on datasets that are no files. All
// log one line that names raster->path; call them between gdal_catch_begin and gdal_catch_end.

#include "raster/raster.h"

// Size, bands and their colours, type, units and missing value of raster->dataset.
// TRL_ERROR_INVALID.
TRL_MUST_USE trl_result raster_read_facts(struct raster *raster);

// Borders or plane of raster->dataset. Where only a warped raster will do, `dataset` becomes that,
// `source` the one before, and size and type are read again. TRL_ERROR_INVALID.
TRL_MUST_USE trl_result raster_read_georeference(struct raster *raster);

// Whether pixels at `transform` of a projected system lie in one of the two projections, within a
// hundredth of a pixel. Then the raster's borders (not checked) or plane are set.
bool raster_recognise_projection(struct raster *raster, const double transform[6]);

// Makes a raster of longitude and latitude out of one that GDAL can transform to it.
// TRL_ERROR_INVALID.
TRL_MUST_USE trl_result raster_warp(struct raster *raster);

#endif // RASTER_GEOREFERENCE_H
