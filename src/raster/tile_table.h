// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_TILE_TABLE_H
#define RASTER_TILE_TABLE_H
// The tiles that a cache knows, by key, and those that are ready in the order of their use. Private
// to the cache, whose lock is held at each call.
#include "raster/tile_cache.h"

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

// Owner: the cache.
struct tile_table {
    const trl_context *ctx;
    struct tile **buckets; // owned, with the tiles
    size_t bucket_count, tile_count;
    struct tile *oldest, *newest;
};

TRL_MUST_USE trl_result tile_table_init(const trl_context *ctx, struct tile_table *out);

// Frees all tiles. A zeroed table is a no-op.
void tile_table_finish(struct tile_table *table);

// NULL: there is none.
struct tile *tile_table_find(const struct tile_table *table, const struct tile_key *key);

// A new tile, absent. NULL: memory is out.
struct tile *tile_table_add(struct tile_table *table, const struct tile_key *key);

// Frees the tile, which must not be linked.
void tile_table_remove(struct tile_table *table, struct tile *tile);

// Into the order of use as the newest, out of it, and to its end where the tile is ready.
void tile_table_link(struct tile_table *table, struct tile *tile);
void tile_table_unlink(struct tile_table *table, struct tile *tile);
void tile_table_touch(struct tile_table *table, struct tile *tile);

#endif // RASTER_TILE_TABLE_H
