// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/surface.h"

#include "shared/cubic.glsl"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *const KIND_NAMES[SURFACE_KIND_COUNT] = {"elevation", "colour", "water",
                                                           "lights"};
// Bytes a texel on both sides, mips included: heights are held as floats on the GPU and as read on
// the CPU.
static const double KIND_TEXEL_BYTES[SURFACE_KIND_COUNT] = {4 * 4.0 / 3 + 4, 4 * 4.0 / 3, 4.0 / 3,
                                                            4 * 4.0 / 3};

struct surface_desc surface_desc_default(void)
{
    return (struct surface_desc){
        .radius_m = 1, .default_albedo = {0.3f, 0.3f, 0.3f}, .max_bytes = 3e9};
}

// What is needed while loading only.
struct loader {
    const struct surface_desc *desc;
    struct surface *surface;
    uint8_t *masks[SURFACE_MAX_LAYERS]; // owned; bytes of the water layers
    double bytes;
};

static double altitude_at(const struct surface *s, double latitude, double longitude)
{
    double altitude = 0;
    for (size_t i = 0; i < s->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *layer = &s->layers[SURFACE_ELEVATION][i];
        const struct layer_place place = layer_locate(&layer->frame, latitude, longitude);
        if (place.weight > 0) {
            altitude += place.weight * (layer_sample(layer, place.x, place.y) - altitude);
        }
    }
    return altitude;
}

static double fill_height(const void *user, double latitude, double longitude)
{
    return altitude_at(user, latitude, longitude);
}

// What the last mask that covers a place says, for a row of places in equal steps; 0 where none
// does. Masks are equirectangular, so a row of places is a row of the mask.
static void read_mask_row(const struct loader *loader, const struct layer_frame *f, uint32_t y,
                          uint8_t *row)
{
    const struct surface *s = loader->surface;
    const double latitude = f->centre_latitude + f->half_height - (y + 0.5) * f->texel_height;
    const double west = f->centre_longitude - f->half_width;
    for (size_t i = 0; i < s->counts[SURFACE_WATER]; i++) {
        const struct layer_frame *m = &s->layers[SURFACE_WATER][i].frame;
        const struct layer_place first = layer_locate(m, latitude, west + 0.5 * f->texel_width);
        const double step = f->texel_width / m->texel_width;
        const uint8_t *texels =
            loader->masks[i] + layer_texel_index(m, 0, (int64_t)floor(first.y + 0.5));
        const bool is_alike = m->is_whole_circle && m->width == f->width && fabs(first.x) < 0.5;
        if (is_alike && first.weight > 0) {
            memcpy(row, texels, m->width);
            continue;
        }
        for (uint32_t x = 0; x < f->width && m->is_whole_circle && first.weight > 0; x++) {
            const uint32_t column = (uint32_t)(first.x + 0.5 + x * step);
            row[x] = texels[column < m->width ? column : column - m->width];
        }
        for (uint32_t x = 0; x < f->width && !m->is_whole_circle; x++) {
            const struct layer_place p =
                layer_locate(m, latitude, west + (x + 0.5) * f->texel_width);
            row[x] = p.weight > 0 ? loader->masks[i][layer_texel_index(m, lrint(p.x), lrint(p.y))]
                                  : row[x];
        }
    }
}

static void raise_row(const struct layer_frame *f, const struct layer_heights *h, uint32_t y,
                      const uint8_t *mask)
{
    const int16_t zero_short = (int16_t)fmax(INT16_MIN, fmin(INT16_MAX, -h->offset_m / h->scale));
    const float zero_float = (float)(-h->offset_m / h->scale);
    const size_t base = (size_t)y * f->width;
    for (uint32_t x = 0; x < f->width && h->shorts; x++) {
        const int16_t v = h->shorts[base + x];
        h->shorts[base + x] = v < zero_short && mask[x] > 127 ? zero_short : v;
    }
    for (uint32_t x = 0; x < f->width && h->floats; x++) {
        const float v = h->floats[base + x];
        h->floats[base + x] = v < zero_float && mask[x] > 127 ? zero_float : v;
    }
}

// Open water draws at sea level; what lies below it is the ocean's to show. Dry land below sea
// level stays.
static trl_result raise_sea(const struct loader *loader, struct terrain_layer *layer)
{
    if (loader->surface->counts[SURFACE_WATER] == 0) {
        return TRL_OK;
    }
    bool is_out_of_memory = false;
#pragma omp parallel
    {
        uint8_t *mask = mem_alloc(layer->ctx, layer->frame.width, 1);
        if (!mask) {
#pragma omp atomic write
            is_out_of_memory = true;
        }
#pragma omp for schedule(dynamic, 64)
        for (uint32_t y = 0; y < layer->frame.height; y++) {
            if (mask) {
                read_mask_row(loader, &layer->frame, y, mask);
                raise_row(&layer->frame, &layer->heights, y, mask);
            }
        }
        mem_free(layer->ctx, mask);
    }
    return is_out_of_memory ? TRL_ERROR_MEMORY : TRL_OK;
}

static trl_result check_bytes(struct loader *loader, const struct raster *raster,
                              const struct surface_layer_desc *desc)
{
    const struct gpu *gpu = loader->surface->gpu;
    const struct raster_window w =
        raster_window_whole(raster, gpu ? gpu->caps.max_texture_size : 0);
    const double bytes = (double)w.out_width * w.out_height * KIND_TEXEL_BYTES[desc->kind];
    loader->bytes += bytes;
    if (loader->bytes > loader->desc->max_bytes) {
        return trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %u x %u texels need %.0f MB; with the other rasters that is more than "
                        "the %.0f MB allowed",
                        desc->path, w.out_width, w.out_height, bytes / 1e6,
                        loader->desc->max_bytes / 1e6);
    }
    if (w.out_width != raster->width) {
        trl_log(raster->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                "%s: %u x %u is reduced to %u x %u, the GPU's largest texture", desc->path,
                raster->width, raster->height, w.out_width, w.out_height);
    }
    return TRL_OK;
}

static trl_result load_elevation(struct loader *loader, const struct surface_layer_desc *desc,
                                 const struct raster *raster, struct terrain_layer *layer)
{
    const struct layer_fill below = {fill_height, loader->surface};
    layer->heights.scale = desc->scale;
    layer->heights.offset_m = desc->offset_m;
    trl_result result = desc->scale != 0 && isfinite(desc->scale) && isfinite(desc->offset_m)
                            ? TRL_OK
                            : trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                                       "%s: a scale of %g and an offset of %g give no heights",
                                       desc->path, desc->scale, desc->offset_m);
    if (result == TRL_OK) {
        result = layer_read_heights(raster, &below, layer);
    }
    if (result == TRL_OK) {
        result = raise_sea(loader, layer);
    }
    if (result == TRL_OK) {
        result = layer_upload_heights(loader->surface->gpu, layer);
    }
    return result;
}

static size_t count_layers(const struct surface *surface)
{
    size_t count = 0;
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        count += surface->counts[k];
    }
    return count;
}

static trl_result load_layer(struct loader *loader, const struct surface_layer_desc *desc)
{
    struct surface *s = loader->surface;
    const trl_context *ctx = s->ctx;
    const size_t index = s->counts[desc->kind];
    if (index == SURFACE_MAX_LAYERS) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d %s layers are all that can be shown", desc->path,
                        SURFACE_MAX_LAYERS, KIND_NAMES[desc->kind]);
    }
    if (count_layers(s) == SURFACE_MAX_ALL_LAYERS) {
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d layers are all that can be shown", desc->path,
                        SURFACE_MAX_ALL_LAYERS);
    }
    struct raster raster;
    trl_result result = raster_open(ctx, desc->path, &raster);
    if (result != TRL_OK) {
        return result;
    }
    struct terrain_layer *layer = &s->layers[desc->kind][index];
    *layer = (struct terrain_layer){.ctx = ctx,
                                    .frame = layer_frame_of(&raster, s->gpu, desc->feather_rad)};
    result = check_bytes(loader, &raster, desc);
    if (result == TRL_OK && desc->kind == SURFACE_ELEVATION) {
        result = load_elevation(loader, desc, &raster, layer);
    } else if (result == TRL_OK && desc->kind == SURFACE_WATER) {
        result = layer_load_mask(s->gpu, &raster, layer, &loader->masks[index]);
    } else if (result == TRL_OK) {
        result = layer_load_picture(s->gpu, &raster, layer);
    }
    raster_finish(&raster);
    // Counted only now: heights of layers below fill the gaps of this one.
    s->counts[desc->kind] += result == TRL_OK;
    if (result != TRL_OK) {
        layer_finish(layer);
    }
    return result;
}

// Water before the rest: heights are raised to sea level by it.
static trl_result load_layers(struct loader *loader)
{
    static const enum surface_kind ORDER[SURFACE_KIND_COUNT] = {SURFACE_WATER, SURFACE_ELEVATION,
                                                                SURFACE_COLOUR, SURFACE_LIGHTS};
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        for (size_t i = 0; i < loader->desc->layer_count; i++) {
            const struct surface_layer_desc *desc = &loader->desc->layers[i];
            if (desc->kind != ORDER[k] || (desc->is_optional && access(desc->path, F_OK) != 0)) {
                continue;
            }
            const trl_result result = load_layer(loader, desc);
            if (result != TRL_OK) {
                return result;
            }
        }
    }
    return TRL_OK;
}

static struct surface_bounds *bounds_cell(const struct surface *s, double latitude,
                                          double longitude)
{
    const double u = (longitude + SHARED_PI) / (2 * SHARED_PI);
    const double x = floor((u - floor(u)) * SURFACE_BOUNDS_COLUMNS);
    const double y = floor((0.5 - latitude / SHARED_PI) * SURFACE_BOUNDS_ROWS);
    const size_t column = (size_t)fmin(x, SURFACE_BOUNDS_COLUMNS - 1);
    const size_t row = (size_t)fmax(0, fmin(y, SURFACE_BOUNDS_ROWS - 1));
    return &s->bounds[row * SURFACE_BOUNDS_COLUMNS + column];
}

// Runs of texels of a row that are as long as a cell are scanned at once.
static void bound_row(struct surface *s, const struct terrain_layer *layer, uint32_t y)
{
    const struct layer_frame *f = &layer->frame;
    const struct layer_heights *h = &layer->heights;
    const double latitude = f->centre_latitude + f->half_height - (y + 0.5) * f->texel_height;
    const uint32_t run = (uint32_t)fmax(1, 2 * SHARED_PI / SURFACE_BOUNDS_COLUMNS / f->texel_width);
    for (uint32_t x = 0; x < f->width; x += run) {
        const uint32_t end = x + run < f->width ? x + run : f->width;
        double low = INFINITY;
        double high = -INFINITY;
        const size_t base = (size_t)y * f->width;
        if (h->shorts) {
            int16_t a = INT16_MAX;
            int16_t b = INT16_MIN;
            for (uint32_t i = x; i < end; i++) {
                const int16_t v = h->shorts[base + i];
                a = v < a ? v : a;
                b = v > b ? v : b;
            }
            low = a;
            high = b;
        } else {
            for (uint32_t i = x; i < end; i++) {
                low = fmin(low, (double)h->floats[base + i]);
                high = fmax(high, (double)h->floats[base + i]);
            }
        }
        const double m[2] = {h->offset_m + h->scale * low, h->offset_m + h->scale * high};
        // A run may straddle two cells.
        for (int side = 0; side < 2; side++) {
            const double longitude =
                f->centre_longitude - f->half_width + ((side ? end - 1 : x) + 0.5) * f->texel_width;
            struct surface_bounds *cell = bounds_cell(s, latitude, longitude);
            cell->min = fminf(cell->min, (float)fmin(m[0], m[1]));
            cell->max = fmaxf(cell->max, (float)fmax(m[0], m[1]));
        }
    }
}

// The cubic reaches two texels beyond a cell and overshoots a little: widen each cell by its
// neighbours and by that part of its range.
static trl_result widen_bounds(struct surface *s)
{
    const size_t count = (size_t)SURFACE_BOUNDS_COLUMNS * SURFACE_BOUNDS_ROWS;
    struct surface_bounds *wide = mem_alloc(s->ctx, count, sizeof *wide);
    if (!wide) {
        return TRL_ERROR_MEMORY;
    }
    for (int y = 0; y < SURFACE_BOUNDS_ROWS; y++) {
        for (int x = 0; x < SURFACE_BOUNDS_COLUMNS; x++) {
            struct surface_bounds b = {INFINITY, -INFINITY};
            for (int k = 0; k < 9; k++) {
                const int column =
                    (x + k % 3 - 1 + SURFACE_BOUNDS_COLUMNS) % SURFACE_BOUNDS_COLUMNS;
                const int row = y + k / 3 - 1;
                const int inside = row < 0                         ? 0
                                   : row > SURFACE_BOUNDS_ROWS - 1 ? SURFACE_BOUNDS_ROWS - 1
                                                                   : row;
                const struct surface_bounds *c =
                    &s->bounds[inside * SURFACE_BOUNDS_COLUMNS + column];
                b.min = fminf(b.min, c->min);
                b.max = fmaxf(b.max, c->max);
            }
            const float slack = (float)CUBIC_OVERSHOOT * (b.max - b.min);
            wide[y * SURFACE_BOUNDS_COLUMNS + x] =
                (struct surface_bounds){b.min - slack, b.max + slack};
        }
    }
    mem_free(s->ctx, s->bounds);
    s->bounds = wide;
    return TRL_OK;
}

static trl_result find_bounds(struct surface *s)
{
    const size_t count = (size_t)SURFACE_BOUNDS_COLUMNS * SURFACE_BOUNDS_ROWS;
    s->bounds = mem_alloc(s->ctx, count, sizeof *s->bounds); // zeroed: sea level
    if (!s->bounds) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < s->counts[SURFACE_ELEVATION]; i++) {
        const struct terrain_layer *layer = &s->layers[SURFACE_ELEVATION][i];
        for (uint32_t y = 0; y < layer->frame.height; y++) {
            bound_row(s, layer, y);
        }
    }
    const trl_result result = widen_bounds(s);
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        s->min_altitude_m = fmin(s->min_altitude_m, (double)s->bounds[i].min);
        s->max_altitude_m = fmax(s->max_altitude_m, (double)s->bounds[i].max);
    }
    return result;
}

// In north-south direction, on the sphere; of everything that has layers at all.
static double find_coarsest_m(const struct surface *s)
{
    double coarsest = 0;
    for (size_t i = 0; i < s->counts[SURFACE_ELEVATION]; i++) {
        coarsest = fmax(coarsest, s->layers[SURFACE_ELEVATION][i].frame.texel_height);
    }
    return coarsest * s->radius_m;
}

static trl_result fill_surface(const struct surface_desc *desc, struct surface *out)
{
    out->radius_m = desc->radius_m;
    for (int c = 0; c < 3; c++) {
        out->default_albedo[c] = desc->default_albedo[c];
    }
    struct loader loader = {.desc = desc, .surface = out};
    trl_result result = load_layers(&loader);
    if (result == TRL_OK) {
        result = find_bounds(out);
    }
    if (result == TRL_OK && out->gpu) {
        result = detail_init(out->gpu, &desc->detail, find_coarsest_m(out), &out->detail);
    }
    for (size_t i = 0; i < SURFACE_MAX_LAYERS; i++) {
        mem_free(out->ctx, loader.masks[i]);
    }
    if (result != TRL_OK) {
        surface_finish(out);
    }
    return result;
}

trl_result surface_init(struct gpu *gpu, const struct surface_desc *desc, struct surface *out)
{
    *out = (struct surface){.ctx = gpu->ctx, .gpu = gpu};
    return fill_surface(desc, out);
}

trl_result surface_init_on_cpu(const trl_context *ctx, const struct surface_desc *desc,
                               struct surface *out)
{
    *out = (struct surface){.ctx = ctx};
    return fill_surface(desc, out);
}

void surface_finish(struct surface *surface)
{
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        for (size_t i = 0; i < surface->counts[k]; i++) {
            layer_finish(&surface->layers[k][i]);
        }
    }
    detail_finish(&surface->detail);
    if (surface->ctx) {
        mem_free(surface->ctx, surface->bounds);
    }
    *surface = (struct surface){0};
}

bool surface_has_layers(const struct surface *surface)
{
    return count_layers(surface) > 0;
}

double surface_altitude(const struct surface *surface, struct vec3 direction)
{
    return altitude_at(surface, atan2(direction.z, hypot(direction.x, direction.y)),
                       atan2(direction.y, direction.x));
}

double surface_min_altitude(const struct surface *surface)
{
    return surface->min_altitude_m;
}

double surface_max_altitude(const struct surface *surface)
{
    return surface->max_altitude_m;
}

struct surface_bounds surface_bounds_around(const struct surface *s, struct vec3 direction,
                                            double angle_rad)
{
    const double latitude = atan2(direction.z, hypot(direction.x, direction.y));
    const double longitude = atan2(direction.y, direction.x);
    const double step = SHARED_PI / SURFACE_BOUNDS_ROWS; // square cells
    const double south = latitude - angle_rad;
    const double north = latitude + angle_rad;
    // A cap of angle a spans asin(sin a / cos latitude) of longitude to either side.
    const double ratio = sin(fmin(angle_rad, SHARED_PI / 2)) / fmax(cos(latitude), 1e-9);
    const bool holds_pole = north >= SHARED_PI / 2 || south <= -SHARED_PI / 2 || ratio >= 1;
    const double half = holds_pole ? SHARED_PI : asin(ratio);
    struct surface_bounds b = {INFINITY, -INFINITY};
    const int rows = (int)ceil((north - south) / step) + 1;
    const int columns = (int)fmin(ceil(2 * half / step) + 1, SURFACE_BOUNDS_COLUMNS);
    for (int j = 0; j <= rows; j++) {
        for (int i = 0; i <= columns; i++) {
            const double y = fmin(south + j * step, north);
            const struct surface_bounds *c =
                bounds_cell(s, fmax(-SHARED_PI / 2, fmin(SHARED_PI / 2, y)),
                            longitude - half + fmin(i * step, 2 * half));
            b.min = fminf(b.min, c->min);
            b.max = fmaxf(b.max, c->max);
        }
    }
    return b;
}

size_t surface_count_elevations(const struct surface *surface, struct vec3 direction,
                                double angle_rad)
{
    size_t count = surface->counts[SURFACE_ELEVATION];
    while (count > 0) {
        const struct layer_frame *f = &surface->layers[SURFACE_ELEVATION][count - 1].frame;
        const struct vec3 middle = vec3_from_lat_lon(f->centre_latitude, f->centre_longitude);
        const double away = acos(fmax(-1, fmin(1, vec3_dot(middle, direction))));
        if (f->is_whole_circle || away <= angle_rad + hypot(f->half_width, f->half_height)) {
            break;
        }
        count--;
    }
    return count;
}
