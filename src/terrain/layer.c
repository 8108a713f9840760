// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/layer.h"

#include "shared/cubic.glsl"
#include "terrain/stream.h"
#include "terrain/voids.h"

#include <math.h>
#include <string.h>

enum { STRIP_ROWS = 128 }; // converted and uploaded at a time: what is held twice stays small

static struct raster_window texture_window(const struct raster *raster, const struct gpu *gpu)
{
    return raster_window_whole(raster, gpu ? gpu->caps.max_texture_size : 0);
}

struct layer_frame layer_frame_for(const struct raster *raster, const struct gpu *gpu,
                                   double feather)
{
    const struct raster_window window = texture_window(raster, gpu);
    return layer_frame_of(raster, window.out_width, window.out_height, feather);
}

double layer_texel(const struct terrain_layer *layer, int64_t x, int64_t y)
{
    const struct layer_heights *h = &layer->heights;
    const size_t i = layer_texel_index(&layer->frame, x, y);
    return h->offset_m + h->scale * (h->shorts ? (double)h->shorts[i] : (double)h->floats[i]);
}

void layer_set_texel(struct layer_heights *h, size_t i, double metres)
{
    const double value = (metres - h->offset_m) / h->scale;
    if (h->shorts) {
        h->shorts[i] = (int16_t)lrint(fmax(INT16_MIN, fmin(INT16_MAX, value)));
    } else {
        h->floats[i] = (float)value;
    }
}

const struct layer_frame *layer_finest_frame(const struct terrain_layer *layer)
{
    return layer->tiles ? &layer->tiles->frame : &layer->frame;
}

double layer_coarser(const struct terrain_layer *layer, double x, double y)
{
    const uint8_t *coarser = layer->heights.coarser;
    if (!coarser) {
        return 0;
    }
    const int64_t column = (int64_t)floor(x), row = (int64_t)floor(y);
    const double fx = x - (double)column, fy = y - (double)row;
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double weight = (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
        sum += weight * coarser[layer_texel_index(&layer->frame, column + k % 2, row + k / 2)];
    }
    return sum / LAYER_COARSER_STEPS;
}

double layer_sample(const struct terrain_layer *layer, double x, double y)
{
    return layer->tiles ? stream_sample(layer->stream, layer->tiles, x, y)
                        : layer_sample_held(layer, x, y);
}

double layer_sample_linear(const struct terrain_layer *layer, double x, double y)
{
    return layer->tiles ? stream_sample_linear(layer->stream, layer->tiles, x, y)
                        : layer_sample_held_linear(layer, x, y);
}

double layer_sample_held_linear(const struct terrain_layer *layer, double x, double y)
{
    const int64_t column = (int64_t)floor(x), row = (int64_t)floor(y);
    const double fx = x - (double)column, fy = y - (double)row;
    const double north =
        (1 - fx) * layer_texel(layer, column, row) + fx * layer_texel(layer, column + 1, row);
    const double south = (1 - fx) * layer_texel(layer, column, row + 1) +
                         fx * layer_texel(layer, column + 1, row + 1);
    return (1 - fy) * north + fy * south;
}

void layer_sample_roots(const struct terrain_layer *layer, double x, double y, double rgba[4])
{
    if (layer->tiles) {
        stream_sample_picture(layer->stream, layer->tiles, x, y, rgba);
    } else {
        layer_sample_held_roots(layer, x, y, rgba);
    }
}

void layer_sample_held_roots(const struct terrain_layer *layer, double x, double y, double rgba[4])
{
    const double column = floor(x), row = floor(y);
    const double part_x = x - column, part_y = y - row;
    for (int c = 0; c < 4; c++) {
        rgba[c] = 0;
    }
    for (int k = 0; k < 4; k++) {
        const double weight = (k % 2 ? part_x : 1 - part_x) * (k / 2 ? part_y : 1 - part_y);
        const size_t texel =
            layer_texel_index(&layer->frame, (int64_t)column + k % 2, (int64_t)row + k / 2);
        for (size_t c = 0; c < 4; c++) {
            rgba[c] += weight * layer->roots[4 * texel + c] / 255;
        }
    }
}

double layer_sample_held(const struct terrain_layer *layer, double x, double y)
{
    const int64_t column = (int64_t)floor(x);
    const int64_t row = (int64_t)floor(y);
    const double fx = x - (double)column;
    double rows[4];
    for (int j = 0; j < 4; j++) {
        double t[4];
        for (int i = 0; i < 4; i++) {
            t[i] = layer_texel(layer, column - 1 + i, row - 1 + j);
        }
        rows[j] = cubic_blend(fx, t[0], t[1], t[2], t[3]);
    }
    return cubic_blend(y - (double)row, rows[0], rows[1], rows[2], rows[3]);
}

static trl_result read_texels(const struct raster *raster, struct terrain_layer *layer)
{
    const struct raster_window w =
        raster_window_whole(raster, layer->frame.width > layer->frame.height ? layer->frame.width
                                                                             : layer->frame.height);
    const size_t count = (size_t)layer->frame.width * layer->frame.height;
    struct layer_heights *h = &layer->heights;
    if (raster->type == RASTER_FLOAT) {
        h->floats = mem_alloc(layer->ctx, count, sizeof *h->floats);
        return h->floats ? raster_read_float(raster, &w, 0, h->floats) : TRL_ERROR_MEMORY;
    }
    h->shorts = mem_alloc(layer->ctx, count, sizeof *h->shorts);
    return h->shorts ? raster_read_int16(raster, &w, 0, h->shorts) : TRL_ERROR_MEMORY;
}

// Mean over as many columns as a texel is narrower than high: all of them in the last row, so that
// the pole has one height, and no spikes around it.
static void level_row(struct terrain_layer *layer, uint32_t y, double *sums)
{
    const struct layer_frame *f = &layer->frame;
    const double latitude = layer_geo_of(f, 0, y).latitude;
    const double columns = f->texel_height / (f->texel_width * fmax(cos(latitude), 1e-9));
    const int64_t width = f->width;
    // Half a circle at the last but one row already covers both sides of the pole.
    const int64_t half = columns >= (double)width / 8 ? (width - 1) / 2 : (int64_t)(columns / 2);
    sums[0] = 0;
    for (int64_t x = 0; x < width + 2 * half; x++) {
        sums[x + 1] = sums[x] + layer_texel(layer, x - half, y);
    }
    for (int64_t x = 0; x < width; x++) {
        const double mean = (sums[x + 2 * half + 1] - sums[x]) / (double)(2 * half + 1);
        layer_set_texel(&layer->heights, (size_t)y * f->width + (size_t)x, mean);
    }
}

static trl_result level_poles(struct terrain_layer *layer)
{
    const struct layer_frame *f = &layer->frame;
    if (!f->is_whole_circle || f->width < 8) {
        return TRL_OK;
    }
    double *sums = mem_alloc(layer->ctx, 2 * (size_t)f->width + 1, sizeof *sums);
    if (!sums) {
        return TRL_ERROR_MEMORY;
    }
    // From 3.6 degrees of the pole, where a texel is 16 times as high as wide.
    const uint32_t rows = (uint32_t)fmin(1.0 / (16 * f->texel_height), f->height / 2.0);
    for (uint32_t i = 0; i < rows && f->touches_north; i++) {
        level_row(layer, i, sums);
    }
    for (uint32_t i = 0; i < rows && f->touches_south; i++) {
        level_row(layer, f->height - 1 - i, sums);
    }
    mem_free(layer->ctx, sums);
    return TRL_OK;
}

trl_result layer_read_heights(const struct raster *raster, const struct layer_fill *below,
                              struct terrain_layer *layer)
{
    trl_result result = read_texels(raster, layer);
    if (result == TRL_OK) {
        result = voids_fill_heights(raster, below, layer);
    }
    return result == TRL_OK ? level_poles(layer) : result;
}

trl_result layer_take_heights(const struct raster *raster, const void *texels,
                              const struct layer_fill *below, struct terrain_layer *layer)
{
    const size_t count = (size_t)layer->frame.width * layer->frame.height;
    struct layer_heights *h = &layer->heights;
    const bool is_float = raster->type == RASTER_FLOAT;
    void *copy = mem_alloc(layer->ctx, count, is_float ? sizeof *h->floats : sizeof *h->shorts);
    if (!copy) {
        return TRL_ERROR_MEMORY;
    }
    memcpy(copy, texels, count * (is_float ? sizeof *h->floats : sizeof *h->shorts));
    h->floats = is_float ? copy : NULL;
    h->shorts = is_float ? NULL : copy;
    const trl_result result = voids_fill_heights(raster, below, layer);
    return result == TRL_OK ? level_poles(layer) : result;
}

static struct gpu_texture_desc describe_texture(const struct layer_frame *frame)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.width = frame->width;
    desc.height = frame->height;
    desc.levels = 0;
    desc.filter = GPU_FILTER_TRILINEAR;
    desc.wrap_x = frame->is_whole_circle ? GPU_WRAP_REPEAT : GPU_WRAP_CLAMP;
    desc.anisotropy = 1;
    return desc;
}

// Texels on the CPU: one of the pointers, of `channels` components each.
struct texels {
    const uint8_t *bytes;
    const int16_t *shorts;
    const float *floats;
    uint32_t width, height, channels;
};

static size_t component_bytes(const struct texels *t)
{
    return t->bytes ? sizeof *t->bytes : t->shorts ? sizeof *t->shorts : sizeof *t->floats;
}

// Means of 2 x 2 texels; beyond the border stands the border's own. The types differ in how sums
// are rounded.
#define DEFINE_HALVE(name, type, mean)                                                             \
    static void name(const type *from, const struct texels *t, type *to)                           \
    {                                                                                              \
        const uint32_t width = t->width > 1 ? t->width / 2 : 1;                                    \
        const uint32_t height = t->height > 1 ? t->height / 2 : 1;                                 \
        const size_t n = t->channels;                                                              \
        const size_t right = t->width > 1 ? n : 0;                                                 \
        const size_t down = t->height > 1 ? (size_t)t->width * n : 0;                              \
        _Pragma("omp parallel for if (height >= 256)") for (uint32_t y = 0; y < height; y++)       \
        {                                                                                          \
            const type *in = from + 2 * (size_t)y * t->width * n;                                  \
            type *out = to + (size_t)y * width * n;                                                \
            for (uint32_t x = 0; x < width; x++) {                                                 \
                for (size_t c = 0; c < n; c++) {                                                   \
                    const type *p = in + 2 * (size_t)x * n + c;                                    \
                    out[x * n + c] = (type)(mean);                                                 \
                }                                                                                  \
            }                                                                                      \
        }                                                                                          \
    }
DEFINE_HALVE(halve_bytes, uint8_t, (p[0] + p[right] + p[down] + p[right + down] + 2) >> 2)
DEFINE_HALVE(halve_shorts, int16_t, (p[0] + p[right] + p[down] + p[right + down] + 2) >> 2)
DEFINE_HALVE(halve_floats, float, (p[0] + p[right] + p[down] + p[right + down]) * 0.25f)
#undef DEFINE_HALVE

// The next level, written to `to`.
static struct texels halve(const struct texels *t, void *to)
{
    struct texels half = {.width = t->width > 1 ? t->width / 2 : 1,
                          .height = t->height > 1 ? t->height / 2 : 1,
                          .channels = t->channels};
    if (t->bytes) {
        halve_bytes(t->bytes, t, to);
        half.bytes = to;
    } else if (t->shorts) {
        halve_shorts(t->shorts, t, to);
        half.shorts = to;
    } else {
        halve_floats(t->floats, t, to);
        half.floats = to;
    }
    return half;
}

// Shorts as the texture wants them: steps from the lowest, or floats.
static void convert_shorts(const int16_t *from, size_t count, enum gpu_format format, void *strip)
{
    uint16_t *steps = strip;
    float *floats = strip;
    for (size_t i = 0; i < count && format == GPU_FORMAT_R16; i++) {
        steps[i] = (uint16_t)(from[i] - INT16_MIN);
    }
    for (size_t i = 0; i < count && format == GPU_FORMAT_R32F; i++) {
        floats[i] = from[i];
    }
}

static trl_result upload_level(struct terrain_layer *layer, uint32_t level, const struct texels *t,
                               void *strip)
{
    if (!t->shorts) {
        const struct gpu_region all = gpu_texture_region(&layer->texture, level);
        return gpu_texture_upload(&layer->texture, &all,
                                  t->bytes ? (const void *)t->bytes : t->floats);
    }
    trl_result result = TRL_OK;
    for (uint32_t y = 0; y < t->height && result == TRL_OK; y += STRIP_ROWS) {
        const uint32_t left = t->height - y;
        const uint32_t rows = left < STRIP_ROWS ? left : STRIP_ROWS;
        convert_shorts(t->shorts + (size_t)y * t->width, (size_t)rows * t->width,
                       layer->texture.format, strip);
        const struct gpu_region region = {level, 0, y, 0, t->width, rows, 1};
        result = gpu_texture_upload(&layer->texture, &region, strip);
    }
    return result;
}

// All levels. Made here and not by the GPU: software compiles a program for each format, which
// takes longer, and where 32F is not filtered there are no mips of it.
static trl_result upload_levels(struct terrain_layer *layer, const struct texels *t)
{
    const size_t half = ((size_t)t->width / 2 + 1) * (t->height / 2 + 1) * t->channels;
    void *levels[2] = {mem_alloc(layer->ctx, half, component_bytes(t)),
                       mem_alloc(layer->ctx, half, component_bytes(t))};
    void *strip = mem_alloc(layer->ctx, (size_t)STRIP_ROWS * t->width, sizeof(float));
    trl_result result = levels[0] && levels[1] && strip ? TRL_OK : TRL_ERROR_MEMORY;
    struct texels at = *t;
    for (uint32_t i = 0; i < layer->texture.levels && result == TRL_OK; i++) {
        at = i == 0 ? at : halve(&at, levels[i % 2]);
        result = upload_level(layer, i, &at, strip);
    }
    mem_free(layer->ctx, strip);
    mem_free(layer->ctx, levels[0]);
    mem_free(layer->ctx, levels[1]);
    return result;
}

void layer_scale_texture(const struct gpu *gpu, struct terrain_layer *layer)
{
    const struct layer_heights *h = &layer->heights;
    const bool is_norm = h->shorts && !h->coarser && gpu->caps.has_norm16;
    layer->texture_steps = is_norm ? UINT16_MAX : 0;
    layer->texture_scale_m = is_norm ? UINT16_MAX * h->scale : h->scale;
    layer->texture_offset_m = h->offset_m + (is_norm ? INT16_MIN * h->scale : 0);
}

// Heights, and how coarse they are, side by side.
static trl_result upload_with_gaps(struct gpu *gpu, struct gpu_texture_desc desc,
                                   struct terrain_layer *layer)
{
    const struct layer_heights *h = &layer->heights;
    const size_t count = (size_t)layer->frame.width * layer->frame.height;
    float *pairs = mem_alloc(layer->ctx, 2 * count, sizeof *pairs);
    if (!pairs) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < count; i++) {
        pairs[2 * i] = h->shorts ? (float)h->shorts[i] : h->floats[i];
        pairs[2 * i + 1] = (float)h->coarser[i] / LAYER_COARSER_STEPS;
    }
    desc.format = GPU_FORMAT_RG32F;
    const struct texels texels = {
        .floats = pairs, .width = layer->frame.width, .height = layer->frame.height, .channels = 2};
    trl_result result = gpu_texture_init(gpu, &desc, &layer->texture);
    if (result == TRL_OK) {
        result = upload_levels(layer, &texels);
    }
    mem_free(layer->ctx, pairs);
    return result;
}

trl_result layer_upload_heights(struct gpu *gpu, struct terrain_layer *layer)
{
    if (!gpu) {
        return TRL_OK;
    }
    const struct layer_heights *h = &layer->heights;
    struct gpu_texture_desc desc = describe_texture(&layer->frame);
    const bool is_norm = h->shorts && !h->coarser && gpu->caps.has_norm16;
    layer_scale_texture(gpu, layer);
    desc.label = "elevation";
    desc.format = is_norm ? GPU_FORMAT_R16 : GPU_FORMAT_R32F;
    if (!is_norm && !gpu->caps.has_float_linear) {
        desc.filter = GPU_FILTER_NEAREST; // terrain/layers.glsl filters by itself
    }
    if (h->coarser) {
        return upload_with_gaps(gpu, desc, layer);
    }
    const struct texels texels = {.shorts = h->shorts,
                                  .floats = h->floats,
                                  .width = layer->frame.width,
                                  .height = layer->frame.height,
                                  .channels = 1};
    const trl_result result = gpu_texture_init(gpu, &desc, &layer->texture);
    return result == TRL_OK ? upload_levels(layer, &texels) : result;
}

// sRGB byte to the square root of its linear value: filtered as it is, it wastes no steps on dark
// ground and is what the surface buffers hold.
static void make_root_table(uint8_t table[256])
{
    for (int i = 0; i < 256; i++) {
        const double s = i / 255.0;
        const double linear = s <= 0.04045 ? s / 12.92 : pow((s + 0.055) / 1.055, 2.4);
        table[i] = (uint8_t)lrint(sqrt(linear) * 255);
    }
}

struct layer_cover layer_cover_of(const float rgb[3])
{
    struct layer_cover cover = {.is_there = true};
    for (int c = 0; c < 3; c++) {
        cover.roots[c] = (uint8_t)lrint(255 * sqrt(fmax(0, fmin(1, (double)rgb[c]))));
    }
    return cover;
}

static void take_cover(const struct layer_cover *cover, uint8_t *rgba, size_t count)
{
#pragma omp parallel for if (count > 1000000)
    for (size_t i = 0; i < count; i++) {
        rgba[4 * i + 3] = (uint8_t)((rgba[4 * i] * rgba[4 * i + 3] + 127) / 255);
        for (int c = 0; c < 3; c++) {
            rgba[4 * i + c] = cover->roots[c];
        }
    }
}

void layer_take_roots(const struct layer_cover *cover, uint8_t *rgba, size_t count)
{
    uint8_t table[256];
    if (cover->is_there) {
        take_cover(cover, rgba, count);
        return;
    }
    make_root_table(table);
#pragma omp parallel for if (count > 1000000)
    for (size_t i = 0; i < count; i++) {
        for (int c = 0; c < 3; c++) {
            rgba[4 * i + c] = table[rgba[4 * i + c]];
        }
    }
}

static trl_result upload_bytes(struct gpu *gpu, enum gpu_format format, const uint8_t *bytes,
                               struct terrain_layer *layer)
{
    struct gpu_texture_desc desc = describe_texture(&layer->frame);
    desc.label = format != GPU_FORMAT_RGBA8 ? "mask" : "picture";
    desc.format = format;
    const struct texels texels = {.bytes = bytes,
                                  .width = layer->frame.width,
                                  .height = layer->frame.height,
                                  .channels = gpu_format_channels(format)};
    const trl_result result = gpu_texture_init(gpu, &desc, &layer->texture);
    return result == TRL_OK ? upload_levels(layer, &texels) : result;
}

trl_result layer_load_picture(struct gpu *gpu, const struct raster *raster,
                              const struct layer_touch *touch, struct terrain_layer *layer)
{
    const struct raster_window w = texture_window(raster, gpu);
    const size_t count = (size_t)w.out_width * w.out_height;
    uint8_t *rgba = mem_alloc(layer->ctx, count, 4);
    trl_result result = rgba ? raster_read_rgba8(raster, &w, rgba) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = voids_fill_picture(raster, &layer->frame, rgba);
    }
    if (result == TRL_OK && touch) {
        result = touch->touch(touch->user, layer, rgba);
    }
    if (result == TRL_OK) {
        layer_take_roots(&layer->cover, rgba, count);
        layer->roots = gpu ? NULL : rgba;
        result = gpu ? upload_bytes(gpu, GPU_FORMAT_RGBA8, rgba, layer) : TRL_OK;
    }
    if (rgba == layer->roots) {
        return result;
    }
    mem_free(layer->ctx, rgba);
    return result;
}

trl_result layer_load_normals(struct gpu *gpu, const struct raster *raster,
                              struct terrain_layer *layer)
{
    const struct raster_window w = texture_window(raster, gpu);
    uint8_t *rgba = mem_alloc(layer->ctx, (size_t)w.out_width * w.out_height, 4);
    trl_result result = rgba ? raster_read_rgba8(raster, &w, rgba) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = voids_fill_picture(raster, &layer->frame, rgba);
    }
    if (result == TRL_OK && gpu) {
        result = upload_bytes(gpu, GPU_FORMAT_RGBA8, rgba, layer);
    }
    mem_free(layer->ctx, rgba);
    return result;
}

trl_result layer_load_mask(struct gpu *gpu, const struct raster *raster,
                           struct terrain_layer *layer, uint8_t **bytes)
{
    const struct raster_window w = texture_window(raster, gpu);
    *bytes = mem_alloc(layer->ctx, (size_t)w.out_width * w.out_height, 1);
    trl_result result = *bytes ? raster_read_uint8(raster, &w, 0, *bytes) : TRL_ERROR_MEMORY;
    if (result == TRL_OK && gpu) {
        result = upload_bytes(gpu, GPU_FORMAT_R8, *bytes, layer);
    }
    return result;
}

trl_result layer_upload_mask(struct gpu *gpu, const uint8_t *bytes, const uint8_t *others,
                             struct terrain_layer *layer)
{
    const size_t count = (size_t)layer->frame.width * layer->frame.height;
    uint8_t *pairs = mem_alloc(layer->ctx, count, 2);
    if (!pairs) {
        return TRL_ERROR_MEMORY;
    }
#pragma omp parallel for if (count > 1000000)
    for (size_t i = 0; i < count; i++) {
        pairs[2 * i] = bytes[i];
        pairs[2 * i + 1] = others[i];
    }
    const trl_result result = upload_bytes(gpu, GPU_FORMAT_RG8, pairs, layer);
    mem_free(layer->ctx, pairs);
    return result;
}

void layer_finish(struct terrain_layer *layer)
{
    if (layer->ctx) {
        mem_free(layer->ctx, layer->heights.shorts);
        mem_free(layer->ctx, layer->heights.floats);
        mem_free(layer->ctx, layer->heights.coarser);
        mem_free(layer->ctx, layer->roots);
        if (!layer->tiles) {
            gpu_texture_finish(&layer->texture);
        }
    }
    *layer = (struct terrain_layer){0};
}
