// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Reading a surface's rasters. A raster that is broken is told in one line and left out: the planet
// draws without it.
#include "terrain/surface.h"

#include "raster/remote.h"
#include "shared/blend.glsl"
#include "terrain/bounds.h"
#include "terrain/load.h"
#include "terrain/make.h"
#include "terrain/stream.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char *const KIND_NAMES[SURFACE_KIND_COUNT] = {"elevation", "colour", "water", "lights",
                                                           "normal"};
// Bytes a texel on both sides, mips included: heights are held as floats on the GPU and as read on
// the CPU.
// How far a raster's ellipsoid may be from the planet's sphere: as Earth's is from the Moon's 70 %,
// Mars's rasters from the lowered sphere of scenes/mars.json 0.3 %.
static const double OTHER_BODY = 0.05;
static const double KIND_TEXEL_BYTES[SURFACE_KIND_COUNT] = {4 * 4.0 / 3 + 4, 4 * 4.0 / 3, 4.0 / 3,
                                                            4 * 4.0 / 3, 4 * 4.0 / 3};

struct surface_desc surface_desc_default(void)
{
    return (struct surface_desc){.radius_m = 1,
                                 .default_albedo = {0.3f, 0.3f, 0.3f},
                                 .exaggeration = 1,
                                 .depth.everywhere_m = -1,
                                 .max_bytes = 3e9,
                                 .waits = true};
}

double load_fill_height(const void *user, double latitude, double longitude)
{
    const struct load_below *below = user;
    const double altitude =
        surface_altitude_of_data(below->surface, vec3_from_lat_lon(latitude, longitude));
    return blend_neutral(below->mode, altitude);
}

double load_whole_bytes(const struct loader *loader, const struct surface_layer_desc *desc,
                        const struct raster *raster)
{
    const struct gpu *gpu = loader->surface->gpu;
    const struct raster_window w =
        raster_window_whole(raster, gpu ? gpu->caps.max_texture_size : 0);
    return (double)w.out_width * w.out_height * KIND_TEXEL_BYTES[desc->kind];
}

// Metres that the file's unit is; factors have none.
static double find_unit(const struct loader *loader, const struct raster *raster, double mode)
{
    const struct raster_values *v = &raster->values;
    if (blend_is_factor(mode)) {
        return 1;
    }
    if (v->unit_m == 0) {
        trl_log(&loader->quiet, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                "elevation %s: its unit \"%s\" is not known and taken for metres; the layer's "
                "\"scale\" can correct that",
                raster->path, v->unit);
    }
    return v->unit_m > 0 ? v->unit_m : 1;
}

trl_result load_set_scale(const struct loader *loader, const struct surface_layer_desc *desc,
                          const struct raster *raster, struct terrain_layer *layer)
{
    const struct raster_values *v = &raster->values;
    const double unit_m = find_unit(loader, raster, layer->mode);
    const double scale = desc->scale * unit_m * v->scale;
    const double offset_m = desc->scale * unit_m * v->offset + desc->offset_m;
    if (scale == 0 || !isfinite(scale) || !isfinite(offset_m)) {
        return trl_fail(&loader->quiet, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: a scale of %g and an offset of %g give no heights (the file's own are "
                        "%g and %g)",
                        desc->path, desc->scale, desc->offset_m, v->scale, v->offset);
    }
    // Exaggerating every layer exaggerates their sum; factors are no heights.
    const double exaggeration = blend_is_factor(layer->mode) ? 1 : loader->desc->exaggeration;
    layer->heights.has_bed = desc->has_bed && !blend_is_change(layer->mode);
    layer->heights.scale = scale * exaggeration;
    layer->heights.offset_m = offset_m * exaggeration;
    return TRL_OK;
}

static trl_result load_elevation(struct loader *loader, const struct surface_layer_desc *desc,
                                 const struct raster *raster, struct terrain_layer *layer)
{
    const struct load_below under = {loader->surface, layer->mode};
    const struct layer_fill below = {load_fill_height, &under};
    trl_result result = load_set_scale(loader, desc, raster, layer);
    if (result == TRL_OK) {
        result = layer_read_heights(raster, &below, layer);
    }
    if (result == TRL_OK) {
        load_note_depths(loader->surface, layer);
        result = load_raise_sea(loader, layer);
    }
    if (result == TRL_OK) {
        result = layer_upload_heights(loader->surface->gpu, layer);
    }
    return result;
}

static trl_result check_count(const struct loader *loader, const struct surface_layer_desc *desc)
{
    if (loader->surface->counts[desc->kind] < SURFACE_MAX_LAYERS) {
        return TRL_OK;
    }
    return trl_fail(&loader->quiet, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                    "%s: %d %s layers are all that can be held", desc->path, SURFACE_MAX_LAYERS,
                    KIND_NAMES[desc->kind]);
}

// Lines and points have no inside that a layer could show.
static trl_result check_size(const struct raster *raster)
{
    return raster->width >= 2 && raster->height >= 2
               ? TRL_OK
               : trl_fail(raster->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                          "%s: %u x %u pixels; a layer needs at least 2 x 2: lines and points have "
                          "no area to show",
                          raster->path, raster->width, raster->height);
}

static const char *name_of_key(const struct surface_layer_desc *desc)
{
    return desc->is_cover ? "snow" : KIND_NAMES[desc->kind];
}

// Another planet's map is drawn, since somebody may want that; Earth's coordinates are what many
// maps of other planets have for want of better ones.
static void check_body(const struct loader *loader, const struct surface_layer_desc *desc,
                       const struct raster *raster)
{
    const double own_m = raster->body_radius_m, radius_m = loader->desc->radius_m;
    const bool is_of_earth = own_m > 6.35e6 && own_m < 6.4e6;
    if (own_m > 0 && !is_of_earth && fabs(own_m / radius_m - 1) > OTHER_BODY) {
        trl_log(
            loader->surface->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
            "%s %s: its coordinates are those of a body of %.0f km, this planet has %.0f km: is "
            "it the right file?",
            name_of_key(desc), raster->path, own_m / 1e3, radius_m / 1e3);
    }
}

static trl_result read_layer(struct loader *loader, const struct surface_layer_desc *desc,
                             const struct raster *raster, struct terrain_layer *layer)
{
    struct surface *s = loader->surface;
    const struct layer_touch shore = {load_paint_shore, s};
    switch (desc->kind) {
    case SURFACE_ELEVATION:
        return load_elevation(loader, desc, raster, layer);
    case SURFACE_WATER:
        return load_mask(loader->surface, raster, layer);
    case SURFACE_NORMAL:
        return layer_load_normals(s->gpu, raster, layer);
    default:
        return layer_load_picture(s->gpu, raster, desc->kind == SURFACE_COLOUR ? &shore : NULL,
                                  layer);
    }
}

static void listen(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct loader *loader = user;
    if (level == TRL_LOG_ERROR) {
        snprintf(loader->said, sizeof loader->said, "%s", message);
    } else {
        trl_log(loader->surface->ctx, level, item, "%s", message);
    }
}

static void free_mask(struct surface *s, size_t index)
{
    mem_free(s->ctx, s->masks[index]);
    mem_free(s->ctx, s->depths[index]);
    s->masks[index] = s->depths[index] = NULL;
}

static trl_result load_layer(struct loader *loader, const struct surface_layer_desc *desc,
                             const struct load_item *item)
{
    struct surface *s = loader->surface;
    trl_result result = item->opened;
    if (result == TRL_OK) {
        result = check_count(loader, desc);
    }
    if (result == TRL_OK) {
        result = check_size(&item->raster);
    }
    if (result != TRL_OK) {
        return result;
    }
    check_body(loader, desc, &item->raster);
    struct terrain_layer *layer = &s->layers[desc->kind][s->counts[desc->kind]];
    *layer = (struct terrain_layer){.ctx = s->ctx, .mode = desc->mode};
    if (desc->is_cover) {
        layer->cover = layer_cover_of(desc->cover_rgb);
    }
    if (item->is_tiled) {
        result = load_tiled(loader, desc, &item->raster, layer);
    } else {
        layer->frame = layer_frame_for(&item->raster, s->gpu, desc->feather_rad);
        result = read_layer(loader, desc, &item->raster, layer);
        loader->bytes += result == TRL_OK ? load_whole_bytes(loader, desc, &item->raster) : 0;
    }
    // Counted only now: heights of layers below fill the gaps of this one.
    s->counts[desc->kind] += result == TRL_OK;
    if (result != TRL_OK) {
        layer_finish(layer);
    }
    if (result != TRL_OK && desc->kind == SURFACE_WATER) {
        free_mask(s, s->counts[SURFACE_WATER]);
    }
    return result;
}

static bool is_there(const char *path)
{
    return remote_is_path(path) || access(path, F_OK) == 0;
}

// A file that is there and no good is left out. Where one is missing that must be there, somebody
// forgot to fetch it: that is no planet to draw. Either way one line tells.
static trl_result go_without(struct loader *loader, const struct surface_layer_desc *desc,
                             trl_result result)
{
    const trl_context *ctx = loader->surface->ctx;
    const bool is_bad = result == TRL_ERROR_INVALID || result == TRL_ERROR_IO;
    if (is_bad && !loader->desc->is_strict && is_there(desc->path)) {
        trl_log(ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER, "%s %s; left out", name_of_key(desc),
                loader->said);
        return TRL_OK;
    }
    return loader->said[0] ? trl_fail(ctx, result, TRL_LOG_ITEM_RASTER, "%s %s", name_of_key(desc),
                                      loader->said)
                           : result;
}

// All at once, since which are held whole depends on all.
static trl_result open_rasters(struct loader *loader)
{
    const struct surface_desc *desc = loader->desc;
    loader->items = mem_alloc(loader->surface->ctx, desc->layer_count, sizeof *loader->items);
    if (!loader->items) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < desc->layer_count; i++) {
        const struct surface_layer_desc *layer = &desc->layers[i];
        struct load_item *item = &loader->items[i];
        item->is_passed_over = layer->is_optional && !is_there(layer->path);
        if (!item->is_passed_over) {
            loader->said[0] = '\0';
            item->opened = raster_open(&loader->quiet, layer->path, &item->raster);
            memcpy(item->said, loader->said, sizeof item->said);
        }
    }
    load_choose_tiled(loader);
    return TRL_OK;
}

static void close_rasters(struct loader *loader)
{
    for (size_t i = 0; loader->items && i < loader->desc->layer_count; i++) {
        raster_finish(&loader->items[i].raster);
    }
    mem_free(loader->surface->ctx, loader->items);
}

// Water before the rest: heights are raised to sea level by it.
static trl_result load_layers(struct loader *loader)
{
    static const enum surface_kind ORDER[SURFACE_KIND_COUNT] = {
        SURFACE_WATER, SURFACE_ELEVATION, SURFACE_COLOUR, SURFACE_LIGHTS, SURFACE_NORMAL};
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        for (size_t i = 0; i < loader->desc->layer_count; i++) {
            const struct surface_layer_desc *desc = &loader->desc->layers[i];
            const struct load_item *item = &loader->items[i];
            if (desc->kind != ORDER[k] || item->is_passed_over) {
                continue;
            }
            memcpy(loader->said, item->said, sizeof loader->said);
            trl_result result = load_layer(loader, desc, item);
            if (result != TRL_OK) {
                result = go_without(loader, desc, result);
            }
            if (result != TRL_OK) {
                return result;
            }
        }
    }
    return TRL_OK;
}

static void free_masks(struct surface *s)
{
    for (size_t i = 0; i < SURFACE_MAX_LAYERS && s->ctx; i++) {
        free_mask(s, i);
    }
}

static trl_result fill_surface(const struct surface_desc *desc, struct surface *out)
{
    out->radius_m = desc->radius_m;
    out->depth = desc->depth;
    for (int c = 0; c < 3; c++) {
        out->default_albedo[c] = desc->default_albedo[c];
    }
    struct loader loader = {.desc = desc, .surface = out, .quiet = *out->ctx};
    loader.quiet.desc.log = listen;
    loader.quiet.desc.log_user = &loader;
    trl_result result = make_ground(desc, out);
    if (result == TRL_OK) {
        result = open_rasters(&loader);
    }
    if (result == TRL_OK) {
        result = load_layers(&loader);
    }
    if (result == TRL_OK) {
        result = load_upload_depths(out);
    }
    close_rasters(&loader);
    if (result == TRL_OK) {
        result = make_detail(desc, out);
    }
    if (result == TRL_OK) {
        result = surface_find_bounds(out);
    }
    if (result == TRL_OK) {
        result = load_start_stream(&loader);
    }
    // Tiles need them as they come; an ocean has depths into which eyes may go.
    if (result == TRL_OK && !out->stream && !out->depth.is_told) {
        free_masks(out);
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
    stream_destroy(&surface->stream); // before the layers that its threads look at
    free_masks(surface);
    for (size_t k = 0; k < SURFACE_KIND_COUNT; k++) {
        for (size_t i = 0; i < surface->counts[k]; i++) {
            layer_finish(&surface->layers[k][i]);
        }
    }
    noise_finish(&surface->noise);
    if (surface->ctx) {
        mem_free(surface->ctx, surface->bounds);
    }
    *surface = (struct surface){0};
}
