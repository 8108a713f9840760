// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_FILE_H
#define BASE_FILE_H
// Files read whole within a bound, and written whole or not at all.

#include "base/context.h"

// Reads at most `max_bytes`; the data gets a terminating 0 that `size` does not count. Free with
// mem_free.
TRL_MUST_USE trl_result file_read(const trl_context *ctx, const char *path, size_t max_bytes,
                                  char **data, size_t *size);

// A file in the making: write to `temp_path` (beside the final one), then commit or abort.
struct file_replacement {
    char *path;
    char *temp_path;
};

// Names and creates the temporary file, so that an unwritable place is told before any work is
// done.
TRL_MUST_USE trl_result file_replacement_begin(const trl_context *ctx, const char *path,
                                               struct file_replacement *out);
// Flushes to disk and renames over the final path; the replacement is finished either way.
TRL_MUST_USE trl_result file_replacement_commit(const trl_context *ctx, struct file_replacement *r);
// Removes the temporary file. A finished or zeroed replacement is a no-op.
void file_replacement_abort(const trl_context *ctx, struct file_replacement *r);

// Writes `size` bytes to `path` whole or not at all.
TRL_MUST_USE trl_result file_write(const trl_context *ctx, const char *path, const void *data,
                                   size_t size);

// Makes a folder and the ones above it.
TRL_MUST_USE trl_result file_make_dirs(const trl_context *ctx, const char *path);

#endif // BASE_FILE_H
