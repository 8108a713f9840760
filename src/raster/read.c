// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pixels of an open raster: windows of its bands, of its mask, and of pictures as RGBA.
#include "raster/raster.h"

#include "raster/gdal.h"
#include "raster/remote.h"

#include <cpl_conv.h>
#include <gdal.h>
#include <math.h>

// Larger ones are missing values that a file forgot to name: the least float is a usual one.
static const float LARGEST_VALUE = 1e30f;

static trl_result fail_file(const struct raster *raster, trl_result code, const char *why)
{
    return trl_fail(raster->ctx, code, TRL_LOG_ITEM_RASTER, "%s: %s", raster->path, why);
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

bool raster_has_overview(const struct raster *raster, uint32_t width, uint32_t height)
{
    // GDAL looks for overviews when it is asked for the first one, and may complain then.
    struct gdal_catcher catcher;
    gdal_catch_begin(&catcher, raster->ctx);
    remote_begin(raster->is_remote);
    const bool is_there = find_level(raster, 0, width, height) != NULL;
    remote_end(raster->is_remote);
    gdal_catch_end(&catcher);
    return is_there;
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

static trl_result fail_to_read(const struct raster *raster, const struct gdal_catcher *catcher)
{
    const char *says = gdal_message_about(catcher, raster->path);
    return trl_fail(raster->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_RASTER, "%s: %s%s%s%s", raster->path,
                    raster->is_remote ? "its server did not send the pixels that it was asked for"
                                      : "its pixels cannot be read; the file is cut short or "
                                        "broken: fetch or copy it again",
                    says[0] ? " (" : "", says, says[0] ? ")" : "");
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
    // A JPEG that ends early would be grey from there on.
    CPLSetThreadLocalConfigOption("GDAL_ERROR_ON_LIBJPEG_WARNING", "YES");
    struct origin from = find_origin(raster, w, band);
    if (to->is_mask) {
        from.band = GDALGetMaskBand(from.band);
    }
    const CPLErr error = read_origin(&from, w, to);
    CPLSetThreadLocalConfigOption("GDAL_ERROR_ON_LIBJPEG_WARNING", NULL);
    CPLSetThreadLocalConfigOption("GTIFF_DIRECT_IO", NULL);
    remote_end(raster->is_remote);
    gdal_catch_end(&catcher);
    // Some drivers (libpng, libjpeg) report a file that ends early and still say that all is well.
    if (error != CE_None || catcher.message[0]) {
        result = fail_to_read(raster, &catcher);
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
    // Where there is no missing value a comparison with NaN never holds.
    const float nodata = raster->has_nodata ? (float)raster->nodata : NAN;
    const size_t count = (size_t)window->out_width * window->out_height;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        if (out[i] == nodata || !(fabsf(out[i]) < LARGEST_VALUE)) {
            out[i] = NAN;
        }
    }
    return result;
}

static trl_result check_uint8(const struct raster *raster)
{
    return raster->type == RASTER_UINT8
               ? TRL_OK
               : fail_file(raster, TRL_ERROR_INVALID,
                           "its pixels are not of 8 bits; make them so (gdal_translate -ot Byte "
                           "-scale)");
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
    const bool has_alpha = raster->colour_bands[3] >= 0 || raster->has_mask;
    for (uint32_t channel = 0; channel < (has_alpha ? 4 : 3) && result == TRL_OK; channel++) {
        const bool is_mask = channel == 3 && raster->has_mask;
        const uint32_t band = is_mask ? 0 : (uint32_t)raster->colour_bands[channel];
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
