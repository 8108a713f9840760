// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_CONTEXT_H
#define BASE_CONTEXT_H
// The context as the library's own modules see it: the one birth place of errors, memory that can
// fail, and progress.

#include <terrella/context.h>

struct trl_context {
    trl_context_desc desc; // allocator always filled in; strings owned by the context
    char *data_dir;
    char *cache_dir;
};

// Logs the message as an error and returns `code`. Every error of the library is born here.
__attribute__((format(printf, 4, 5))) trl_result
trl_fail(const trl_context *ctx, trl_result code, trl_log_item item, const char *format, ...);

// Logs one line that is not a failure.
__attribute__((format(printf, 4, 5))) void trl_log(const trl_context *ctx, trl_log_level level,
                                                   trl_log_item item, const char *format, ...);

// The same context, which logs nothing: for what is told in another way when it fails.
trl_context context_silenced(const trl_context *ctx);

// Tells the user how far a stage is. Returns TRL_OK, or TRL_ERROR_CANCELLED (logged) when asked to
// stop.
TRL_MUST_USE trl_result trl_progress(const trl_context *ctx, const char *stage, double fraction);

// `count` zeroed elements of `size` bytes, aligned to 64 bytes as vector code wants it.
// NULL (logged) when the product overflows or memory is out. A count of 0 gives a valid block.
void *mem_alloc(const trl_context *ctx, size_t count, size_t size);
void mem_free(const trl_context *ctx, void *block); // NULL is a no-op

// Copies of strings, owned by the caller, freed with mem_free. NULL (logged) when memory is out.
char *mem_strdup(const trl_context *ctx, const char *text);
__attribute__((format(printf, 2, 3))) char *mem_printf(const trl_context *ctx, const char *format,
                                                       ...);

#endif // BASE_CONTEXT_H
