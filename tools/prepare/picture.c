// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "prepare.h"

#include "raster/gdal.h"

#include <gdal.h>
#include <math.h>
#include <unistd.h>

char *source_path(const struct places *places, const char *relative)
{
    return mem_printf(places->ctx, "%s/%s", places->source_dir, relative);
}

bool source_exists(const struct places *places, const char *relative)
{
    char *path = source_path(places, relative);
    const bool exists = path && access(path, R_OK) == 0;
    mem_free(places->ctx, path);
    return exists;
}

// Pictures of packages have no georeference and may be of any shape, so they are not opened as
// rasters.
static trl_result read_dataset(const struct places *places, GDALDatasetH dataset,
                               struct picture *out)
{
    const int width = GDALGetRasterXSize(dataset);
    const int height = GDALGetRasterYSize(dataset);
    const int bands = GDALGetRasterCount(dataset);
    *out = (struct picture){(uint32_t)width, (uint32_t)height, (uint32_t)bands, NULL};
    out->pixels = mem_alloc(places->ctx, (size_t)width * (size_t)height, (size_t)bands);
    if (!out->pixels) {
        return TRL_ERROR_MEMORY;
    }
    const CPLErr error =
        GDALDatasetRasterIOEx(dataset, GF_Read, 0, 0, width, height, out->pixels, width, height,
                              GDT_Byte, bands, NULL, bands, (GSpacing)bands * width, 1, NULL);
    return error == CE_None ? TRL_OK : TRL_ERROR_IO;
}

static trl_result read_opacity(const struct places *places, GDALDatasetH dataset,
                               struct picture *out)
{
    const GDALColorTableH palette = GDALGetRasterColorTable(GDALGetRasterBand(dataset, 1));
    const trl_result result = read_dataset(places, dataset, out);
    if (result != TRL_OK || out->bands != 1 || !palette) {
        return TRL_ERROR_IO;
    }
    uint8_t opacity[256] = {0};
    for (int i = 0; i < GDALGetColorEntryCount(palette) && i < 256; i++) {
        opacity[i] = (uint8_t)GDALGetColorEntry(palette, i)->c4;
    }
    for (size_t i = 0; i < (size_t)out->width * out->height; i++) {
        out->pixels[i] = opacity[out->pixels[i]];
    }
    return TRL_OK;
}

static trl_result read_with(const struct places *places, const char *relative,
                            trl_result (*read)(const struct places *, GDALDatasetH,
                                               struct picture *),
                            struct picture *out)
{
    *out = (struct picture){0};
    char *path = source_path(places, relative);
    if (!path) {
        return TRL_ERROR_MEMORY;
    }
    static const char *const DRIVERS[] = {"JPEG", "PNG", NULL};
    gdal_register();
    struct gdal_catcher catcher;
    gdal_catch_begin(&catcher, places->ctx);
    const GDALDatasetH dataset =
        GDALOpenEx(path, GDAL_OF_RASTER | GDAL_OF_VERBOSE_ERROR, DRIVERS, NULL, NULL);
    trl_result result = dataset ? read(places, dataset, out) : TRL_ERROR_IO;
    if (dataset) {
        GDALClose(dataset);
    }
    gdal_catch_end(&catcher);
    if (result == TRL_OK && catcher.message[0]) {
        result = TRL_ERROR_IO; // the picture ends early
    }
    if (result == TRL_ERROR_IO) {
        (void)trl_fail(places->ctx, result, TRL_LOG_ITEM_FILE_READ, "cannot read %s: %s", path,
                       catcher.message[0] ? catcher.message : "not a picture");
        picture_finish(places, out);
    }
    mem_free(places->ctx, path);
    return result;
}

trl_result picture_read(const struct places *places, const char *relative, struct picture *out)
{
    return read_with(places, relative, read_dataset, out);
}

trl_result picture_read_opacity(const struct places *places, const char *relative,
                                struct picture *out)
{
    return read_with(places, relative, read_opacity, out);
}

trl_result picture_read_globe(const struct places *places, const char *relative,
                              struct picture *out)
{
    const trl_result result = picture_read(places, relative, out);
    if (result == TRL_OK && out->width != 2 * out->height) {
        return trl_fail(places->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: is %u x %u; must be a whole globe", relative, out->width, out->height);
    }
    return result;
}

void picture_finish(const struct places *places, struct picture *picture)
{
    mem_free(places->ctx, picture->pixels);
    *picture = (struct picture){0};
}

static double fetch(const struct picture *p, uint32_t band, int64_t column, int64_t row)
{
    const int64_t width = p->width;
    const int64_t height = p->height;
    column = (column % width + width) % width;
    row = row < 0 ? 0 : row >= height ? height - 1 : row;
    return p->pixels[(row * width + column) * p->bands + band];
}

double picture_sample(const struct picture *picture, uint32_t band, double u, double v)
{
    const double x = u * picture->width - 0.5;
    const double y = v * picture->height - 0.5;
    const int64_t column = (int64_t)floor(x);
    const int64_t row = (int64_t)floor(y);
    const double fx = x - (double)column;
    const double fy = y - (double)row;
    const double north =
        (1 - fx) * fetch(picture, band, column, row) + fx * fetch(picture, band, column + 1, row);
    const double south = (1 - fx) * fetch(picture, band, column, row + 1) +
                         fx * fetch(picture, band, column + 1, row + 1);
    return (1 - fy) * north + fy * south;
}

trl_result picture_write(const struct places *places, const char *name,
                         const struct picture *picture)
{
    const struct geotiff g = {.name = name,
                              .width = picture->width,
                              .height = picture->height,
                              .bands = picture->bands,
                              .kind = PIXEL_UINT8,
                              .west_deg = -180,
                              .north_deg = 90,
                              .pixel_width_deg = 360.0 / picture->width,
                              .pixel_height_deg = 180.0 / picture->height,
                              .pixels = picture->pixels};
    return geotiff_write(places, &g);
}
