// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The surroundings of the poles, from rasters of the whole globe.
#include "prepare.h"

#include "raster/gdal.h"

#include <gdal.h>
#include <math.h>
#include <ogr_srs_api.h>
#include <string.h>

#define PI 3.14159265358979323846

// Half a side and the system: 70 degrees is 2 R tan(10 degrees) from the pole.
static const struct polar_map {
    const char *body, *suffix, *projection;
    double half_m;
} MAPS[] = {
    {"earth", "north", "EPSG:3413", 2.2e6},
    {"earth", "south", "EPSG:3031", 2.2e6},
    {"mars", "north", "+proj=stere +lat_0=90 +lon_0=0 +k=1 +R=3396190 +units=m +no_defs", 1.2e6},
    {"mars", "south", "+proj=stere +lat_0=-90 +lon_0=0 +k=1 +R=3396190 +units=m +no_defs", 1.2e6}};

// Pixels to a cell of the globe: with one, what two filters blur would show.
static const double FINENESS = 2;

// Along a parallel the mean is taken over so many heights of a cell: of heights less shows rays,
// which their columns make; of pictures more blurs.
static const double HEIGHTS_WIDTH = 2.2, PICTURE_WIDTH = 0.75;

// Corners of a map are 61 degrees of latitude: rows from 54 on are looked at.
struct resampler {
    const struct globe_values *globe;
    uint32_t rows; // from either pole
    int32_t *sums; // owned; of each of their rows and bands, width + 1 of what lies to the left
};

static int32_t value_at(const struct globe_values *g, size_t index)
{
    return g->shorts ? g->shorts[index] : g->bytes[index];
}

static trl_result sum_rows(const struct places *places, struct resampler *r)
{
    const struct globe_values *g = r->globe;
    const size_t stride = (size_t)g->width + 1;
    r->rows = g->height / 5;
    r->sums = mem_alloc(places->ctx, stride * 2 * r->rows, g->bands * sizeof *r->sums);
    for (size_t k = 0; k < 2 * (size_t)r->rows && r->sums; k++) {
        const size_t row = k < r->rows ? k : g->height - 2 * (size_t)r->rows + k;
        for (size_t band = 0; band < g->bands; band++) {
            int32_t *sums = r->sums + (k * g->bands + band) * stride;
            sums[0] = 0;
            for (size_t x = 0; x < g->width; x++) {
                sums[x + 1] = sums[x] + value_at(g, (row * g->width + x) * g->bands + band);
            }
        }
    }
    return r->sums ? TRL_OK : TRL_ERROR_MEMORY;
}

// The sum left of a fractional column; whole turns count as often as they are.
static double sum_before(const int32_t *sums, uint32_t width, double column)
{
    const double turns = floor(column / width);
    const double x = column - turns * width;
    const uint32_t i = (uint32_t)fmin(x, width - 1);
    const double part = (x - i) * (sums[i + 1] - sums[i]);
    return turns * sums[width] + sums[i] + part;
}

// The mean of a row over as many columns as a pixel is wide there; rows over a pole are those of
// the opposite meridian.
static double row_mean(const struct resampler *r, uint32_t band, double column, int64_t row)
{
    const struct globe_values *g = r->globe;
    if (row < 0 || row >= (int64_t)g->height) {
        row = row < 0 ? -1 - row : 2 * (int64_t)g->height - 1 - row;
        column += g->width / 2.0;
    }
    // The last row of pictures is what their makers' tools left at the pole.
    if (g->bytes) {
        row = row < 1 ? 1 : row > (int64_t)g->height - 2 ? (int64_t)g->height - 2 : row;
    }
    const double latitude = PI / 2 - PI * ((double)row + 0.5) / g->height;
    const double width = g->shorts ? HEIGHTS_WIDTH : PICTURE_WIDTH;
    const double columns = fmin(fmax(1, width / cos(latitude)), g->width / 2.0);
    const int64_t first_south = (int64_t)g->height - 2 * (int64_t)r->rows;
    const size_t kept = (size_t)(row < (int64_t)r->rows ? row : row - first_south);
    const int32_t *sums = r->sums + (kept * g->bands + band) * ((size_t)g->width + 1);
    return (sum_before(sums, g->width, column + columns / 2) -
            sum_before(sums, g->width, column - columns / 2)) /
           columns;
}

// Column and row of a place, (0, 0) the corner of the first cell.
static double sample(const struct resampler *r, uint32_t band, double column, double row)
{
    const double upper = floor(row - 0.5);
    const double part = row - 0.5 - upper;
    return (1 - part) * row_mean(r, band, column, (int64_t)upper) +
           part * row_mean(r, band, column, (int64_t)upper + 1);
}

static bool place_row(OGRCoordinateTransformationH to_degrees, const struct geotiff *g,
                      uint32_t row, double *x, double *y)
{
    for (uint32_t i = 0; i < g->width; i++) {
        x[i] = g->left_m + (i + 0.5) * g->pixel_m;
        y[i] = g->top_m - (row + 0.5) * g->pixel_m;
    }
    return OCTTransform(to_degrees, (int)g->width, x, y, NULL) != 0;
}

struct line {
    uint32_t row;
    const double *longitude_deg, *latitude_deg;
};

// Bands interleaved, of the globe's type, into `pixels`.
static void fill_row(const struct resampler *r, const struct geotiff *g, struct line line,
                     void *pixels)
{
    int16_t *shorts = pixels;
    uint8_t *bytes = pixels;
    for (uint32_t i = 0; i < g->width; i++) {
        const double column = (line.longitude_deg[i] + 180) / 360 * r->globe->width;
        const double row = (90 - line.latitude_deg[i]) / 180 * r->globe->height;
        for (uint32_t band = 0; band < g->bands; band++) {
            const size_t to = ((size_t)line.row * g->width + i) * g->bands + band;
            const double value = sample(r, band, column, row);
            if (g->kind == PIXEL_INT16) {
                shorts[to] = (int16_t)lrint(value);
            } else {
                bytes[to] = (uint8_t)lrint(value);
            }
        }
    }
}

static trl_result fill_map(const struct places *places, const struct resampler *r,
                           const struct geotiff *g, void *pixels)
{
    gdal_register();
    double *x = mem_alloc(places->ctx, g->width, sizeof *x);
    double *y = mem_alloc(places->ctx, g->width, sizeof *y);
    const OGRSpatialReferenceH srs = OSRNewSpatialReference(NULL);
    const bool is_known = OSRSetFromUserInput(srs, g->projection) == OGRERR_NONE;
    const OGRSpatialReferenceH geographic = is_known ? OSRCloneGeogCS(srs) : NULL;
    OGRCoordinateTransformationH t = NULL;
    if (geographic) {
        OSRSetAxisMappingStrategy(srs, OAMS_TRADITIONAL_GIS_ORDER);
        OSRSetAxisMappingStrategy(geographic, OAMS_TRADITIONAL_GIS_ORDER);
        t = OCTNewCoordinateTransformation(srs, geographic);
        OSRDestroySpatialReference(geographic);
    }
    OSRDestroySpatialReference(srs);
    bool is_filled = x && y && t;
    for (uint32_t row = 0; row < g->height && is_filled; row++) {
        is_filled = place_row(t, g, row, x, y);
        if (is_filled) {
            fill_row(r, g, (struct line){row, x, y}, pixels);
        }
    }
    if (t) {
        OCTDestroyCoordinateTransformation(t);
    }
    mem_free(places->ctx, x);
    mem_free(places->ctx, y);
    return is_filled ? TRL_OK
                     : trl_fail(places->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_RASTER,
                                "%s: PROJ cannot tell where its pixels lie", g->name);
}

static trl_result write_map(const struct places *places, const struct polar_map *map,
                            const char *name, const struct resampler *r)
{
    const struct globe_values *globe = r->globe;
    char *file = mem_printf(places->ctx, "%s-%s.tif", name, map->suffix);
    // From the rows in 40 degrees of latitude, in steps of 256.
    const uint32_t side = (uint32_t)ceil(FINENESS * globe->height / 4.5 / 256) * 256;
    struct geotiff g = {.name = file,
                        .width = side,
                        .height = side,
                        .bands = globe->bands,
                        .kind = globe->shorts ? PIXEL_INT16 : PIXEL_UINT8,
                        .projection = map->projection,
                        .left_m = -map->half_m,
                        .top_m = map->half_m,
                        .pixel_m = 2 * map->half_m / side,
                        .unit = globe->shorts ? "metre" : NULL};
    void *pixels = mem_alloc(places->ctx, (size_t)side * side,
                             g.bands * (globe->shorts ? sizeof(int16_t) : 1));
    trl_result result = file && pixels ? fill_map(places, r, &g, pixels) : TRL_ERROR_MEMORY;
    g.pixels = pixels;
    if (result == TRL_OK) {
        result = geotiff_write(places, &g);
    }
    mem_free(places->ctx, pixels);
    mem_free(places->ctx, file);
    return result;
}

trl_result polar_prepare(const struct places *places, const char *body, const char *name,
                         const struct globe_values *globe)
{
    struct resampler resampler = {.globe = globe};
    trl_result result = sum_rows(places, &resampler);
    for (size_t i = 0; i < sizeof MAPS / sizeof MAPS[0] && result == TRL_OK; i++) {
        if (strcmp(MAPS[i].body, body) == 0) {
            result = write_map(places, &MAPS[i], name, &resampler);
        }
    }
    mem_free(places->ctx, resampler.sums);
    return result;
}
