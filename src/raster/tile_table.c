// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/tile_table.h"

enum { FIRST_BUCKETS = 256 };

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

trl_result tile_table_init(const trl_context *ctx, struct tile_table *out)
{
    *out = (struct tile_table){.ctx = ctx,
                               .buckets = mem_alloc(ctx, FIRST_BUCKETS, sizeof *out->buckets),
                               .bucket_count = FIRST_BUCKETS};
    return out->buckets ? TRL_OK : TRL_ERROR_MEMORY;
}

void tile_table_finish(struct tile_table *table)
{
    for (size_t i = 0; table->buckets && i < table->bucket_count; i++) {
        while (table->buckets[i]) {
            tile_table_remove(table, table->buckets[i]);
        }
    }
    if (table->ctx) {
        mem_free(table->ctx, table->buckets);
    }
    *table = (struct tile_table){0};
}

struct tile *tile_table_find(const struct tile_table *table, const struct tile_key *key)
{
    struct tile *tile = table->buckets[hash_key(key) % table->bucket_count];
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
static void grow_buckets(struct tile_table *table)
{
    const size_t count = 2 * table->bucket_count;
    struct tile **buckets = mem_alloc(table->ctx, count, sizeof *buckets);
    if (!buckets) {
        return;
    }
    for (size_t i = 0; i < table->bucket_count; i++) {
        for (struct tile *tile = table->buckets[i]; tile;) {
            struct tile *next = tile->next_of_bucket;
            put_in_bucket(buckets, count, tile);
            tile = next;
        }
    }
    mem_free(table->ctx, table->buckets);
    table->buckets = buckets;
    table->bucket_count = count;
}

struct tile *tile_table_add(struct tile_table *table, const struct tile_key *key)
{
    struct tile *tile = mem_alloc(table->ctx, 1, sizeof *tile);
    if (tile) {
        tile->key = *key;
        if (++table->tile_count > table->bucket_count) {
            grow_buckets(table);
        }
        put_in_bucket(table->buckets, table->bucket_count, tile);
    }
    return tile;
}

void tile_table_remove(struct tile_table *table, struct tile *tile)
{
    struct tile **at = &table->buckets[hash_key(&tile->key) % table->bucket_count];
    while (*at != tile) {
        at = &(*at)->next_of_bucket;
    }
    *at = tile->next_of_bucket;
    table->tile_count--;
    mem_free(table->ctx, tile->texels);
    mem_free(table->ctx, tile);
}

void tile_table_unlink(struct tile_table *table, struct tile *tile)
{
    *(tile->older ? &tile->older->newer : &table->oldest) = tile->newer;
    *(tile->newer ? &tile->newer->older : &table->newest) = tile->older;
    tile->older = tile->newer = NULL;
}

void tile_table_link(struct tile_table *table, struct tile *tile)
{
    tile->older = table->newest;
    *(table->newest ? &table->newest->newer : &table->oldest) = tile;
    table->newest = tile;
}

void tile_table_touch(struct tile_table *table, struct tile *tile)
{
    if (tile->state == TILE_READY && table->newest != tile) {
        tile_table_unlink(table, tile);
        tile_table_link(table, tile);
    }
}
