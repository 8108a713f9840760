// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/tile_cache.h"

#include "raster/tile_loader.h"

#include <math.h>
#include <string.h>
#include <time.h>

enum { MAX_THREADS = 16, FIRST_QUEUE = 256, WAIT_MS = 50 };
static const float HELD_PRIORITY = INFINITY;

static bool push_queue(struct tile_cache *cache, struct tile *tile)
{
    if (cache->queue_count == cache->queue_size) {
        const size_t size = 2 * cache->queue_size;
        struct tile **queue = mem_alloc(cache->ctx, size, sizeof *queue);
        if (!queue) {
            return false;
        }
        memcpy(queue, cache->queue, cache->queue_count * sizeof *queue);
        mem_free(cache->ctx, cache->queue);
        cache->queue = queue;
        cache->queue_size = size;
    }
    cache->queue[cache->queue_count++] = tile;
    return true;
}

trl_result tile_cache_create(const trl_context *ctx, const struct tile_cache_desc *desc,
                             struct tile_cache **out)
{
    *out = NULL;
    struct tile_cache *cache = mem_alloc(ctx, 1, sizeof *cache);
    if (!cache) {
        return TRL_ERROR_MEMORY;
    }
    cache->ctx = ctx;
    cache->max_bytes = desc->max_bytes;
    cache->retry_s = desc->retry_s;
    cache->frame = 1;
    pthread_condattr_t clock;
    pthread_condattr_init(&clock);
    pthread_condattr_setclock(&clock, CLOCK_MONOTONIC);
    pthread_mutex_init(&cache->lock, NULL);
    pthread_cond_init(&cache->work, NULL);
    pthread_cond_init(&cache->news, &clock);
    pthread_condattr_destroy(&clock);
    const uint32_t threads = desc->threads < 1             ? 1
                             : desc->threads > MAX_THREADS ? MAX_THREADS
                                                           : desc->threads;
    cache->queue_size = FIRST_QUEUE;
    cache->queue = mem_alloc(ctx, FIRST_QUEUE, sizeof *cache->queue);
    cache->loaders = mem_alloc(ctx, threads, sizeof *cache->loaders);
    trl_result result = cache->queue && cache->loaders ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = tile_table_init(ctx, &cache->tiles);
    }
    if (result == TRL_OK) {
        result = tile_loaders_start(cache, threads);
    }
    if (result != TRL_OK) {
        tile_cache_destroy(&cache);
    }
    *out = cache;
    return result;
}

void tile_cache_destroy(struct tile_cache **pointer)
{
    struct tile_cache *cache = *pointer;
    if (!cache) {
        return;
    }
    pthread_mutex_lock(&cache->lock);
    cache->is_stopping = true;
    pthread_cond_broadcast(&cache->work);
    pthread_mutex_unlock(&cache->lock);
    for (uint32_t i = 0; i < cache->loader_count; i++) {
        pthread_join(cache->loaders[i].thread, NULL);
    }
    tile_loaders_report(cache);
    tile_table_finish(&cache->tiles);
    pthread_cond_destroy(&cache->work);
    pthread_cond_destroy(&cache->news);
    pthread_mutex_destroy(&cache->lock);
    mem_free(cache->ctx, cache->queue);
    mem_free(cache->ctx, cache->loaders);
    mem_free(cache->ctx, cache);
    *pointer = NULL;
}

trl_result tile_cache_add(struct tile_cache *cache, const struct tile_source *source,
                          uint32_t *index)
{
    if (cache->source_count == TILE_CACHE_MAX_SOURCES) {
        return trl_fail(cache->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_RASTER,
                        "%s: %d rasters are all that can be read in tiles",
                        source->pyramid->raster.path, TILE_CACHE_MAX_SOURCES);
    }
    pthread_mutex_lock(&cache->lock);
    *index = cache->source_count++;
    cache->sources[*index] = (struct source){
        .desc = *source, .bytes = PYRAMID_TEXELS * pyramid_texel_bytes(source->pyramid->format)};
    pthread_mutex_unlock(&cache->lock);
    return TRL_OK;
}

void tile_cache_begin(struct tile_cache *cache)
{
    tile_loaders_report(cache);
    pthread_mutex_lock(&cache->lock);
    cache->frame++;
    size_t kept = 0;
    for (size_t i = 0; i < cache->queue_count; i++) {
        struct tile *tile = cache->queue[i];
        if (tile->holders > 0) {
            cache->queue[kept++] = tile;
        } else {
            tile_loader_set_wanted(cache, tile, false);
            tile_table_remove(&cache->tiles, tile);
        }
    }
    cache->queue_count = kept;
    // Those that are being read are not waited for any more.
    for (uint32_t i = 0; i < cache->loader_count; i++) {
        struct tile *tile = cache->loaders[i].current;
        if (tile && tile->holders == 0) {
            tile_loader_set_wanted(cache, tile, false);
        }
    }
    pthread_mutex_unlock(&cache->lock);
}

void tile_cache_retry(struct tile_cache *cache)
{
    pthread_mutex_lock(&cache->lock);
    const double now = tile_loader_now_s();
    cache->forgiven_s = now - cache->retry_s;
    for (uint32_t i = 0; i < cache->source_count; i++) {
        struct source *source = &cache->sources[i];
        if (source->is_given_up && now - source->given_up_s > tile_loaders_patience_s(cache)) {
            tile_loader_take_up(source);
        }
    }
    pthread_mutex_unlock(&cache->lock);
}

static bool may_retry(const struct tile_cache *cache, const struct tile *tile)
{
    return tile_loader_is_remote(&cache->sources[tile->key.source]) &&
           tile->failed_s < cache->forgiven_s;
}

// Finds the tile or makes it, and asks for it. NULL when memory is out, or the source given up.
// With the lock.
static struct tile *ask_for(struct tile_cache *cache, const struct tile_key *key, float priority)
{
    struct tile *tile = tile_table_find(&cache->tiles, key);
    if (tile_loader_is_given_up(cache, key)) {
        return tile;
    }
    if (!tile) {
        tile = tile_table_add(&cache->tiles, key);
    }
    if (!tile) {
        return NULL;
    }
    const bool is_asked =
        tile->state == TILE_ABSENT || (tile->state == TILE_FAILED && may_retry(cache, tile));
    if (is_asked) {
        if (!push_queue(cache, tile)) {
            if (tile->state == TILE_ABSENT && tile->holders == 0) {
                tile_table_remove(&cache->tiles, tile);
            }
            return NULL;
        }
        tile->state = TILE_WAITING;
        tile->priority = priority;
        pthread_cond_signal(&cache->work);
    }
    tile->priority = fmaxf(tile->priority, priority);
    return tile;
}

enum tile_state tile_cache_want(struct tile_cache *cache, const struct tile_key *key,
                                float priority, struct tile_view *view)
{
    *view = (struct tile_view){0};
    pthread_mutex_lock(&cache->lock);
    struct tile *tile = ask_for(cache, key, priority);
    const enum tile_state missing = tile_loader_is_given_up(cache, key) ? TILE_FAILED : TILE_ABSENT;
    const enum tile_state state = tile ? tile->state : missing;
    if (tile) {
        tile->frame = cache->frame;
        tile_table_touch(&cache->tiles, tile);
    }
    if (state == TILE_WAITING) {
        tile_loader_set_wanted(cache, tile, true);
    } else if (state == TILE_READY) {
        *view = (struct tile_view){tile->texels, tile->range};
    }
    pthread_mutex_unlock(&cache->lock);
    return state;
}

void tile_cache_hint(struct tile_cache *cache, const struct tile_key *key, float priority)
{
    pthread_mutex_lock(&cache->lock);
    struct tile *tile = ask_for(cache, key, priority);
    if (tile) {
        tile_table_touch(&cache->tiles, tile);
    }
    pthread_mutex_unlock(&cache->lock);
}

// Waits for news, not for ever: whoever waits also asks whether to go on.
static void wait_for_news(struct tile_cache *cache)
{
    struct timespec until;
    clock_gettime(CLOCK_MONOTONIC, &until);
    until.tv_nsec += WAIT_MS * 1000000L;
    until.tv_sec += until.tv_nsec / 1000000000L;
    until.tv_nsec %= 1000000000L;
    pthread_cond_timedwait(&cache->news, &cache->lock, &until);
}

trl_result tile_cache_wait(struct tile_cache *cache)
{
    trl_result result = TRL_OK;
    pthread_mutex_lock(&cache->lock);
    const size_t all = cache->missing;
    while (cache->missing > 0 && result == TRL_OK) {
        wait_for_news(cache);
        const size_t missing = cache->missing;
        pthread_mutex_unlock(&cache->lock);
        result = trl_progress(cache->ctx, "reading rasters",
                              missing > all ? 0 : 1 - (double)missing / (double)all);
        pthread_mutex_lock(&cache->lock);
    }
    pthread_mutex_unlock(&cache->lock);
    return result;
}

size_t tile_cache_missing(struct tile_cache *cache)
{
    pthread_mutex_lock(&cache->lock);
    const size_t missing = cache->missing;
    pthread_mutex_unlock(&cache->lock);
    return missing;
}

bool tile_cache_hold(struct tile_cache *cache, const struct tile_key *key, bool waits,
                     struct tile_view *view)
{
    *view = (struct tile_view){0};
    pthread_mutex_lock(&cache->lock);
    struct tile *tile =
        waits ? ask_for(cache, key, HELD_PRIORITY) : tile_table_find(&cache->tiles, key);
    if (tile) {
        tile->holders++;
        while (waits && tile->state == TILE_WAITING && !cache->is_stopping) {
            wait_for_news(cache);
        }
    }
    const bool is_there = tile && tile->state == TILE_READY;
    if (is_there) {
        tile_table_touch(&cache->tiles, tile);
        *view = (struct tile_view){tile->texels, tile->range};
    } else if (tile) {
        tile->holders--;
        if (tile->state == TILE_ABSENT && tile->holders == 0) {
            tile_table_remove(&cache->tiles, tile);
        }
    }
    pthread_mutex_unlock(&cache->lock);
    return is_there;
}

void tile_cache_release(struct tile_cache *cache, const struct tile_key *key)
{
    pthread_mutex_lock(&cache->lock);
    struct tile *tile = tile_table_find(&cache->tiles, key);
    if (tile) {
        tile->holders--;
    }
    pthread_mutex_unlock(&cache->lock);
}

struct tile_cache_stats tile_cache_stats(struct tile_cache *cache)
{
    pthread_mutex_lock(&cache->lock);
    const struct tile_cache_stats stats = cache->stats;
    pthread_mutex_unlock(&cache->lock);
    return stats;
}
