// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/raster.h"

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
        return fail_file(raster, TRL_ERROR_IO, "not a file");
    }
    if (info.st_size == 0) {
        return fail_file(raster, TRL_ERROR_INVALID, "the file is empty");
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

static trl_result open_dataset(struct raster *raster, bool is_threaded)
{
    gdal_register();
    struct gdal_catcher catcher;
    gdal_catch_begin(&catcher, raster->ctx);
    remote_begin(raster->is_remote);
    raster->dataset = is_threaded ? open_threaded(raster) : open_with(raster, NULL);
    remote_end(raster->is_remote);
    if (raster->dataset && palette_is_there(raster->dataset)) {
        raster->dataset = palette_expand(raster->dataset);
        raster->has_palette = true;
    }
    gdal_catch_end(&catcher);
    if (!raster->dataset && raster->is_remote) {
        return fail_file(raster, TRL_ERROR_IO,
                         catcher.message[0] ? catcher.message
                                            : "cannot be fetched, or is no GeoTIFF");
    }
    if (!raster->dataset) {
        return fail_file(raster, TRL_ERROR_INVALID,
                         catcher.message[0] ? catcher.message : "not a raster");
    }
    return TRL_OK;
}

trl_result raster_read_size_and_type(struct raster *raster)
{
    const int width = GDALGetRasterXSize(raster->dataset);
    const int height = GDALGetRasterYSize(raster->dataset);
    const int bands = GDALGetRasterCount(raster->dataset);
    if (width < 1 || height < 1 || width > RASTER_MAX_SIDE || height > RASTER_MAX_SIDE) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d x %d pixels; sides from 1 to %d can be read", raster->path, width,
                        height, RASTER_MAX_SIDE);
    }
    if (bands < 1 || bands > RASTER_MAX_BANDS) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d bands; 1 to %d can be read", raster->path, bands, RASTER_MAX_BANDS);
    }
    raster->width = raster->file_width = (uint32_t)width;
    raster->height = raster->file_height = (uint32_t)height;
    raster->band_count = (uint32_t)bands;
    const GDALRasterBandH band = GDALGetRasterBand(raster->dataset, 1);
    const GDALDataType type = GDALGetRasterDataType(band);
    if (GDALDataTypeIsComplex(type)) {
        return fail_file(raster, TRL_ERROR_INVALID, "its pixels are complex numbers");
    }
    raster->type = type == GDT_Byte    ? RASTER_UINT8
                   : type == GDT_Int16 ? RASTER_INT16
                                       : RASTER_FLOAT;
    // An alpha band that warping (source is set) or a palette adds only says where nothing is.
    if (!raster->source) {
        raster->has_alpha = !raster->has_palette && type == GDT_Byte && (bands == 2 || bands == 4);
    }
    const int flags = GDALGetMaskFlags(band);
    raster->has_mask = (flags & GMF_PER_DATASET) && !(flags & (GMF_ALPHA | GMF_NODATA));
    if (raster->has_mask && raster->type == RASTER_INT16) {
        raster->type = RASTER_FLOAT; // with a number for what the mask leaves out
    }
    int has_nodata = 0;
    raster->nodata = GDALGetRasterNoDataValue(band, &has_nodata);
    raster->has_nodata = has_nodata != 0;
    return TRL_OK;
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
        result = raster_read_size_and_type(out);
        if (result == TRL_OK) {
            result = raster_read_georeference(out);
        }
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
        result = raster_warp(out);
        gdal_catch_end(&catcher);
    }
    if (result != TRL_OK) {
        raster_finish(out);
    }
    return result;
}

// The band, or its overview of exactly this size; NULL when there is none.
static GDALRasterBandH find_level(const struct raster *raster, uint32_t band, uint32_t width,
                                  uint32_t height)
{
    const GDALRasterBandH base = GDALGetRasterBand(raster->dataset, (int)band + 1);
    if (width == raster->file_width && height == raster->file_height) {
        return base;
    }
    for (int i = 0; i < GDALGetOverviewCount(base); i++) {
        const GDALRasterBandH overview = GDALGetOverview(base, i);
        if (overview && GDALGetRasterBandXSize(overview) == (int)width &&
            GDALGetRasterBandYSize(overview) == (int)height) {
            return overview;
        }
    }
    return NULL;
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

bool raster_has_overview(const struct raster *raster, uint32_t width, uint32_t height)
{
    return find_level(raster, 0, width, height) != NULL;
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

struct raster_window raster_window_whole(const struct raster *raster, uint32_t max_side)
{
    struct raster_window window = {
        0, 0, raster->width, raster->height, raster->width, raster->height};
    const uint32_t longest = raster->width > raster->height ? raster->width : raster->height;
    if (max_side > 0 && longest > max_side) {
        // A whole ratio where possible would keep every output pixel's area alike; the nearest size
        // is what callers with a texture limit want.
        const double scale = (double)max_side / longest;
        window.out_width = (uint32_t)fmax(1, round(raster->width * scale));
        window.out_height = (uint32_t)fmax(1, round(raster->height * scale));
    }
    return window;
}

static trl_result check_window(const struct raster *raster, const struct raster_window *w,
                               uint32_t band)
{
    if (w->width == 0 || w->height == 0 || w->x >= raster->width || w->y >= raster->height ||
        w->width > raster->width - w->x || w->height > raster->height - w->y || w->out_width == 0 ||
        w->out_height == 0 || w->out_width > w->width || w->out_height > w->height ||
        band >= raster->band_count) {
        return trl_fail(
            raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
            "%s: window %u,%u %u x %u to %u x %u of band %u is outside %u x %u, %u bands",
            raster->path, w->x, w->y, w->width, w->height, w->out_width, w->out_height, band,
            raster->width, raster->height, raster->band_count);
    }
    return TRL_OK;
}

// Where pixels go: `pixel_bytes` from one to the next.
struct destination {
    void *pixels;
    GDALDataType type;
    int pixel_bytes;
    bool is_mask; // of the mask in place of the band
};

// Which pixels of which band of the file a window is: an overview's, or a fraction of the file's.
struct origin {
    GDALRasterBandH band;
    double x, y, width, height;
};

static struct origin find_origin(const struct raster *raster, const struct raster_window *w,
                                 uint32_t band)
{
    const GDALRasterBandH exact = find_level(raster, band, raster->width, raster->height);
    const double sx = exact ? 1 : (double)raster->file_width / raster->width;
    const double sy = exact ? 1 : (double)raster->file_height / raster->height;
    return (struct origin){exact ? exact : GDALGetRasterBand(raster->dataset, (int)band + 1),
                           w->x * sx, w->y * sy, w->width * sx, w->height * sy};
}

static CPLErr read_origin(const struct origin *from, const struct raster_window *w,
                          const struct destination *to)
{
    GDALRasterIOExtraArg extra;
    INIT_RASTERIO_EXTRA_ARG(extra);
    extra.eResampleAlg = GRIORA_Average;
    extra.bFloatingPointWindowValidity = TRUE;
    extra.dfXOff = from->x;
    extra.dfYOff = from->y;
    extra.dfXSize = from->width;
    extra.dfYSize = from->height;
    const int x = (int)from->x, y = (int)from->y;
    const int right = (int)fmin(ceil(from->x + from->width), GDALGetRasterBandXSize(from->band));
    const int bottom = (int)fmin(ceil(from->y + from->height), GDALGetRasterBandYSize(from->band));
    return GDALRasterIOEx(from->band, GF_Read, x, y, right - x, bottom - y, to->pixels,
                          (int)w->out_width, (int)w->out_height, to->type, to->pixel_bytes,
                          (GSpacing)to->pixel_bytes * w->out_width, &extra);
}

static trl_result fail_to_read(const struct raster *raster, const char *gdal_says)
{
    return trl_fail(raster->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_RASTER, "%s: %s%s%s%s", raster->path,
                    raster->is_remote
                        ? "its server did not send the pixels that it was asked for"
                        : "its pixels cannot be read; the file is cut short or broken",
                    gdal_says[0] ? " (" : "", gdal_says, gdal_says[0] ? ")" : "");
}

static trl_result read_band(const struct raster *raster, const struct raster_window *w,
                            uint32_t band, const struct destination *to)
{
    trl_result result = check_window(raster, w, band);
    if (result != TRL_OK) {
        return result;
    }
    struct gdal_catcher catcher;
    gdal_catch_begin(&catcher, raster->ctx);
    remote_begin(raster->is_remote);
    // Uncompressed GeoTIFFs are read to where they shall be, not through a cache of blocks.
    CPLSetThreadLocalConfigOption("GTIFF_DIRECT_IO", "YES");
    struct origin from = find_origin(raster, w, band);
    if (to->is_mask) {
        from.band = GDALGetMaskBand(from.band);
    }
    const CPLErr error = read_origin(&from, w, to);
    CPLSetThreadLocalConfigOption("GTIFF_DIRECT_IO", NULL);
    remote_end(raster->is_remote);
    gdal_catch_end(&catcher);
    // Some drivers (libpng, libjpeg) report a file that ends early and still say that all is well.
    if (error != CE_None || catcher.message[0]) {
        result = fail_to_read(raster, catcher.message);
    }
    return result;
}

// NaN where the mask says that there is nothing.
static trl_result apply_mask(const struct raster *raster, const struct raster_window *window,
                             float *out)
{
    const size_t count = (size_t)window->out_width * window->out_height;
    uint8_t *mask = mem_alloc(raster->ctx, count, 1);
    if (!mask) {
        return TRL_ERROR_MEMORY;
    }
    const struct destination to = {mask, GDT_Byte, 1, true};
    const trl_result result = read_band(raster, window, 0, &to);
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        out[i] = mask[i] < 128 ? NAN : out[i];
    }
    mem_free(raster->ctx, mask);
    return result;
}

trl_result raster_read_float(const struct raster *raster, const struct raster_window *window,
                             uint32_t band, float *out)
{
    const struct destination to = {out, GDT_Float32, sizeof *out, false};
    const trl_result result = read_band(raster, window, band, &to);
    if (result == TRL_OK && raster->has_mask) {
        return apply_mask(raster, window, out);
    }
    if (result != TRL_OK || !raster->has_nodata) {
        return result;
    }
    const float nodata = (float)raster->nodata;
    const size_t count = (size_t)window->out_width * window->out_height;
    for (size_t i = 0; i < count; i++) {
        if (out[i] == nodata) {
            out[i] = NAN;
        }
    }
    return TRL_OK;
}

static trl_result check_uint8(const struct raster *raster)
{
    return raster->type == RASTER_UINT8
               ? TRL_OK
               : fail_file(raster, TRL_ERROR_INVALID,
                           "its pixels are not of 8 bits (gdal_translate -ot Byte -scale)");
}

// Alpha of a picture that has none: 0 where a pixel has no data (every colour band is nodata).
static void fill_alpha(const struct raster *raster, size_t count, uint8_t *rgba)
{
    for (size_t i = 0; i < count; i++) {
        uint8_t *pixel = rgba + 4 * i;
        const bool is_void = raster->has_nodata && pixel[0] == raster->nodata &&
                             pixel[1] == raster->nodata && pixel[2] == raster->nodata;
        pixel[3] = is_void ? 0 : 255;
    }
}

trl_result raster_read_rgba8(const struct raster *raster, const struct raster_window *window,
                             uint8_t *out)
{
    trl_result result = check_uint8(raster);
    const bool is_grey = raster->band_count < 3;
    const bool is_masked = raster->has_mask;
    const bool has_alpha = raster->band_count == 2 || raster->band_count == 4 || is_masked;
    for (uint32_t channel = 0; channel < 4 && result == TRL_OK; channel++) {
        if (channel == 3 && !has_alpha) {
            break;
        }
        const bool is_mask = channel == 3 && is_masked;
        const uint32_t last = is_masked ? 0 : raster->band_count - 1;
        const uint32_t band = channel == 3 ? last : is_grey ? 0 : channel;
        const struct destination to = {out + channel, GDT_Byte, 4, is_mask};
        result = read_band(raster, window, band, &to);
    }
    if (result == TRL_OK && !has_alpha) {
        fill_alpha(raster, (size_t)window->out_width * window->out_height, out);
    }
    return result;
}

trl_result raster_read_uint8(const struct raster *raster, const struct raster_window *window,
                             uint32_t band, uint8_t *out)
{
    const struct destination to = {out, GDT_Byte, 1, false};
    const trl_result result = check_uint8(raster);
    return result == TRL_OK ? read_band(raster, window, band, &to) : result;
}

trl_result raster_read_int16(const struct raster *raster, const struct raster_window *window,
                             uint32_t band, int16_t *out)
{
    const struct destination to = {out, GDT_Int16, sizeof *out, false};
    return read_band(raster, window, band, &to);
}
