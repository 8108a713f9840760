// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/pyramid.h"

#include <math.h>
#include <string.h>

// Longest side of the finest level that is held whole. Where a file has no overviews a tile of the
// level below it averages (PYRAMID_TILE * 2^level)^2 pixels: the larger, the fewer.
enum {
    BASE_SIDE = 1024,
    BASE_SIDE_WITHOUT_OVERVIEWS = 4096,
    CHEAP_SIDE = 8192,
    CHEAP_PIXELS = CHEAP_SIDE * CHEAP_SIDE / 2,
    STRIP_ROWS = 32
};

// Files without overviews are read whole at each start; of so many pixels that is a quarter of an
// hour at the 40 million a second that GDAL averages of a plain file.
static const double MOST_PIXELS_AT_ONCE = 3.6e10;

size_t pyramid_texel_bytes(enum pyramid_format format)
{
    switch (format) {
    case PYRAMID_INT16:
        return 2;
    case PYRAMID_FLOAT:
    case PYRAMID_RGBA8:
        return 4;
    case PYRAMID_UINT8:
        break;
    }
    return 1;
}

static uint32_t halve_up(uint32_t n)
{
    return (n + 1) / 2;
}

static uint32_t count_tiles(uint32_t texels)
{
    return (texels + PYRAMID_TILE - 1) / PYRAMID_TILE;
}

static uint32_t longest_side(const struct pyramid_level *level)
{
    return level->width > level->height ? level->width : level->height;
}

static void make_levels(struct pyramid *p)
{
    uint32_t width = p->raster.width, height = p->raster.height;
    do {
        p->levels[p->level_count++] =
            (struct pyramid_level){width, height, count_tiles(width), count_tiles(height)};
        width = halve_up(width);
        height = halve_up(height);
    } while (longest_side(&p->levels[p->level_count - 1]) > PYRAMID_TILE);
}

// Whether coarse tiles can be read without going through the whole file.
static bool has_cheap_overview(const struct pyramid *p)
{
    // A long strip has few pixels, however long.
    bool is_cheap = longest_side(&p->levels[0]) <= CHEAP_SIDE ||
                    (double)p->raster.width * p->raster.height <= CHEAP_PIXELS;
    for (uint32_t i = 1; i < p->level_count && !is_cheap; i++) {
        is_cheap = longest_side(&p->levels[i]) <= CHEAP_SIDE &&
                   raster_has_overview(&p->raster, p->levels[i].width, p->levels[i].height);
    }
    return is_cheap;
}

static trl_result choose_base(struct pyramid *p)
{
    const bool is_cheap = has_cheap_overview(p);
    const double megabytes =
        (double)p->raster.width * p->raster.height * (double)pyramid_texel_bytes(p->format) / 1e6;
    if (!is_cheap && p->raster.is_remote) {
        return trl_fail(p->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %u x %u pixels without overviews: all %.0f MB would have to be "
                        "fetched; make a cloud-optimised GeoTIFF of it (gdal_translate -of COG)",
                        p->raster.path, p->raster.width, p->raster.height, megabytes);
    }
    if (!is_cheap && (double)p->raster.width * p->raster.height > MOST_PIXELS_AT_ONCE) {
        return trl_fail(
            p->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
            "%s: %u x %u pixels without overviews: to read all %.0f MB would take hours; "
            "make overviews once (gdaladdo -r average)",
            p->raster.path, p->raster.width, p->raster.height, megabytes);
    }
    if (!is_cheap) {
        trl_log(p->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                "%s: %u x %u pixels without overviews: all %.0f MB are read now; "
                "'gdaladdo -r average' on it would spare that",
                p->raster.path, p->raster.width, p->raster.height, megabytes);
    }
    const uint32_t side = is_cheap ? BASE_SIDE : BASE_SIDE_WITHOUT_OVERVIEWS;
    while (longest_side(&p->levels[p->base_level]) > side) {
        p->base_level++;
    }
    return TRL_OK;
}

// In strips, so that it can be stopped.
static trl_result read_base(struct pyramid *p)
{
    const struct pyramid_level *level = &p->levels[p->base_level];
    uint8_t *texels = p->whole[p->base_level];
    const size_t row_bytes = level->width * pyramid_texel_bytes(p->format);
    const struct raster reduced = raster_reduced(&p->raster, level->width, level->height);
    trl_result result = TRL_OK;
    for (uint32_t y = 0; y < level->height && result == TRL_OK; y += STRIP_ROWS) {
        const uint32_t rows = level->height - y < STRIP_ROWS ? level->height - y : STRIP_ROWS;
        const struct raster_window w = {0, y, level->width, rows, level->width, rows};
        result = trl_progress(p->ctx, "reading rasters", (double)y / level->height);
        if (result == TRL_OK) {
            result = pyramid_read_pixels(p, &reduced, &w, texels + y * row_bytes);
        }
    }
    return result;
}

static uint32_t count_channels(enum pyramid_format format)
{
    return format == PYRAMID_RGBA8 ? 4 : 1;
}

static double get_value(const struct pyramid *p, const void *texels, size_t i)
{
    switch (p->format) {
    case PYRAMID_INT16:
        return ((const int16_t *)texels)[i];
    case PYRAMID_FLOAT:
        return (double)((const float *)texels)[i];
    case PYRAMID_RGBA8:
    case PYRAMID_UINT8:
        break;
    }
    return ((const uint8_t *)texels)[i];
}

static void set_value(const struct pyramid *p, void *texels, size_t i, double value)
{
    switch (p->format) {
    case PYRAMID_INT16:
        ((int16_t *)texels)[i] = (int16_t)lrint(value);
        return;
    case PYRAMID_FLOAT:
        ((float *)texels)[i] = (float)value;
        return;
    case PYRAMID_RGBA8:
    case PYRAMID_UINT8:
        break;
    }
    ((uint8_t *)texels)[i] = (uint8_t)lrint(value);
}

// How much a texel counts in a mean: nothing where it is void, and colours by their alpha.
static double weigh_texel(const struct pyramid *p, const void *texels, size_t i)
{
    switch (p->format) {
    case PYRAMID_INT16:
        return p->raster.has_nodata && ((const int16_t *)texels)[i] == p->raster.nodata ? 0 : 1;
    case PYRAMID_FLOAT:
        return isnan(((const float *)texels)[i]) ? 0 : 1;
    case PYRAMID_RGBA8:
        return ((const uint8_t *)texels)[4 * i + 3] + 1e-3;
    case PYRAMID_UINT8:
        break;
    }
    return 1;
}

// The texels of a finer level below one of the next: a span along one axis.
struct span {
    uint32_t first, count;
    double weights[3];
};

static struct span find_span(uint32_t fine, uint32_t coarse, uint32_t i)
{
    const double size = (double)fine / coarse; // from 1 to 2
    const double from = i * size, to = (i + 1) * size;
    struct span span = {.first = (uint32_t)floor(from + 1e-9)};
    for (uint32_t k = span.first; k < fine && k < to - 1e-9 && span.count < 3; k++) {
        span.weights[span.count++] = fmin(k + 1, to) - fmax(k, from);
    }
    return span;
}

static void reduce_texel(const struct pyramid *p, uint32_t level, uint32_t x, uint32_t y)
{
    const struct pyramid_level *fine = &p->levels[level - 1], *coarse = &p->levels[level];
    const struct span across = find_span(fine->width, coarse->width, x);
    const struct span down = find_span(fine->height, coarse->height, y);
    const uint32_t channels = count_channels(p->format);
    const void *from = p->whole[level - 1];
    double sums[4] = {0}, weight = 0, area = 0, alpha = 0;
    for (uint32_t j = 0; j < down.count; j++) {
        for (uint32_t i = 0; i < across.count; i++) {
            const size_t texel = (size_t)(down.first + j) * fine->width + across.first + i;
            const double part = down.weights[j] * across.weights[i];
            const double w = part * weigh_texel(p, from, texel);
            for (uint32_t c = 0; c < channels && w > 0; c++) {
                sums[c] += w * get_value(p, from, texel * channels + c);
            }
            alpha += channels == 4 ? part * get_value(p, from, texel * channels + 3) : 0;
            weight += w;
            area += part;
        }
    }
    const size_t to = (size_t)y * coarse->width + x;
    for (uint32_t c = 0; c < channels; c++) {
        const double empty = p->format == PYRAMID_INT16 ? p->raster.nodata : (double)NAN;
        const double mean = c == 3 ? alpha / area : weight > 0 ? sums[c] / weight : empty;
        set_value(p, p->whole[level], to * channels + c, mean);
    }
}

static trl_result hold_coarse(struct pyramid *p)
{
    const size_t texel = pyramid_texel_bytes(p->format);
    trl_result result = TRL_OK;
    for (uint32_t i = p->base_level; i < p->level_count && result == TRL_OK; i++) {
        const size_t count = (size_t)p->levels[i].width * p->levels[i].height;
        p->whole[i] = mem_alloc(p->ctx, count, texel);
        p->bytes += count * texel;
        result = p->whole[i] ? TRL_OK : TRL_ERROR_MEMORY;
        if (result == TRL_OK && i == p->base_level) {
            result = read_base(p);
        }
        for (uint32_t y = 0; y < p->levels[i].height && i > p->base_level && p->whole[i]; y++) {
            for (uint32_t x = 0; x < p->levels[i].width; x++) {
                reduce_texel(p, i, x, y);
            }
        }
    }
    return result;
}

trl_result pyramid_init(const trl_context *ctx, const struct pyramid_desc *desc,
                        struct pyramid *out)
{
    *out = (struct pyramid){.ctx = ctx,
                            .format = desc->format,
                            .wraps = desc->wraps,
                            .over_north = desc->over_north && desc->wraps,
                            .over_south = desc->over_south && desc->wraps};
    trl_result result = raster_open_again(desc->raster, &out->raster);
    if (result == TRL_OK) {
        make_levels(out);
        result = choose_base(out);
    }
    if (result == TRL_OK) {
        result = hold_coarse(out);
    }
    if (result != TRL_OK) {
        pyramid_finish(out);
    }
    return result;
}

void pyramid_finish(struct pyramid *pyramid)
{
    for (uint32_t i = 0; i < pyramid->level_count; i++) {
        mem_free(pyramid->ctx, pyramid->whole[i]);
    }
    raster_finish(&pyramid->raster);
    *pyramid = (struct pyramid){0};
}
