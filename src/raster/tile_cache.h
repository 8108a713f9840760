// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_TILE_CACHE_H
#define RASTER_TILE_CACHE_H
// Tiles of pyramids in memory, read by threads of its own, within a budget of bytes.
//
// Whoever draws begins a frame, asks for tiles with priorities, and uses those that are there. What
// was asked for in earlier frames and not begun is dropped. Of what is held, the tiles that were
// used longest ago make room for others; those that the current frame asked for, or that somebody
// holds, never do. A tile that cannot be read is reported once a source and not asked for again
// (over a network: after a while, see tile_cache_retry). A source behind a network that fails again
// and again, or for long, is given up as a whole, so that nobody waits for each of its tiles.

#include "raster/pyramid.h"

enum { TILE_CACHE_MAX_SOURCES = 64 };

// What a prepared tile holds, in the units of its texels; NaN: not told.
struct tile_range {
    float min, max;
};

// A tile that was read, and what is found about it.
struct tile_load {
    struct pyramid_tile tile;
    void *texels; // PYRAMID_TEXELS
    struct tile_range *range;
};

// Where tiles come from.
struct tile_source {
    const struct pyramid *pyramid; // must outlive the cache
    // Changes texels in place after `reader` read them; it may read more with that. On a loader's
    // thread, several at once. What it returns is as if reading had. NULL: nothing is changed.
    trl_result (*prepare)(const void *user, struct pyramid_reader *reader,
                          const struct tile_load *load);
    const void *user;
};

struct tile_key {
    uint32_t source; // as tile_cache_add gave it
    struct pyramid_tile tile;
};

enum tile_state {
    TILE_ABSENT,  // dropped, or there was no room
    TILE_WAITING, // asked for, or being read
    TILE_READY,
    TILE_FAILED
};

// One tile that is there. `texels` are PYRAMID_TEXELS.
struct tile_view {
    const void *texels;
    struct tile_range range;
};

struct tile_cache_desc {
    size_t max_bytes;
    uint32_t threads; // at least 1
    // How long a tile that a network did not bring is left alone; four times that a source which
    // was given up.
    double retry_s;
};

struct tile_cache_stats {
    uint64_t loaded, evicted, failed;
    uint64_t crowded_out; // there was no room, because a frame used all that was held
    size_t bytes, most_bytes;
    double read_s; // of all threads together
};

// Owner: caller. Threads: sources are added and frames made by one thread; tile_cache_hold and
// tile_cache_release from any.
struct tile_cache;

// Starts the threads. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result tile_cache_create(const trl_context *ctx,
                                          const struct tile_cache_desc *desc,
                                          struct tile_cache **out);

// Stops them, at the latest when the reads have ended that they are at. Nothing may be held.
void tile_cache_destroy(struct tile_cache **cache);

// The source's number. TRL_ERROR_INVALID (too many).
TRL_MUST_USE trl_result tile_cache_add(struct tile_cache *cache, const struct tile_source *source,
                                       uint32_t *index);

// What failed over a network and has been left alone for long enough may be asked for again from
// here on. Without it nothing is: whoever waits calls it once before, not while waiting.
void tile_cache_retry(struct tile_cache *cache);

// A new frame. Reports what failed since the last one.
void tile_cache_begin(struct tile_cache *cache);

// This frame uses the tile: asks for it if it is not there; larger priorities are read first. The
// view is good until the next tile_cache_begin.
enum tile_state tile_cache_want(struct tile_cache *cache, const struct tile_key *key,
                                float priority, struct tile_view *view);

// A later frame may use it, or somebody on the CPU: asked for, but not waited for, and dropped only
// after what was used longer ago.
void tile_cache_hint(struct tile_cache *cache, const struct tile_key *key, float priority);

// Waits until nothing is left that the current frame wants, and tells progress.
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result tile_cache_wait(struct tile_cache *cache);

// How many tiles that the current frame wants are neither there nor given up.
size_t tile_cache_missing(struct tile_cache *cache);

// Holds a tile until tile_cache_release; false when it is not there. With `waits` it is asked for
// before all others and waited for: false when it cannot be had.
bool tile_cache_hold(struct tile_cache *cache, const struct tile_key *key, bool waits,
                     struct tile_view *view);
void tile_cache_release(struct tile_cache *cache, const struct tile_key *key);

struct tile_cache_stats tile_cache_stats(struct tile_cache *cache);

#endif // RASTER_TILE_CACHE_H
