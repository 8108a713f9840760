// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tables of light in the water on disk, beside the solved atmospheres (scatter/cache.c): eight
// places, by a hash of all that a table follows from, which is in the file too.
#include "base/cache_file.h"
#include "base/hash.h"
#include "ocean/volume.h"

#include <stdio.h>

// To be raised when the solver gives other values.
enum { FORMAT_VERSION = 2 };

enum { PLACES = 8 };

// What a table follows from comes first in it; it was zeroed as a whole, padding included.
enum { INPUT_BYTES = offsetof(struct volume_table, star) };

struct entry {
    char name[32];
    struct {
        char magic[8];
        uint64_t version;
        char inputs[INPUT_BYTES];
    } key;
    struct cache_file file;
};

static void describe(struct volume_table *table, struct entry *out)
{
    *out = (struct entry){.key = {"TRLWATE", FORMAT_VERSION, {0}}};
    memcpy(out->key.inputs, table, INPUT_BYTES);
    const uint64_t hash = hash_bytes(HASH_BEGIN, table, INPUT_BYTES);
    snprintf(out->name, sizeof out->name, "water-%u.bin", (unsigned)(hash % PLACES));
    out->file = (struct cache_file){.name = out->name,
                                    .what = "light in the water",
                                    .key = &out->key,
                                    .key_bytes = sizeof out->key,
                                    .data = (char *)table + INPUT_BYTES,
                                    .data_bytes = sizeof *table - INPUT_BYTES};
}

bool volume_cache_load(const trl_context *ctx, struct volume_table *table)
{
    struct entry entry;
    describe(table, &entry);
    return cache_file_load(ctx, &entry.file);
}

void volume_cache_store(const trl_context *ctx, struct volume_table *table)
{
    struct entry entry;
    describe(table, &entry);
    cache_file_store(ctx, &entry.file);
}
