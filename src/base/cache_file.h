// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_CACHE_FILE_H
#define BASE_CACHE_FILE_H
// Numbers of a fixed size that take long to make, kept from one start to the next in the context's
// cache folder; without such a folder nothing is. The file holds the key, a checksum, the numbers.

#include "base/context.h"

struct cache_file {
    const char *name; // in the folder
    const char *what; // for the log
    const void *key;  // what the numbers follow from, a version of their maker included
    size_t key_bytes;
    void *data;
    size_t data_bytes;
};

// Whether the file had that key and was whole; else the data stay.
bool cache_file_load(const trl_context *ctx, const struct cache_file *file);

// A failure is a warning.
void cache_file_store(const trl_context *ctx, const struct cache_file *file);

#endif // BASE_CACHE_FILE_H
