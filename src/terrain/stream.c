// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/stream.h"

#include "shared/blend.glsl"
#include "shared/cubic.glsl"
#include "terrain/bounds.h"
#include "terrain/surface.h"

#include <math.h>
#include <unistd.h>

// A frame that does not wait brings so many tiles to the GPU at most, and asks for so many of the
// next frames'.
enum { PUTS_PER_FRAME = 24, MOST_HINTS = 64, MOST_ROUNDS = 200, MOST_THREADS = 4 };
static const double HINT_FRAMES = 12; // ahead, as the camera moves now
// What a network did not bring is asked for again after so long, by a later frame.
static const double RETRY_S = 15;

trl_result stream_create(const trl_context *ctx, struct gpu *gpu, bool waits, struct stream **out)
{
    *out = mem_alloc(ctx, 1, sizeof **out);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    (*out)->ctx = ctx;
    (*out)->gpu = gpu;
    (*out)->waits = waits;
    return TRL_OK;
}

void stream_destroy(struct stream **stream)
{
    struct stream *s = *stream;
    if (!s) {
        return;
    }
    tile_cache_destroy(&s->cache); // before what its threads read
    atlas_finish(&s->atlas);
    for (uint32_t i = 0; i < s->layer_count; i++) {
        pyramid_finish(&s->layers[i].pyramid);
    }
    mem_free(s->ctx, s->wants);
    mem_free(s->ctx, s);
    *stream = NULL;
}

struct stream_layer *stream_add(struct stream *stream)
{
    if (stream->layer_count == ATLAS_MAX_LAYERS) {
        (void)trl_fail(stream->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                       "%d rasters are all that can be held in tiles", ATLAS_MAX_LAYERS);
        return NULL;
    }
    return &stream->layers[stream->layer_count++];
}

void stream_drop(struct stream *stream)
{
    struct stream_layer *layer = &stream->layers[--stream->layer_count];
    pyramid_finish(&layer->pyramid);
    *layer = (struct stream_layer){0};
}

static trl_result start_cache(struct stream *s, size_t max_bytes)
{
    const long cores = sysconf(_SC_NPROCESSORS_ONLN);
    const struct tile_cache_desc desc = {.max_bytes = max_bytes,
                                         .retry_s = RETRY_S,
                                         .threads = (uint32_t)(cores < 2              ? 2
                                                               : cores > MOST_THREADS ? MOST_THREADS
                                                                                      : cores)};
    trl_result result = tile_cache_create(s->ctx, &desc, &s->cache);
    for (uint32_t i = 0; i < s->layer_count && result == TRL_OK; i++) {
        const struct tile_source source = {&s->layers[i].pyramid, stream_prepare, &s->layers[i]};
        result = tile_cache_add(s->cache, &source, &s->layers[i].source);
    }
    return result;
}

static trl_result start_atlas(struct stream *s, size_t max_bytes)
{
    struct atlas_desc desc = {.layer_count = s->layer_count, .max_bytes = max_bytes};
    for (uint32_t i = 0; i < s->layer_count; i++) {
        desc.pyramids[i] = &s->layers[i].pyramid;
    }
    return atlas_init(s->gpu, &desc, &s->atlas);
}

// The coarsest tile of a layer stands in wherever there is no other.
static trl_result put_last_tile(struct stream *s, uint32_t layer)
{
    const struct stream_layer *l = &s->layers[layer];
    const struct tile_key key = {l->source, {l->pyramid.level_count - 1, 0, 0}};
    struct tile_view view;
    if (!tile_cache_hold(s->cache, &key, true, &view)) {
        return TRL_ERROR_MEMORY;
    }
    bool is_put = false;
    const trl_result result = atlas_put(&s->atlas, layer, &key.tile, view.texels, &is_put);
    tile_cache_release(s->cache, &key);
    return result;
}

trl_result stream_start(struct stream *stream, size_t max_bytes)
{
    // Tiles are held on both sides: what is on the GPU leaves the cache first.
    trl_result result = start_cache(stream, stream->gpu ? max_bytes / 2 : max_bytes);
    if (result == TRL_OK && stream->gpu) {
        result = start_atlas(stream, max_bytes / 2);
    }
    for (uint32_t i = 0; i < stream->layer_count && stream->gpu && result == TRL_OK; i++) {
        result = put_last_tile(stream, i);
    }
    return result == TRL_OK && stream->gpu ? atlas_commit(&stream->atlas) : result;
}

// Whether what a walk met fits into the atlas.
static bool has_room(const struct stream *s)
{
    uint32_t counts[ATLAS_MAX_TEXTURES] = {0};
    bool fits = true;
    for (size_t i = 0; i < s->want_count && fits; i++) {
        const uint32_t layer = s->wants[i].layer;
        fits = ++counts[s->atlas.layers[layer].texture] <= atlas_capacity(&s->atlas, layer);
    }
    return fits;
}

// Tiles as fine as pixels, or as the atlas has room for.
static trl_result choose_tiles(struct stream *s, const struct surface *surface,
                               const struct stream_view *view)
{
    s->coarser = 0;
    trl_result result = stream_walk(s, surface, view);
    while (result == TRL_OK && !has_room(s) && s->coarser < PYRAMID_MAX_LEVELS) {
        s->coarser += 0.5;
        result = stream_walk(s, surface, view);
    }
    if (result == TRL_OK && s->coarser > 0 && !s->is_crowded) {
        s->is_crowded = true;
        trl_log(s->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                "a view needs more tiles than fit: ground is shown with texels of %.1f pixels; "
                "allow more memory for rasters (--memory)",
                exp2(s->coarser));
    }
    return result;
}

static struct layer_rectangle place_tile(const struct stream_layer *l,
                                         const struct pyramid_tile *tile)
{
    const struct pyramid_level *level = &l->pyramid.levels[tile->level];
    const double scale_x = (double)l->frame.width / level->width;
    const double scale_y = (double)l->frame.height / level->height;
    struct layer_rectangle r = {.x = tile->x * (double)PYRAMID_TILE * scale_x,
                                .y = tile->y * (double)PYRAMID_TILE * scale_y,
                                .width = PYRAMID_TILE * scale_x,
                                .height = PYRAMID_TILE * scale_y};
    r.width = fmin(r.width, l->frame.width - r.x);
    r.height = fmin(r.height, l->frame.height - r.y);
    return r;
}

// What arrived says how high the ground is, and where it is another one now.
static void note_heights(struct stream *s, struct surface *surface, const struct stream_want *want,
                         const struct tile_range *range)
{
    const struct stream_layer *l = &s->layers[want->layer];
    const struct layer_rectangle r = place_tile(l, &want->tile);
    struct stream_change *change = &s->changes[++s->revision % STREAM_CHANGES];
    surface_bound_rectangle(&l->frame, &r, &change->direction, &change->angle_rad);
    // Layers that add or multiply hold differences and factors: theirs stay as they were guessed.
    if (!blend_is_change(l->layer->mode)) {
        surface_grow_bounds(surface, &l->frame, &r, range->min, range->max);
    }
}

bool stream_has_changed(const struct stream *s, uint64_t since, struct vec3 direction,
                        double angle_rad)
{
    bool has_changed = s->revision - since > STREAM_CHANGES;
    for (uint64_t r = since + 1; r <= s->revision && !has_changed; r++) {
        const struct stream_change *c = &s->changes[r % STREAM_CHANGES];
        const double chord = vec3_length(vec3_sub(c->direction, direction));
        has_changed = 2 * asin(fmin(1, chord / 2)) <= c->angle_rad + angle_rad;
    }
    return has_changed;
}

struct round {
    size_t puts, missing;
};

static trl_result show_tile(struct stream *s, struct surface *surface,
                            const struct stream_want *want, struct round *round)
{
    const struct stream_layer *l = &s->layers[want->layer];
    const struct tile_key key = {l->source, want->tile};
    if (atlas_touch(&s->atlas, want->layer, &want->tile)) {
        if (l->is_elevation) {
            tile_cache_hint(s->cache, &key, want->priority); // what stands on it asks the CPU
        }
        return TRL_OK;
    }
    struct tile_view view;
    const enum tile_state state = tile_cache_want(s->cache, &key, want->priority, &view);
    const bool may_put = s->waits || round->puts < PUTS_PER_FRAME;
    if (state != TILE_READY || !may_put) {
        round->missing += state != TILE_FAILED;
        return TRL_OK;
    }
    bool is_put = false;
    const trl_result result = atlas_put(&s->atlas, want->layer, &want->tile, view.texels, &is_put);
    round->puts += is_put;
    round->missing += !is_put;
    if (is_put && l->is_elevation) {
        note_heights(s, surface, want, &view.range);
    }
    return result;
}

static trl_result show_tiles(struct stream *s, struct surface *surface, struct round *round)
{
    *round = (struct round){0};
    trl_result result = TRL_OK;
    // Those that are there are marked first, so that none of them makes room.
    for (size_t i = 0; i < s->want_count; i++) {
        (void)atlas_touch(&s->atlas, s->wants[i].layer, &s->wants[i].tile);
    }
    for (size_t i = 0; i < s->want_count && result == TRL_OK; i++) {
        result = show_tile(s, surface, &s->wants[i], round);
    }
    s->missing = round->missing;
    return result == TRL_OK ? atlas_commit(&s->atlas) : result;
}

// Where the camera will be soon if it goes on: those tiles are read ahead.
static trl_result hint_ahead(struct stream *s, const struct surface *surface,
                             const struct stream_view *view)
{
    const struct vec3 here = view->camera->position_m;
    const struct vec3 step = vec3_sub(here, s->last_position_m);
    const double speed = vec3_length(step) / fmax(1, vec3_length(here) - surface->radius_m);
    s->last_position_m = here;
    if (!(speed > 1e-6 && speed < 0.5) || s->missing > MOST_HINTS) {
        return TRL_OK; // it stands, or jumped
    }
    struct camera ahead = *view->camera;
    ahead.position_m = vec3_add(here, vec3_scale(step, HINT_FRAMES));
    const double lowest = surface->radius_m + surface_min_altitude(surface);
    if (vec3_length(ahead.position_m) < lowest) {
        return TRL_OK;
    }
    const trl_result result =
        stream_walk(s, surface, &(struct stream_view){&ahead, view->pixel_rad});
    size_t hints = 0;
    for (size_t i = 0; i < s->want_count && hints < MOST_HINTS && result == TRL_OK; i++) {
        const struct stream_want *want = &s->wants[i];
        if (!atlas_touch(&s->atlas, want->layer, &want->tile)) {
            const struct tile_key key = {s->layers[want->layer].source, want->tile};
            tile_cache_hint(s->cache, &key, want->priority - 100);
            hints++;
        }
    }
    return result;
}

trl_result stream_update(struct stream *s, struct surface *surface, const struct stream_view *view)
{
    struct round round = {0};
    trl_result result = TRL_OK;
    atlas_begin(&s->atlas);
    tile_cache_retry(s->cache); // not once a round: a frame that waits asks for a tile once
    for (int i = 0; i < MOST_ROUNDS && result == TRL_OK; i++) {
        result = choose_tiles(s, surface, view);
        if (result == TRL_OK) {
            tile_cache_begin(s->cache);
            result = show_tiles(s, surface, &round);
        }
        // What came may be higher than was thought, and show what was hidden: once more.
        if (!s->waits || (round.puts == 0 && round.missing == 0)) {
            break;
        }
        if (result == TRL_OK) {
            result = tile_cache_wait(s->cache);
        }
    }
    return result == TRL_OK && !s->waits ? hint_ahead(s, surface, view) : result;
}

double stream_bytes(const struct stream *stream)
{
    double bytes = (double)tile_cache_stats(stream->cache).bytes + (double)stream->atlas.bytes;
    for (uint32_t i = 0; i < stream->layer_count; i++) {
        bytes += (double)stream->layers[i].pyramid.bytes;
    }
    return bytes;
}

void stream_describe(const struct stream *stream, const struct stream_layer *layer, float paging[4])
{
    atlas_describe(&stream->atlas, (uint32_t)(layer - stream->layers), paging);
}

const struct gpu_texture *stream_texture(const struct stream *stream,
                                         const struct stream_layer *layer)
{
    const uint32_t index = stream->atlas.layers[layer - stream->layers].texture;
    return &stream->atlas.textures[index].texture;
}

// A place in a tile that is held: texels from its corner with the border.
struct tile_place {
    double x, y;
};

// The tile of a level that has a place, given in texels of the layer's coarse frame.
static struct tile_key find_tile(const struct stream_layer *l, uint32_t level, const double at[2],
                                 struct tile_place *place)
{
    const struct pyramid_level *coarse = &l->pyramid.levels[l->pyramid.base_level];
    const struct pyramid_level *fine = &l->pyramid.levels[level];
    const double x = (at[0] + 0.5) * fine->width / coarse->width;
    const double y = (at[1] + 0.5) * fine->height / coarse->height;
    const double column = fmax(0, fmin(floor(x / PYRAMID_TILE), fine->columns - 1.0));
    const double row = fmax(0, fmin(floor(y / PYRAMID_TILE), fine->rows - 1.0));
    *place = (struct tile_place){x - 0.5 - column * PYRAMID_TILE + PYRAMID_BORDER,
                                 y - 0.5 - row * PYRAMID_TILE + PYRAMID_BORDER};
    return (struct tile_key){l->source, {level, (uint32_t)column, (uint32_t)row}};
}

// Holds the finest tile at a place; false: none is finer than what is held whole, as while layers
// are still being read.
static bool hold_finest(struct stream *s, const struct stream_layer *l, const double at[2],
                        struct tile_key *key, struct tile_place *place, struct tile_view *view)
{
    for (uint32_t level = 0; s->cache && level < l->pyramid.base_level; level++) {
        *key = find_tile(l, level, at, place);
        if (tile_cache_hold(s->cache, key, s->waits, view)) {
            return true;
        }
    }
    return false;
}

static double tile_height(const struct stream_layer *l, const void *texels, size_t i)
{
    const struct layer_heights *h = &l->layer->heights;
    const double value = l->pyramid.format == PYRAMID_INT16 ? ((const int16_t *)texels)[i]
                                                            : (double)((const float *)texels)[i];
    return h->offset_m + h->scale * value;
}

double stream_sample(struct stream *s, const struct stream_layer *l, double x, double y)
{
    struct tile_key key;
    struct tile_place p;
    struct tile_view view;
    if (!hold_finest(s, l, (const double[2]){x, y}, &key, &p, &view)) {
        return layer_sample_held(l->layer, x, y);
    }
    const int column = (int)floor(p.x), row = (int)floor(p.y);
    double rows[4];
    for (int j = 0; j < 4; j++) {
        double t[4];
        for (int i = 0; i < 4; i++) {
            const int texel = (row - 1 + j) * PYRAMID_SIDE + column - 1 + i;
            t[i] = tile_height(l, view.texels, (size_t)texel);
        }
        rows[j] = cubic_blend(p.x - column, t[0], t[1], t[2], t[3]);
    }
    tile_cache_release(s->cache, &key);
    return cubic_blend(p.y - row, rows[0], rows[1], rows[2], rows[3]);
}

double stream_sample_linear(struct stream *s, const struct stream_layer *l, double x, double y)
{
    struct tile_key key;
    struct tile_place p;
    struct tile_view view;
    if (!hold_finest(s, l, (const double[2]){x, y}, &key, &p, &view)) {
        return layer_sample_held_linear(l->layer, x, y);
    }
    const int column = (int)floor(p.x), row = (int)floor(p.y);
    const double fx = p.x - column, fy = p.y - row;
    double sum = 0;
    for (int k = 0; k < 4; k++) {
        const double weight = (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
        const int texel = (row + k / 2) * PYRAMID_SIDE + column + k % 2;
        sum += weight * tile_height(l, view.texels, (size_t)texel);
    }
    tile_cache_release(s->cache, &key);
    return sum;
}

void stream_sample_picture(struct stream *s, const struct stream_layer *l, double x, double y,
                           double rgba[4])
{
    struct tile_key key;
    struct tile_place p;
    struct tile_view view;
    if (!hold_finest(s, l, (const double[2]){x, y}, &key, &p, &view)) {
        layer_sample_held_roots(l->layer, x, y, rgba);
        return;
    }
    const int column = (int)floor(p.x), row = (int)floor(p.y);
    const double fx = p.x - column, fy = p.y - row;
    for (int c = 0; c < 4; c++) {
        rgba[c] = 0;
        for (int k = 0; k < 4; k++) {
            const double weight = (k % 2 ? fx : 1 - fx) * (k / 2 ? fy : 1 - fy);
            const int texel = (row + k / 2) * PYRAMID_SIDE + column + k % 2;
            rgba[c] += weight * ((const uint8_t *)view.texels)[4 * texel + c] / 255;
        }
    }
    tile_cache_release(s->cache, &key);
}
