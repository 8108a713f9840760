// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tables of light in the water on disk, beside the solved atmospheres (scatter/cache.c): eight
// places, by a hash of all that a table follows from, which is in the file too.
#include "base/file.h"
#include "ocean/volume.h"

#include <stddef.h>
#include <string.h>
#include <unistd.h>

// To be raised when the solver gives other values.
enum { FORMAT_VERSION = 1 };

enum { PLACES = 8 };

struct header {
    char magic[8];
    uint64_t version, checksum; // of the whole table
};

// What a table follows from comes first in it.
static const size_t KEY_BYTES = offsetof(struct volume_table, star);

static uint64_t hash(const void *data, size_t size)
{
    uint64_t value = 0xcbf29ce484222325u;
    for (size_t i = 0; i < size; i++) {
        value = (value ^ ((const unsigned char *)data)[i]) * 0x100000001b3u;
    }
    return value;
}

static char *cache_path(const trl_context *ctx, const struct volume_table *table)
{
    return mem_printf(ctx, "%s/water-%u.bin", ctx->cache_dir,
                      (unsigned)(hash(table, KEY_BYTES) % PLACES));
}

static struct header make_header(const struct volume_table *table)
{
    return (struct header){"TRLWATE", FORMAT_VERSION, hash(table, sizeof *table)};
}

bool volume_cache_load(const trl_context *ctx, struct volume_table *table)
{
    char *path = cache_path(ctx, table);
    char *data = NULL;
    size_t size = 0;
    // A cache that fails is no error: all is solved anew.
    const trl_context quiet = context_silenced(ctx);
    const size_t bytes = sizeof(struct header) + sizeof *table;
    bool is_loaded = path && access(path, F_OK) == 0 &&
                     file_read(&quiet, path, bytes, &data, &size) == TRL_OK && size == bytes &&
                     memcmp(data + sizeof(struct header), table, KEY_BYTES) == 0;
    if (is_loaded) {
        memcpy(table, data + sizeof(struct header), sizeof *table);
        const struct header wanted = make_header(table);
        is_loaded = memcmp(data, &wanted, sizeof wanted) == 0;
    }
    mem_free(ctx, data);
    mem_free(ctx, path);
    return is_loaded;
}

void volume_cache_store(const trl_context *ctx, const struct volume_table *table)
{
    char *path = cache_path(ctx, table);
    char *data = mem_alloc(ctx, sizeof(struct header) + sizeof *table, 1);
    const trl_context quiet = context_silenced(ctx);
    trl_result result = path && data ? file_make_dirs(&quiet, ctx->cache_dir) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        const struct header header = make_header(table);
        memcpy(data, &header, sizeof header);
        memcpy(data + sizeof header, table, sizeof *table);
        result = file_write(&quiet, path, data, sizeof header + sizeof *table);
    }
    if (result != TRL_OK) {
        trl_log(ctx, TRL_LOG_WARN, TRL_LOG_ITEM_CACHE,
                "light in the water could not be kept in %s; the next start takes as long",
                ctx->cache_dir);
    }
    mem_free(ctx, data);
    mem_free(ctx, path);
}
