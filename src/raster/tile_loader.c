// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/tile_loader.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

// A source behind a network is given up after so many failures one after another, or when failures
// took so much longer than what came: a request may take a minute, and a view shows hundreds.
enum { MOST_FAILURES = 8 };
static const double MOST_WASTED_S = 40;
static const double RETRIES_GIVEN_UP = 4; // in times of tile_cache_desc.retry_s

double tile_loader_now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

// Whether `bytes` more are within the budget now.
static bool make_room(struct tile_cache *cache, size_t bytes)
{
    struct tile *tile = cache->tiles.oldest;
    while (tile && cache->stats.bytes + cache->reserved + bytes > cache->max_bytes) {
        struct tile *newer = tile->newer;
        if (tile->holders == 0 && tile->frame != cache->frame) {
            cache->stats.bytes -= cache->sources[tile->key.source].bytes;
            cache->stats.evicted++;
            tile_table_unlink(&cache->tiles, tile);
            tile_table_remove(&cache->tiles, tile);
        }
        tile = newer;
    }
    return cache->stats.bytes + cache->reserved + bytes <= cache->max_bytes;
}

static struct tile *pop_queue(struct tile_cache *cache)
{
    size_t best = 0;
    for (size_t i = 1; i < cache->queue_count; i++) {
        best = cache->queue[i]->priority > cache->queue[best]->priority ? i : best;
    }
    struct tile *tile = cache->queue[best];
    cache->queue[best] = cache->queue[--cache->queue_count];
    return tile;
}

void tile_loader_set_wanted(struct tile_cache *cache, struct tile *tile, bool is_wanted)
{
    if (tile->is_wanted != is_wanted) {
        tile->is_wanted = is_wanted;
        cache->missing += is_wanted ? 1 : (size_t)-1;
    }
}

static void end_tile(struct tile_cache *cache, struct tile *tile, enum tile_state state)
{
    tile->state = state;
    tile_loader_set_wanted(cache, tile, false);
    if (state == TILE_READY) {
        tile_table_link(&cache->tiles, tile);
    }
    if (state == TILE_ABSENT && tile->holders == 0) {
        tile_table_remove(&cache->tiles, tile);
    }
    pthread_cond_broadcast(&cache->news);
}

static void keep_message(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct loader *loader = user;
    (void)item;
    if (level == TRL_LOG_ERROR && !loader->message[0]) {
        snprintf(loader->message, sizeof loader->message, "%s", message);
    }
}

// Reads without the lock.
static trl_result read_tile(struct loader *loader, const struct tile_source *source,
                            const struct tile_key *key, struct tile *out)
{
    struct pyramid_reader *reader = &loader->readers[key->source];
    trl_result result = TRL_OK;
    loader->message[0] = '\0';
    if (!reader->pyramid) {
        result = pyramid_reader_init(&loader->quiet, source->pyramid, reader);
    }
    out->texels =
        mem_alloc(&loader->quiet, PYRAMID_TEXELS, pyramid_texel_bytes(source->pyramid->format));
    if (result == TRL_OK) {
        result = out->texels ? pyramid_read(reader, &key->tile, out->texels) : TRL_ERROR_MEMORY;
    }
    out->range = (struct tile_range){NAN, NAN};
    if (result == TRL_OK && source->prepare) {
        const struct tile_load load = {key->tile, out->texels, &out->range};
        result = source->prepare(source->user, reader, &load);
    }
    if (result != TRL_OK) {
        mem_free(&loader->quiet, out->texels);
        out->texels = NULL;
    }
    return result;
}

bool tile_loader_is_remote(const struct source *source)
{
    return source->desc.pyramid->raster.is_remote;
}

bool tile_loader_is_given_up(const struct tile_cache *cache, const struct tile_key *key)
{
    const struct source *source = &cache->sources[key->source];
    return source->is_given_up && key->tile.level < source->desc.pyramid->base_level;
}

// What waits of the source fails with it.
static void give_up(struct tile_cache *cache, struct source *source)
{
    source->is_given_up = true;
    source->given_up_s = tile_loader_now_s();
    source->tells_given_up = !source->was_given_up;
    source->was_given_up = true;
    size_t kept = 0;
    for (size_t i = 0; i < cache->queue_count; i++) {
        struct tile *tile = cache->queue[i];
        if (&cache->sources[tile->key.source] == source &&
            tile_loader_is_given_up(cache, &tile->key)) {
            tile->failed_s = source->given_up_s;
            cache->stats.failed++;
            end_tile(cache, tile, TILE_FAILED);
        } else {
            cache->queue[kept++] = tile;
        }
    }
    cache->queue_count = kept;
}

static void fail_tile(struct loader *loader, struct tile *tile, double spent_s)
{
    struct tile_cache *cache = loader->cache;
    struct source *source = &cache->sources[tile->key.source];
    if (!source->has_failed) {
        source->has_failed = true;
        snprintf(source->message, sizeof source->message, "%.511s", loader->message);
    }
    cache->stats.failed++;
    tile->failed_s = tile_loader_now_s();
    end_tile(cache, tile, TILE_FAILED);
    source->failures++;
    source->wasted_s += spent_s;
    if (tile_loader_is_remote(source) && !source->is_given_up &&
        (source->failures >= MOST_FAILURES || source->wasted_s > MOST_WASTED_S)) {
        give_up(cache, source);
    }
}

static void note_success(struct source *source, const struct tile_key *key, double spent_s)
{
    if (key->tile.level >= source->desc.pyramid->base_level) {
        return; // from memory
    }
    source->failures = 0;
    source->wasted_s = fmax(0, source->wasted_s - spent_s);
    source->is_given_up = false;
}

// With the lock, which it gives up while it reads.
static void load_tile(struct loader *loader, struct tile *tile)
{
    struct tile_cache *cache = loader->cache;
    const struct tile_key key = tile->key;
    const struct tile_source source = cache->sources[key.source].desc;
    const size_t bytes = cache->sources[key.source].bytes;
    if (!make_room(cache, bytes)) {
        cache->stats.crowded_out++;
        end_tile(cache, tile, TILE_ABSENT);
        return;
    }
    loader->current = tile;
    cache->reserved += bytes;
    pthread_mutex_unlock(&cache->lock);
    struct tile read = {0};
    const double begun_s = tile_loader_now_s();
    const trl_result result = read_tile(loader, &source, &key, &read);
    const double spent_s = tile_loader_now_s() - begun_s;
    pthread_mutex_lock(&cache->lock);
    loader->current = NULL;
    cache->reserved -= bytes;
    cache->stats.read_s += spent_s;
    if (result != TRL_OK) {
        fail_tile(loader, tile, spent_s);
        return;
    }
    note_success(&cache->sources[key.source], &key, spent_s);
    tile->texels = read.texels;
    tile->range = read.range;
    cache->stats.loaded++;
    cache->stats.bytes += bytes;
    if (cache->stats.bytes > cache->stats.most_bytes) {
        cache->stats.most_bytes = cache->stats.bytes;
    }
    end_tile(cache, tile, TILE_READY);
}

static void *run_loader(void *user)
{
    struct loader *loader = user;
    struct tile_cache *cache = loader->cache;
    pthread_mutex_lock(&cache->lock);
    while (!cache->is_stopping) {
        if (cache->queue_count == 0) {
            pthread_cond_wait(&cache->work, &cache->lock);
        } else {
            load_tile(loader, pop_queue(cache));
        }
    }
    pthread_mutex_unlock(&cache->lock);
    for (size_t i = 0; i < TILE_CACHE_MAX_SOURCES; i++) {
        pyramid_reader_finish(&loader->readers[i]);
    }
    return NULL;
}

trl_result tile_loaders_start(struct tile_cache *cache, uint32_t threads)
{
    for (uint32_t i = 0; i < threads; i++) {
        struct loader *loader = &cache->loaders[i];
        loader->cache = cache;
        loader->quiet = *cache->ctx;
        loader->quiet.desc.log = keep_message;
        loader->quiet.desc.log_user = loader;
        if (pthread_create(&loader->thread, NULL, run_loader, loader) != 0) {
            return trl_fail(cache->ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_RASTER,
                            "no thread can be started to read rasters");
        }
        cache->loader_count++;
    }
    return TRL_OK;
}

static void tell_failure(struct tile_cache *cache, const char *message)
{
    (void)trl_fail(cache->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_RASTER, "%s (coarser texels stand in)",
                   message);
}

// Logs outside of the lock: a log function may do what it likes.
void tile_loaders_report(struct tile_cache *cache)
{
    for (uint32_t i = 0; i < cache->source_count; i++) {
        struct source *source = &cache->sources[i];
        char message[sizeof source->message];
        pthread_mutex_lock(&cache->lock);
        memcpy(message, source->message, sizeof message);
        source->message[0] = '\0';
        const bool tells_given_up = source->tells_given_up;
        source->tells_given_up = false;
        pthread_mutex_unlock(&cache->lock);
        if (message[0]) {
            tell_failure(cache, message);
        }
        if (tells_given_up) {
            trl_log(cache->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_RASTER,
                    "%s: its server fails again and again: no more is fetched, and asked again "
                    "in %.0f s",
                    source->desc.pyramid->raster.path, tile_loaders_patience_s(cache));
        }
    }
}

double tile_loaders_patience_s(const struct tile_cache *cache)
{
    return RETRIES_GIVEN_UP * cache->retry_s;
}

void tile_loader_take_up(struct source *source)
{
    source->is_given_up = false;
    source->failures = MOST_FAILURES - 1;
    source->wasted_s = 0;
}
