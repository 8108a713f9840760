// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The noise volume on disk, beside the solved atmospheres (scatter/cache.c): one file, of the seed
// used last.
#include "base/cache_file.h"
#include "cloud/volume.h"

// To be raised when noise.c makes other values.
enum { FORMAT_VERSION = 1 };

struct key {
    char magic[8];
    uint32_t version, seed, side, border;
};

static struct key make_key(uint32_t seed)
{
    return (struct key){"TRLCLOU", FORMAT_VERSION, seed, CLOUD_SIDE, CLOUD_BORDER};
}

static struct cache_file make_file(const struct key *key, uint16_t *texels)
{
    return (struct cache_file){.name = "clouds.bin",
                               .what = "the noise of clouds",
                               .key = key,
                               .key_bytes = sizeof *key,
                               .data = texels,
                               .data_bytes = (size_t)CLOUD_SIDE * CLOUD_SIDE * CLOUD_SIDE * 4};
}

bool cloud_cache_load(const trl_context *ctx, uint32_t seed, uint16_t *texels)
{
    const struct key key = make_key(seed);
    const struct cache_file file = make_file(&key, texels);
    return cache_file_load(ctx, &file);
}

void cloud_cache_store(const trl_context *ctx, uint32_t seed, uint16_t *texels)
{
    const struct key key = make_key(seed);
    const struct cache_file file = make_file(&key, texels);
    cache_file_store(ctx, &file);
}
