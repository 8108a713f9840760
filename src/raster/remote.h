// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_REMOTE_H
#define RASTER_REMOTE_H
// Rasters behind a network: which paths those are, and how GDAL is told to reach them. Whether they
// may be reached is not decided here (trl_context_desc.allows_remote).

#include "base/context.h"

// "http://…", "https://…", and GDAL's own names of the same and of object stores ("/vsicurl/",
// "/vsis3/", "/vsigs/", "/vsiaz/", "/vsioss/", "/vsiswift/"; "s3://", "gs://"). Nothing else: no
// archives, no memory, no pipes.
bool remote_is_path(const char *path);

// GDAL's name of a remote path; owned by the caller. NULL (logged) when memory is out.
char *remote_vsi_path(const trl_context *ctx, const char *path);

// Between begin and end GDAL reaches networks on this thread, with time limits, asks for no file
// beside the one that is named, and takes the header in one piece. Inside of gdal_catch_begin and
// _end, which let it reach none. Nothing happens where `is_remote` is false.
void remote_begin(bool is_remote);
void remote_end(bool is_remote);

#endif // RASTER_REMOTE_H
