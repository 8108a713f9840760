// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_TILE_LOADER_H
#define RASTER_TILE_LOADER_H
// Private to the cache of tiles: what it holds, and its threads, which read tiles and give up
// sources whose server fails.
#include "raster/tile_table.h"

#include <pthread.h>

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
    struct tile_table tiles;
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

// Starts as many; cache->loader_count says how many run. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result tile_loaders_start(struct tile_cache *cache, uint32_t threads);

// Tells what failed since the last time. Without the lock.
void tile_loaders_report(struct tile_cache *cache);

// How long a source that was given up is left alone.
double tile_loaders_patience_s(const struct tile_cache *cache);

// With the lock:

// Marks whether the frame waits for the tile.
void tile_loader_set_wanted(struct tile_cache *cache, struct tile *tile, bool is_wanted);

// Whether the tile is one that nobody asks the server for now. Coarse ones come from memory.
bool tile_loader_is_given_up(const struct tile_cache *cache, const struct tile_key *key);

// Asks again from now on: one more failure, and the source is given up again.
void tile_loader_take_up(struct source *source);

bool tile_loader_is_remote(const struct source *source);

// Seconds of a clock that only runs forward. No lock is needed.
double tile_loader_now_s(void);

#endif // RASTER_TILE_LOADER_H
