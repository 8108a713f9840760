// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "base/cache_file.h"

#include "base/file.h"
#include "base/hash.h"

#include <unistd.h>

static char *find_path(const trl_context *ctx, const struct cache_file *file)
{
    return ctx->cache_dir[0] ? mem_printf(ctx, "%s/%s", ctx->cache_dir, file->name) : NULL;
}

static size_t count_bytes(const struct cache_file *file)
{
    return file->key_bytes + sizeof(uint64_t) + file->data_bytes;
}

static bool unpack(const struct cache_file *file, const char *bytes)
{
    uint64_t checksum;
    const char *data = bytes + file->key_bytes + sizeof checksum;
    memcpy(&checksum, bytes + file->key_bytes, sizeof checksum);
    if (memcmp(bytes, file->key, file->key_bytes) != 0 ||
        checksum != hash_bytes(HASH_BEGIN, data, file->data_bytes)) {
        return false;
    }
    memcpy(file->data, data, file->data_bytes);
    return true;
}

static void pack(const struct cache_file *file, char *bytes)
{
    const uint64_t checksum = hash_bytes(HASH_BEGIN, file->data, file->data_bytes);
    memcpy(bytes, file->key, file->key_bytes);
    memcpy(bytes + file->key_bytes, &checksum, sizeof checksum);
    memcpy(bytes + file->key_bytes + sizeof checksum, file->data, file->data_bytes);
}

bool cache_file_load(const trl_context *ctx, const struct cache_file *file)
{
    char *path = find_path(ctx, file);
    char *bytes = NULL;
    size_t size = 0;
    // A cache that fails is no error: all is made anew.
    const trl_context quiet = context_silenced(ctx);
    const bool is_loaded = path && access(path, F_OK) == 0 &&
                           file_read(&quiet, path, count_bytes(file), &bytes, &size) == TRL_OK &&
                           size == count_bytes(file) && unpack(file, bytes);
    mem_free(ctx, bytes);
    mem_free(ctx, path);
    return is_loaded;
}

void cache_file_store(const trl_context *ctx, const struct cache_file *file)
{
    if (!ctx->cache_dir[0]) {
        return;
    }
    char *path = find_path(ctx, file);
    char *bytes = mem_alloc(ctx, count_bytes(file), 1);
    const trl_context quiet = context_silenced(ctx);
    trl_result result = path && bytes ? file_make_dirs(&quiet, ctx->cache_dir) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        pack(file, bytes);
        result = file_write(&quiet, path, bytes, count_bytes(file));
    }
    if (result != TRL_OK) {
        trl_log(ctx, TRL_LOG_WARN, TRL_LOG_ITEM_CACHE,
                "%s could not be kept in %s; the next start takes as long", file->what,
                ctx->cache_dir);
    }
    mem_free(ctx, bytes);
    mem_free(ctx, path);
}
