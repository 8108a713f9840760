// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The noise volume on disk, beside the solved atmospheres (scatter/cache.c): one file, of the seed
// used last.
#include "base/file.h"
#include "cloud/volume.h"

#include <string.h>
#include <unistd.h>

// To be raised when noise.c makes other values.
enum { FORMAT_VERSION = 1 };

struct header {
    char magic[8];
    uint32_t version, seed, side, border;
    uint64_t checksum; // of the texels
};

static const size_t TEXEL_BYTES = (size_t)CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE * 4;

static struct header make_header(uint32_t seed, const uint16_t *texels)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (size_t i = 0; i < TEXEL_BYTES / 2; i++) {
        hash = (hash ^ texels[i]) * 0x100000001b3u;
    }
    return (struct header){"TRLCLOU", FORMAT_VERSION, seed, CLOUD_SIDE, CLOUD_BORDER, hash};
}

static char *cache_path(const trl_context *ctx)
{
    return mem_printf(ctx, "%s/clouds.bin", ctx->cache_dir);
}

bool cloud_cache_load(const trl_context *ctx, uint32_t seed, uint16_t *texels)
{
    char *path = cache_path(ctx);
    char *data = NULL;
    size_t size = 0;
    // A cache that fails is worth one warning, not the errors of what it tried.
    const trl_context quiet = context_silenced(ctx);
    const size_t bytes = sizeof(struct header) + TEXEL_BYTES;
    bool is_loaded = path && access(path, F_OK) == 0 &&
                     file_read(&quiet, path, bytes, &data, &size) == TRL_OK && size == bytes;
    if (is_loaded) {
        memcpy(texels, data + sizeof(struct header), TEXEL_BYTES);
        const struct header wanted = make_header(seed, texels);
        is_loaded = memcmp(data, &wanted, sizeof wanted) == 0;
    }
    mem_free(ctx, data);
    mem_free(ctx, path);
    return is_loaded;
}

void cloud_cache_store(const trl_context *ctx, uint32_t seed, const uint16_t *texels)
{
    char *path = cache_path(ctx);
    char *data = mem_alloc(ctx, sizeof(struct header) + TEXEL_BYTES, 1);
    const trl_context quiet = context_silenced(ctx);
    trl_result result = path && data ? file_make_dirs(&quiet, ctx->cache_dir) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        const struct header header = make_header(seed, texels);
        memcpy(data, &header, sizeof header);
        memcpy(data + sizeof header, texels, TEXEL_BYTES);
        result = file_write(&quiet, path, data, sizeof header + TEXEL_BYTES);
    }
    if (result != TRL_OK) {
        trl_log(ctx, TRL_LOG_WARN, TRL_LOG_ITEM_CACHE,
                "the noise of clouds could not be kept in %s; the next start takes as long",
                ctx->cache_dir);
    }
    mem_free(ctx, data);
    mem_free(ctx, path);
}
