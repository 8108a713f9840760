// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/raster.h"

#include "raster/beside.h"
#include "raster/gdal.h"
#include "raster/georeference.h"
#include "raster/palette.h"
#include "raster/remote.h"

#include <cpl_conv.h>
#include <errno.h>
#include <gdal.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>

// Local formats with pixels of their own. Others (VRT, WMS, …) point elsewhere, also to the
// network, and a planet's data must not do that unasked.
static const char *const ALLOWED_DRIVERS[] = {
    "GTiff", "PNG",   "JPEG",  "netCDF",      "HDF5Image", "SRTMHGT", "USGSDEM",
    "PDS",   "PDS4",  "ISIS3", "EHdr",        "ENVI",      "HFA",     "AAIGrid",
    "GSBG",  "GS7BG", "DTED",  "JP2OpenJPEG", "WEBP",      "BMP",     NULL};

static trl_result fail_file(const struct raster *raster, trl_result code, const char *why)
{
    return trl_fail(raster->ctx, code, TRL_LOG_ITEM_RASTER, "%s: %s", raster->path, why);
}

// GDAL takes connection strings and network paths for names; only a file that is there may pass,
// and a URL where the user has allowed it.
static trl_result check_file(const struct raster *raster)
{
    struct stat info;
    if (raster->is_remote && !raster->ctx->desc.allows_remote) {
        return fail_file(raster, TRL_ERROR_INVALID,
                         "rasters are read from local files only, unless remote ones are allowed");
    }
    if (raster->is_remote) {
        return TRL_OK;
    }
    if (strncmp(raster->path, "/vsi", 4) == 0 || strstr(raster->path, "://")) {
        return fail_file(raster, TRL_ERROR_INVALID, "rasters are read from local files only");
    }
    if (stat(raster->path, &info) != 0) {
        return fail_file(raster, TRL_ERROR_IO, strerror(errno));
    }
    if (!S_ISREG(info.st_mode)) {
        return fail_file(raster, TRL_ERROR_IO, "not a file, but a folder or a device");
    }
    if (info.st_size == 0) {
        return fail_file(raster, TRL_ERROR_INVALID, "the file is empty; fetch or copy it again");
    }
    return TRL_OK;
}

static GDALDatasetH open_with(const struct raster *raster, const char *const *options)
{
    // Over a network only what can be read in parts.
    static const char *const remote_drivers[] = {"GTiff", NULL};
    char *path = raster->is_remote ? remote_vsi_path(raster->ctx, raster->path) : raster->path;
    if (!path) {
        return NULL;
    }
    GDALDatasetH dataset =
        GDALOpenEx(path, GDAL_OF_RASTER | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR,
                   raster->is_remote ? remote_drivers : ALLOWED_DRIVERS, options, NULL);
    if (path != raster->path) {
        mem_free(raster->ctx, path);
    }
    return dataset;
}

// Compressed tiles are unpacked on all cores; without compression those threads only cost.
static GDALDatasetH open_threaded(const struct raster *raster)
{
    GDALDatasetH dataset = open_with(raster, NULL);
    if (dataset && !raster->is_remote &&
        GDALGetMetadataItem(dataset, "COMPRESSION", "IMAGE_STRUCTURE") &&
        strcmp(GDALGetDriverShortName(GDALGetDatasetDriver(dataset)), "GTiff") == 0) {
        GDALClose(dataset);
        dataset = open_with(raster, (const char *const[]){"NUM_THREADS=ALL_CPUS", NULL});
    }
    return dataset;
}

static trl_result fail_to_open(const struct raster *raster, const struct gdal_catcher *catcher)
{
    const char *says = gdal_message_about(catcher, raster->path);
    return trl_fail(raster->ctx, raster->is_remote ? TRL_ERROR_IO : TRL_ERROR_INVALID,
                    TRL_LOG_ITEM_RASTER, "%s: %s%s%s%s", raster->path,
                    raster->is_remote ? "cannot be fetched, or is no GeoTIFF"
                                      : "it is no raster that can be read, or a broken one",
                    says[0] ? " (" : "", says, says[0] ? ")" : "");
}

static trl_result check_beside(const struct raster *raster)
{
    char *name = raster->is_remote ? NULL : beside_find_stranger(raster->path);
    if (!name) {
        return TRL_OK;
    }
    const trl_result result =
        trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                 "%s: \"%s\" beside it is no TIFF, and may lead elsewhere; move it away",
                 raster->path, name);
    CPLFree(name);
    return result;
}

static trl_result check_pointer(struct raster *raster)
{
    if (!raster->dataset || !beside_is_pointed_at(raster->dataset)) {
        return TRL_OK;
    }
    GDALClose(raster->dataset);
    raster->dataset = NULL;
    return fail_file(raster, TRL_ERROR_INVALID,
                     "it names another file as its overviews, and only those in it or beside it "
                     "are read; make them anew (gdaladdo -r average)");
}

static trl_result open_dataset(struct raster *raster, bool is_threaded)
{
    gdal_register();
    struct gdal_catcher catcher;
    gdal_catch_begin(&catcher, raster->ctx);
    trl_result result = check_beside(raster);
    if (result == TRL_OK) {
        remote_begin(raster->is_remote);
        raster->dataset = is_threaded ? open_threaded(raster) : open_with(raster, NULL);
        result = check_pointer(raster);
        remote_end(raster->is_remote);
    }
    if (result != TRL_OK) {
        gdal_catch_end(&catcher);
        return result;
    }
    if (raster->dataset && palette_is_there(raster->dataset)) {
        raster->dataset = palette_expand(raster->dataset);
        raster->has_palette = true;
    }
    gdal_catch_end(&catcher);
    return raster->dataset ? TRL_OK : fail_to_open(raster, &catcher);
}

trl_result raster_open(const trl_context *ctx, const char *path, struct raster *out)
{
    *out = (struct raster){
        .ctx = ctx, .path = mem_strdup(ctx, path), .is_remote = remote_is_path(path)};
    trl_result result = out->path ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = check_file(out);
    }
    if (result == TRL_OK) {
        result = open_dataset(out, true);
    }
    if (result == TRL_OK) {
        struct gdal_catcher catcher;
        gdal_catch_begin(&catcher, ctx);
        remote_begin(out->is_remote);
        result = raster_read_facts(out);
        if (result == TRL_OK) {
            result = raster_read_georeference(out);
        }
        remote_end(out->is_remote);
        gdal_catch_end(&catcher);
    }
    if (result != TRL_OK) {
        raster_finish(out);
    }
    return result;
}

trl_result raster_open_again(const struct raster *raster, struct raster *out)
{
    *out = *raster;
    out->dataset = out->source = NULL;
    out->path = mem_strdup(raster->ctx, raster->path);
    trl_result result = out->path ? open_dataset(out, false) : TRL_ERROR_MEMORY;
    if (result == TRL_OK && raster->source) {
        struct gdal_catcher catcher;
        gdal_catch_begin(&catcher, raster->ctx);
        remote_begin(out->is_remote);
        result = raster_warp(out);
        remote_end(out->is_remote);
        gdal_catch_end(&catcher);
    }
    if (result != TRL_OK) {
        raster_finish(out);
    }
    return result;
}

struct raster raster_reduced(const struct raster *raster, uint32_t width, uint32_t height)
{
    struct raster reduced = *raster;
    reduced.width = width;
    reduced.height = height;
    reduced.pixel_width_deg *= (double)raster->width / width;
    reduced.pixel_height_deg *= (double)raster->height / height;
    reduced.plane.pixel_width *= (double)raster->width / width;
    reduced.plane.pixel_height *= (double)raster->height / height;
    return reduced;
}

void raster_finish(struct raster *raster)
{
    if (raster->dataset) {
        struct gdal_catcher catcher;
        gdal_catch_begin(&catcher, raster->ctx);
        GDALClose(raster->dataset);
        if (raster->source) {
            GDALClose(raster->source);
        }
        gdal_catch_end(&catcher);
    }
    if (raster->path) {
        mem_free(raster->ctx, raster->path);
    }
    *raster = (struct raster){0};
}
