// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/voids.h"

#include <math.h>
#include <string.h>

enum { MAX_LEVELS = 24, SWEEPS = 12, COARSE_SWEEPS = 60 };
const float VOIDS_FAR = 1e12f; // squared; more than any raster's diagonal

// A gap is known as coarsely as its rim is far: at 8 texels from it, to 4.
static const double COARSER_TEXELS = 0.5;

struct cell {
    uint32_t x, y;
};

// A plane of numbers of which some are known and some are wanted, with its mip chain: means of what
// is known.
struct plane {
    const trl_context *ctx;
    int levels;
    uint32_t width[MAX_LEVELS], height[MAX_LEVELS];
    float *values[MAX_LEVELS];   // owned
    float *weights[MAX_LEVELS];  // owned; 0 unknown
    uint8_t *wanted[MAX_LEVELS]; // owned
    struct cell *places;         // owned; those of a level that are smoothed
};

static void plane_finish(struct plane *p)
{
    for (int i = 0; i < p->levels; i++) {
        mem_free(p->ctx, p->values[i]);
        mem_free(p->ctx, p->weights[i]);
        mem_free(p->ctx, p->wanted[i]);
    }
    mem_free(p->ctx, p->places);
}

static trl_result plane_init(const trl_context *ctx, uint32_t width, uint32_t height,
                             struct plane *out)
{
    *out = (struct plane){.ctx = ctx};
    for (bool is_last = false; !is_last && out->levels < MAX_LEVELS; out->levels++) {
        const int i = out->levels;
        out->width[i] = width;
        out->height[i] = height;
        out->values[i] = mem_alloc(ctx, (size_t)width * height, sizeof(float));
        out->weights[i] = mem_alloc(ctx, (size_t)width * height, sizeof(float));
        out->wanted[i] = mem_alloc(ctx, (size_t)width * height, 1);
        if (!out->values[i] || !out->weights[i] || !out->wanted[i]) {
            out->levels++;
            plane_finish(out);
            return TRL_ERROR_MEMORY;
        }
        is_last = width == 1 && height == 1;
        width = (width + 1) / 2;
        height = (height + 1) / 2;
    }
    return TRL_OK;
}

static void pull(struct plane *p, int level)
{
    const uint32_t width = p->width[level - 1], height = p->height[level - 1];
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++) {
            const size_t from = (size_t)y * width + x;
            const size_t to = (size_t)(y / 2) * p->width[level] + x / 2;
            p->values[level][to] += p->weights[level - 1][from] * p->values[level - 1][from];
            p->weights[level][to] += p->weights[level - 1][from];
            p->wanted[level][to] |= p->wanted[level - 1][from];
        }
    }
    const size_t count = (size_t)p->width[level] * p->height[level];
    for (size_t i = 0; i < count; i++) {
        if (p->weights[level][i] > 0) {
            p->values[level][i] /= p->weights[level][i];
            p->weights[level][i] = fminf(p->weights[level][i], 1);
        }
    }
}

// Linear between the centres of a coarser level's cells.
static float interpolate(const struct plane *p, int level, float x, float y)
{
    const float column = fmaxf(0, fminf(x, (float)p->width[level] - 1));
    const float row = fmaxf(0, fminf(y, (float)p->height[level] - 1));
    const uint32_t x0 = (uint32_t)column, y0 = (uint32_t)row;
    const uint32_t x1 = x0 + 1 < p->width[level] ? x0 + 1 : x0;
    const uint32_t y1 = y0 + 1 < p->height[level] ? y0 + 1 : y0;
    const float *upper = p->values[level] + (size_t)y0 * p->width[level];
    const float *lower = p->values[level] + (size_t)y1 * p->width[level];
    const float fx = column - (float)x0, fy = row - (float)y0;
    const float a = upper[x0] + fx * (upper[x1] - upper[x0]);
    const float b = lower[x0] + fx * (lower[x1] - lower[x0]);
    return a + fy * (b - a);
}

// Where a level is smoothed: what is not known and holds something that is wanted. What is known
// lies around that, so nothing else would reach it.
static size_t find_places(const struct plane *p, int level)
{
    const uint32_t width = p->width[level], height = p->height[level];
    size_t found = 0;
    for (uint32_t y = 0; y < height; y++) {
        const uint8_t *wanted = p->wanted[level] + (size_t)y * width;
        const float *weights = p->weights[level] + (size_t)y * width;
        for (uint32_t x = 0; x < width; x++) {
            if (wanted[x] && !(weights[x] > 0)) {
                p->places[found++] = (struct cell){x, y};
            }
        }
    }
    return found;
}

// Toward the mean of the four neighbours.
static void relax(struct plane *p, int level, size_t count)
{
    const uint32_t width = p->width[level], height = p->height[level];
    float *v = p->values[level];
    for (size_t k = 0; k < count; k++) {
        const uint32_t x = p->places[k].x, y = p->places[k].y;
        const size_t i = (size_t)y * width + x;
        const float left = v[x > 0 ? i - 1 : i], right = v[x + 1 < width ? i + 1 : i];
        const float up = v[y > 0 ? i - width : i], down = v[y + 1 < height ? i + width : i];
        v[i] = 0.25f * (left + right + up + down);
    }
}

// From the next coarser level where nothing is known; of the finest only what is wanted.
static void push(struct plane *p, int level)
{
    for (uint32_t y = 0; y < p->height[level]; y++) {
        for (uint32_t x = 0; x < p->width[level]; x++) {
            const size_t i = (size_t)y * p->width[level] + x;
            if (!(p->weights[level][i] > 0) && (level > 0 || p->wanted[level][i])) {
                p->values[level][i] =
                    interpolate(p, level + 1, 0.5f * (float)x - 0.25f, 0.5f * (float)y - 0.25f);
            }
        }
    }
}

// Fills what is wanted as evenly as what is known allows (nearly the solution of Laplace's
// equation: coarse levels give the shape, sweeps on each smooth it).
static trl_result spread(struct plane *p)
{
    size_t wanted = 0;
    for (size_t i = 0; i < (size_t)p->width[0] * p->height[0]; i++) {
        wanted += p->wanted[0][i];
    }
    p->places = mem_alloc(p->ctx, wanted, sizeof *p->places); // coarser levels have fewer
    if (!p->places) {
        return TRL_ERROR_MEMORY;
    }
    for (int level = 1; level < p->levels; level++) {
        pull(p, level);
    }
    for (int level = p->levels - 2; level >= 0; level--) {
        push(p, level);
        const size_t count = find_places(p, level);
        for (int i = 0; i < (level == 0 ? SWEEPS : COARSE_SWEEPS); i++) {
            relax(p, level, count);
        }
    }
    return TRL_OK;
}

// One line of squared distances, in place: the lower envelope of parabolas on each of its places
// (Felzenszwalb and Huttenlocher 2012, Theory of Computing 8). `scratch` holds 3 count + 1.
static void transform_line(float *line, size_t count, size_t stride, float *scratch)
{
    float *values = scratch, *starts = scratch + count, *places = starts + count + 1;
    for (size_t i = 0; i < count; i++) {
        values[i] = line[i * stride];
    }
    size_t last = 0;
    places[0] = 0;
    starts[0] = -VOIDS_FAR;
    for (size_t q = 1; q < count; q++) {
        const float x = (float)q;
        float meet = 0;
        for (;;) {
            const float p = places[last];
            meet = 0.5f * ((values[q] - values[(size_t)p]) / (x - p) + x + p);
            if (meet > starts[last] || last == 0) {
                break;
            }
            last--;
        }
        last += meet > starts[last];
        places[last] = x;
        starts[last] = last == 0 ? -VOIDS_FAR : meet;
    }
    size_t k = 0;
    for (size_t q = 0; q < count; q++) {
        while (k < last && starts[k + 1] < (float)q) {
            k++;
        }
        const float away = (float)q - places[k];
        line[q * stride] = away * away + values[(size_t)places[k]];
    }
}

trl_result voids_measure(const trl_context *ctx, const struct layer_frame *f, float *distance)
{
    const size_t longest = f->width > f->height ? f->width : f->height;
    float *scratch = mem_alloc(ctx, 3 * longest + 1, sizeof *scratch);
    if (!scratch) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t x = 0; x < f->width; x++) {
        transform_line(distance + x, f->height, f->width, scratch);
    }
    for (size_t y = 0; y < f->height; y++) {
        transform_line(distance + y * f->width, f->width, 1, scratch);
    }
    for (size_t i = 0; i < (size_t)f->width * f->height; i++) {
        distance[i] = sqrtf(distance[i]);
    }
    mem_free(ctx, scratch);
    return TRL_OK;
}

static double smooth_part(double x)
{
    const double t = fmax(0, fmin(1, x));
    return t * t * (3 - 2 * t);
}

static bool is_void(const struct layer_heights *h, double nodata, size_t i)
{
    return h->floats ? !isfinite(h->floats[i]) : (double)h->shorts[i] == nodata;
}

static bool has_void_beside(const uint8_t *voids, const struct layer_frame *f, size_t i)
{
    const size_t x = i % f->width, y = i / f->width;
    return (x > 0 && voids[i - 1]) || (x + 1 < f->width && voids[i + 1]) ||
           (y > 0 && voids[i - f->width]) || (y + 1 < f->height && voids[i + f->width]);
}

static double height_below(const struct layer_fill *below, const struct layer_frame *f, size_t i)
{
    const struct layer_geo g = layer_geo_of(f, (double)(i % f->width), (double)(i / f->width));
    return below->height(below->user, g.latitude, g.longitude);
}

struct gaps {
    uint8_t *voids;  // owned
    float *distance; // owned; to the rim, texels
    struct plane difference;
};

// The rim's differences to what is below are what is known.
static void measure_rim(const struct layer_fill *below, const struct terrain_layer *layer,
                        struct gaps *gaps)
{
    const struct layer_frame *f = &layer->frame;
    const int64_t count = (int64_t)f->width * f->height;
#pragma omp parallel for schedule(dynamic, 4096)
    for (int64_t i = 0; i < count; i++) {
        gaps->distance[i] = gaps->voids[i] ? VOIDS_FAR : 0;
        gaps->difference.wanted[0][i] = gaps->voids[i];
        if (!gaps->voids[i] && has_void_beside(gaps->voids, f, (size_t)i)) {
            const double height = layer_texel(layer, i % f->width, i / f->width);
            gaps->difference.values[0][i] = (float)(height - height_below(below, f, (size_t)i));
            gaps->difference.weights[0][i] = 1;
        }
    }
}

static trl_result fill_gaps(const struct layer_fill *below, struct gaps *gaps,
                            struct terrain_layer *layer)
{
    const struct layer_frame *f = &layer->frame;
    const int64_t count = (int64_t)f->width * f->height;
    gaps->distance = mem_alloc(layer->ctx, (size_t)count, sizeof(float));
    layer->heights.coarser = mem_alloc(layer->ctx, (size_t)count, 1);
    trl_result result = gaps->distance && layer->heights.coarser
                            ? plane_init(layer->ctx, f->width, f->height, &gaps->difference)
                            : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        return result;
    }
    measure_rim(below, layer, gaps);
    result = spread(&gaps->difference);
    if (result == TRL_OK) {
        result = voids_measure(layer->ctx, f, gaps->distance);
    }
    const double feather = fmax(f->feather / f->texel_height, 1);
#pragma omp parallel for schedule(dynamic, 4096)
    for (int64_t i = 0; i < (result == TRL_OK ? count : 0); i++) {
        const double away = (double)gaps->distance[i] / feather;
        if (gaps->voids[i]) {
            const double left = (1 - smooth_part(away)) * (double)gaps->difference.values[0][i];
            layer_set_texel(&layer->heights, (size_t)i, height_below(below, f, (size_t)i) + left);
        }
        const double coarser = log2(1 + COARSER_TEXELS * (double)gaps->distance[i]);
        layer->heights.coarser[i] = (uint8_t)lrint(fmin(coarser * LAYER_COARSER_STEPS, 255));
    }
    plane_finish(&gaps->difference);
    return result;
}

static trl_result fail_all_void(const struct raster *raster)
{
    return trl_fail(
        raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
        "%s: no pixel of it has data; is its missing value right? (gdalinfo; gdal_translate "
        "-a_nodata)",
        raster->path);
}

trl_result voids_fill_heights(const struct raster *raster, const struct layer_fill *below,
                              struct terrain_layer *layer)
{
    const struct layer_heights *h = &layer->heights;
    const size_t count = (size_t)layer->frame.width * layer->frame.height;
    if (h->shorts && !raster->has_nodata) {
        return TRL_OK;
    }
    struct gaps gaps = {.voids = mem_alloc(layer->ctx, count, 1)};
    if (!gaps.voids) {
        return TRL_ERROR_MEMORY;
    }
    size_t voids = 0;
#pragma omp parallel for reduction(+ : voids)
    for (size_t i = 0; i < count; i++) {
        gaps.voids[i] = is_void(h, raster->nodata, i);
        voids += gaps.voids[i];
    }
    trl_result result = voids == count ? fail_all_void(raster) : TRL_OK;
    if (result == TRL_OK && voids > 0) {
        result = fill_gaps(below, &gaps, layer);
    }
    mem_free(layer->ctx, gaps.voids);
    mem_free(layer->ctx, gaps.distance);
    return result;
}

// Colours of the pixels that have one, spread over those that have none.
static trl_result spread_channel(const trl_context *ctx, const struct layer_frame *f, int channel,
                                 uint8_t *rgba)
{
    struct plane plane;
    trl_result result = plane_init(ctx, f->width, f->height, &plane);
    if (result != TRL_OK) {
        return result;
    }
    const size_t count = (size_t)f->width * f->height;
    for (size_t i = 0; i < count; i++) {
        plane.values[0][i] = rgba[4 * i + (size_t)channel];
        plane.weights[0][i] = rgba[4 * i + 3] > 0 ? 1 : 0;
        plane.wanted[0][i] = rgba[4 * i + 3] == 0;
    }
    result = spread(&plane);
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        rgba[4 * i + (size_t)channel] = (uint8_t)lrintf(plane.values[0][i]);
    }
    plane_finish(&plane);
    return result;
}

trl_result voids_spread_colours(const trl_context *ctx, const struct layer_frame *f, uint8_t *rgba)
{
    trl_result result = TRL_OK;
    for (int channel = 0; channel < 3 && result == TRL_OK; channel++) {
        result = spread_channel(ctx, f, channel, rgba);
    }
    return result;
}

double voids_weight(double distance, double feather)
{
    return smooth_part((distance - 0.5) / feather);
}

static trl_result feather_alpha(const trl_context *ctx, const struct layer_frame *f, uint8_t *rgba)
{
    const size_t count = (size_t)f->width * f->height;
    float *distance = mem_alloc(ctx, count, sizeof *distance);
    if (!distance) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < count; i++) {
        distance[i] = rgba[4 * i + 3] > 0 ? VOIDS_FAR : 0;
    }
    const trl_result result = voids_measure(ctx, f, distance);
    const double feather = fmax(f->feather / f->texel_height, 1);
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        const double weight = voids_weight((double)distance[i], feather);
        rgba[4 * i + 3] = (uint8_t)lrint(weight * rgba[4 * i + 3]);
    }
    mem_free(ctx, distance);
    return result;
}

trl_result voids_fill_picture(const struct raster *raster, const struct layer_frame *f,
                              uint8_t *rgba)
{
    const size_t count = (size_t)f->width * f->height;
    size_t voids = 0;
#pragma omp parallel for reduction(+ : voids)
    for (size_t i = 0; i < count; i++) {
        voids += rgba[4 * i + 3] == 0;
    }
    trl_result result = voids == count ? fail_all_void(raster) : TRL_OK;
    if (result == TRL_OK && voids > 0) {
        result = voids_spread_colours(raster->ctx, f, rgba);
    }
    if (result == TRL_OK && voids > 0 && !raster->has_alpha) {
        result = feather_alpha(raster->ctx, f, rgba);
    }
    return result;
}
