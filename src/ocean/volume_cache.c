// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tables of light in the water on disk, beside the solved atmospheres (scatter/cache.c): eight
// places, by a hash of all that a table follows from, which is in the file too.
#include "base/cache_file.h"
#include "base/hash.h"
#include "ocean/volume.h"

#include <stdio.h>

// To be raised when the solver gives other values.
enum { FORMAT_VERSION = 4 };

enum { PLACES = 8, MAX_INPUT_BYTES = 4096 };

struct entry {
    char name[32];
    struct {
        char magic[8];
        uint64_t version;
        char inputs[MAX_INPUT_BYTES];
    } key;
    struct cache_file file;
};

static void describe(const struct volume_kept *kept, struct entry *out)
{
    *out = (struct entry){.key = {"TRLWATE", FORMAT_VERSION, {0}}};
    memcpy(out->key.inputs, kept->table, kept->input_bytes);
    const uint64_t hash = hash_bytes(HASH_BEGIN, kept->table, kept->input_bytes);
    snprintf(out->name, sizeof out->name, "%s-%u.bin", kept->name, (unsigned)(hash % PLACES));
    out->file = (struct cache_file){.name = out->name,
                                    .what = "light in the water",
                                    .key = &out->key,
                                    .key_bytes = sizeof out->key,
                                    .data = (char *)kept->table + kept->input_bytes,
                                    .data_bytes = kept->bytes - kept->input_bytes};
}

bool volume_cache_load(const trl_context *ctx, const struct volume_kept *kept)
{
    struct entry entry;
    describe(kept, &entry);
    return cache_file_load(ctx, &entry.file);
}

void volume_cache_store(const trl_context *ctx, const struct volume_kept *kept)
{
    struct entry entry;
    describe(kept, &entry);
    cache_file_store(ctx, &entry.file);
}
