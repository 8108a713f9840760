// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/tile_cache.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { MAX_THREADS = 16, FIRST_BUCKETS = 256, WAIT_MS = 50 };
// A source behind a network is given up after so many failures one after another, or when failures
// took so much longer than what came: a request may take a minute, and a view shows hundreds.
enum { MOST_FAILURES = 8 };
static const double MOST_WASTED_S = 40;
static const double RETRIES_GIVEN_UP = 4; // in times of tile_cache_desc.retry_s
static const float HELD_PRIORITY = INFINITY;

struct tile {
    struct tile_key key;
    enum tile_state state;
    bool is_wanted; // by the current frame, or by one that waits
    float priority;
    uint32_t holders;
    uint64_t frame; // that used it last
    double failed_s;
    void *texels; // owned
    struct tile_range range;
    struct tile *next_of_bucket;
    struct tile *older, *newer; // of those that are ready, by use
};

struct source {
    struct tile_source desc;
    size_t bytes; // of a tile
    bool has_failed;
    char message[512]; // of its first failure, until it is told
    uint32_t failures; // since something came
    double wasted_s;   // in failures, less what was spent on what came
    bool is_given_up;
    double given_up_s; // when
    bool was_given_up, tells_given_up;
};

struct loader {
    struct tile_cache *cache;
    pthread_t thread;
    trl_context quiet; // keeps the message of a failure instead of logging it
    char message[512];
    struct tile *current; // that it reads
    struct pyramid_reader readers[TILE_CACHE_MAX_SOURCES];
};

struct tile_cache {
    const trl_context *ctx;
    size_t max_bytes;
    double retry_s;
    pthread_mutex_t lock; // of all below but the threads
    pthread_cond_t work, news;
    bool is_stopping;
    uint32_t source_count;
    struct source sources[TILE_CACHE_MAX_SOURCES];
    struct tile **buckets; // owned
    size_t bucket_count, tile_count;
    struct tile *oldest, *newest;
    struct tile **queue; // owned; waiting ones that nobody has begun
    size_t queue_count, queue_size;
    size_t missing;  // wanted and waiting
    size_t reserved; // bytes of tiles that are being read
    uint64_t frame;
    double forgiven_s; // what failed before may be asked for again
    struct tile_cache_stats stats;
    uint32_t loader_count;
    struct loader *loaders; // owned
};

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static size_t hash_key(const struct tile_key *key)
{
    // The finaliser of MurmurHash3 (Appleby 2011), 64 bits.
    uint64_t h = (uint64_t)key->source << 56 ^ (uint64_t)key->tile.level << 48 ^
                 (uint64_t)key->tile.x << 24 ^ key->tile.y;
    h = (h ^ h >> 33) * 0xff51afd7ed558ccdull;
    h = (h ^ h >> 33) * 0xc4ceb9fe1a85ec53ull;
    return (size_t)(h ^ h >> 33);
}

static bool is_same(const struct tile_key *a, const struct tile_key *b)
{
    return a->source == b->source && a->tile.level == b->tile.level && a->tile.x == b->tile.x &&
           a->tile.y == b->tile.y;
}

static struct tile *find_tile(const struct tile_cache *cache, const struct tile_key *key)
{
    struct tile *tile = cache->buckets[hash_key(key) % cache->bucket_count];
    while (tile && !is_same(&tile->key, key)) {
        tile = tile->next_of_bucket;
    }
    return tile;
}

static void put_in_bucket(struct tile **buckets, size_t count, struct tile *tile)
{
    struct tile **bucket = &buckets[hash_key(&tile->key) % count];
    tile->next_of_bucket = *bucket;
    *bucket = tile;
}

// Twice the buckets when there are more tiles than those; without memory lists get longer.
static void grow_buckets(struct tile_cache *cache)
{
    const size_t count = 2 * cache->bucket_count;
    struct tile **buckets = mem_alloc(cache->ctx, count, sizeof *buckets);
    if (!buckets) {
        return;
    }
    for (size_t i = 0; i < cache->bucket_count; i++) {
        for (struct tile *tile = cache->buckets[i]; tile;) {
            struct tile *next = tile->next_of_bucket;
            put_in_bucket(buckets, count, tile);
            tile = next;
        }
    }
    mem_free(cache->ctx, cache->buckets);
    cache->buckets = buckets;
    cache->bucket_count = count;
}

static struct tile *make_tile(struct tile_cache *cache, const struct tile_key *key)
{
    struct tile *tile = mem_alloc(cache->ctx, 1, sizeof *tile);
    if (tile) {
        tile->key = *key;
        if (++cache->tile_count > cache->bucket_count) {
            grow_buckets(cache);
        }
        put_in_bucket(cache->buckets, cache->bucket_count, tile);
    }
    return tile;
}

static void forget_tile(struct tile_cache *cache, struct tile *tile)
{
    struct tile **at = &cache->buckets[hash_key(&tile->key) % cache->bucket_count];
    while (*at != tile) {
        at = &(*at)->next_of_bucket;
    }
    *at = tile->next_of_bucket;
    cache->tile_count--;
    mem_free(cache->ctx, tile->texels);
    mem_free(cache->ctx, tile);
}

static void unlink_tile(struct tile_cache *cache, struct tile *tile)
{
    *(tile->older ? &tile->older->newer : &cache->oldest) = tile->newer;
    *(tile->newer ? &tile->newer->older : &cache->newest) = tile->older;
    tile->older = tile->newer = NULL;
}

static void link_newest(struct tile_cache *cache, struct tile *tile)
{
    tile->older = cache->newest;
    *(cache->newest ? &cache->newest->newer : &cache->oldest) = tile;
    cache->newest = tile;
}

static void touch_tile(struct tile_cache *cache, struct tile *tile)
{
    if (tile->state == TILE_READY && cache->newest != tile) {
        unlink_tile(cache, tile);
        link_newest(cache, tile);
    }
}

// Whether `bytes` more are within the budget now.
static bool make_room(struct tile_cache *cache, size_t bytes)
{
    struct tile *tile = cache->oldest;
    while (tile && cache->stats.bytes + cache->reserved + bytes > cache->max_bytes) {
        struct tile *newer = tile->newer;
        if (tile->holders == 0 && tile->frame != cache->frame) {
            cache->stats.bytes -= cache->sources[tile->key.source].bytes;
            cache->stats.evicted++;
            unlink_tile(cache, tile);
            forget_tile(cache, tile);
        }
        tile = newer;
    }
    return cache->stats.bytes + cache->reserved + bytes <= cache->max_bytes;
}

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

static void set_wanted(struct tile_cache *cache, struct tile *tile, bool is_wanted)
{
    if (tile->is_wanted != is_wanted) {
        tile->is_wanted = is_wanted;
        cache->missing += is_wanted ? 1 : (size_t)-1;
    }
}

static void end_tile(struct tile_cache *cache, struct tile *tile, enum tile_state state)
{
    tile->state = state;
    set_wanted(cache, tile, false);
    if (state == TILE_READY) {
        link_newest(cache, tile);
    }
    if (state == TILE_ABSENT && tile->holders == 0) {
        forget_tile(cache, tile);
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

static bool is_remote(const struct source *source)
{
    return source->desc.pyramid->raster.is_remote;
}

// Whether the tile is one that nobody asks the server for now. Coarse ones come from memory.
static bool is_given_up(const struct tile_cache *cache, const struct tile_key *key)
{
    const struct source *source = &cache->sources[key->source];
    return source->is_given_up && key->tile.level < source->desc.pyramid->base_level;
}

// What waits of the source fails with it.
static void give_up(struct tile_cache *cache, struct source *source)
{
    source->is_given_up = true;
    source->given_up_s = now_s();
    source->tells_given_up = !source->was_given_up;
    source->was_given_up = true;
    size_t kept = 0;
    for (size_t i = 0; i < cache->queue_count; i++) {
        struct tile *tile = cache->queue[i];
        if (&cache->sources[tile->key.source] == source && is_given_up(cache, &tile->key)) {
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
    tile->failed_s = now_s();
    end_tile(cache, tile, TILE_FAILED);
    source->failures++;
    source->wasted_s += spent_s;
    if (is_remote(source) && !source->is_given_up &&
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
    const double begun_s = now_s();
    const trl_result result = read_tile(loader, &source, &key, &read);
    const double spent_s = now_s() - begun_s;
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

static trl_result start_loaders(struct tile_cache *cache, uint32_t threads)
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
    cache->bucket_count = cache->queue_size = FIRST_BUCKETS;
    cache->buckets = mem_alloc(ctx, FIRST_BUCKETS, sizeof *cache->buckets);
    cache->queue = mem_alloc(ctx, FIRST_BUCKETS, sizeof *cache->queue);
    cache->loaders = mem_alloc(ctx, threads, sizeof *cache->loaders);
    trl_result result = TRL_ERROR_MEMORY;
    if (cache->buckets && cache->queue && cache->loaders) {
        result = start_loaders(cache, threads);
    }
    if (result != TRL_OK) {
        tile_cache_destroy(&cache);
    }
    *out = cache;
    return result;
}

static void tell_failure(struct tile_cache *cache, const char *message)
{
    (void)trl_fail(cache->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_RASTER, "%s (coarser texels stand in)",
                   message);
}

// Logs outside of the lock: a log function may do what it likes.
static void report_failures(struct tile_cache *cache)
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
                    source->desc.pyramid->raster.path, RETRIES_GIVEN_UP * cache->retry_s);
        }
    }
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
    report_failures(cache);
    for (size_t i = 0; cache->buckets && i < cache->bucket_count; i++) {
        while (cache->buckets[i]) {
            forget_tile(cache, cache->buckets[i]);
        }
    }
    pthread_cond_destroy(&cache->work);
    pthread_cond_destroy(&cache->news);
    pthread_mutex_destroy(&cache->lock);
    mem_free(cache->ctx, cache->buckets);
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
    report_failures(cache);
    pthread_mutex_lock(&cache->lock);
    cache->frame++;
    size_t kept = 0;
    for (size_t i = 0; i < cache->queue_count; i++) {
        struct tile *tile = cache->queue[i];
        if (tile->holders > 0) {
            cache->queue[kept++] = tile;
        } else {
            set_wanted(cache, tile, false);
            forget_tile(cache, tile);
        }
    }
    cache->queue_count = kept;
    // Those that are being read are not waited for any more.
    for (uint32_t i = 0; i < cache->loader_count; i++) {
        struct tile *tile = cache->loaders[i].current;
        if (tile && tile->holders == 0) {
            set_wanted(cache, tile, false);
        }
    }
    pthread_mutex_unlock(&cache->lock);
}

void tile_cache_retry(struct tile_cache *cache)
{
    pthread_mutex_lock(&cache->lock);
    const double now = now_s();
    cache->forgiven_s = now - cache->retry_s;
    for (uint32_t i = 0; i < cache->source_count; i++) {
        struct source *source = &cache->sources[i];
        if (source->is_given_up && now - source->given_up_s > RETRIES_GIVEN_UP * cache->retry_s) {
            source->is_given_up = false;
            source->failures = MOST_FAILURES - 1; // one more will do
            source->wasted_s = 0;
        }
    }
    pthread_mutex_unlock(&cache->lock);
}

static bool may_retry(const struct tile_cache *cache, const struct tile *tile)
{
    return is_remote(&cache->sources[tile->key.source]) && tile->failed_s < cache->forgiven_s;
}

// Finds the tile or makes it, and asks for it. NULL when memory is out, or the source given up.
// With the lock.
static struct tile *ask_for(struct tile_cache *cache, const struct tile_key *key, float priority)
{
    struct tile *tile = find_tile(cache, key);
    if (is_given_up(cache, key)) {
        return tile;
    }
    if (!tile) {
        tile = make_tile(cache, key);
    }
    if (!tile) {
        return NULL;
    }
    const bool is_asked =
        tile->state == TILE_ABSENT || (tile->state == TILE_FAILED && may_retry(cache, tile));
    if (is_asked) {
        if (!push_queue(cache, tile)) {
            if (tile->state == TILE_ABSENT && tile->holders == 0) {
                forget_tile(cache, tile);
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
    const enum tile_state missing = is_given_up(cache, key) ? TILE_FAILED : TILE_ABSENT;
    const enum tile_state state = tile ? tile->state : missing;
    if (tile) {
        tile->frame = cache->frame;
        touch_tile(cache, tile);
    }
    if (state == TILE_WAITING) {
        set_wanted(cache, tile, true);
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
        touch_tile(cache, tile);
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
    struct tile *tile = waits ? ask_for(cache, key, HELD_PRIORITY) : find_tile(cache, key);
    if (tile) {
        tile->holders++;
        while (waits && tile->state == TILE_WAITING && !cache->is_stopping) {
            wait_for_news(cache);
        }
    }
    const bool is_there = tile && tile->state == TILE_READY;
    if (is_there) {
        touch_tile(cache, tile);
        *view = (struct tile_view){tile->texels, tile->range};
    } else if (tile) {
        tile->holders--;
        if (tile->state == TILE_ABSENT && tile->holders == 0) {
            forget_tile(cache, tile);
        }
    }
    pthread_mutex_unlock(&cache->lock);
    return is_there;
}

void tile_cache_release(struct tile_cache *cache, const struct tile_key *key)
{
    pthread_mutex_lock(&cache->lock);
    struct tile *tile = find_tile(cache, key);
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
