// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "base/context.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CONTEXT_CANARY = 0x54435831, ALIGNMENT = 64, MESSAGE_MAX = 2048, DEFAULT_RASTER_MB = 3000 };

static void *c_allocate(void *user, size_t bytes)
{
    (void)user;
    return calloc(1, bytes); // large blocks come zeroed from the system, untouched
}

static void *c_reallocate(void *user, void *block, size_t bytes)
{
    (void)user;
    return realloc(block, bytes);
}

static void c_release(void *user, void *block)
{
    (void)user;
    free(block);
}

trl_context_desc trl_context_desc_default(void)
{
    return (trl_context_desc){.canary = CONTEXT_CANARY, .raster_mb = DEFAULT_RASTER_MB};
}

// A folder that the user can choose.
struct dir_choice {
    const char *given;    // what the caller says, before all others
    const char *variable; // of the environment
    bool can_be_none;     // whether an empty variable means "no folder", else it counts as unset
    const char *below;    // name below terrella/ in the user's cache folder, where nobody says
};

static char *choose_dir(const trl_context *ctx, const struct dir_choice *choice)
{
    if (choice->given) {
        return mem_strdup(ctx, choice->given);
    }
    const char *named = getenv(choice->variable);
    if (named && (*named || choice->can_be_none)) {
        return mem_strdup(ctx, named);
    }
    const char *cache = getenv("XDG_CACHE_HOME");
    if (cache && *cache) {
        return mem_printf(ctx, "%s/terrella/%s", cache, choice->below);
    }
    const char *home = getenv("HOME");
    return mem_printf(ctx, "%s/.cache/terrella/%s", home && *home ? home : "/tmp", choice->below);
}

static bool is_whole(const trl_allocator *allocator)
{
    return allocator->allocate && allocator->reallocate && allocator->release;
}

static bool is_absent(const trl_allocator *allocator)
{
    return !allocator->allocate && !allocator->reallocate && !allocator->release;
}

trl_result trl_context_create(const trl_context_desc *desc, trl_context **out)
{
    if (!out) {
        return TRL_ERROR_INVALID;
    }
    *out = NULL;
    if (!desc || desc->canary != CONTEXT_CANARY || desc->raster_mb < TRL_CONTEXT_MIN_RASTER_MB ||
        !(is_whole(&desc->allocator) || is_absent(&desc->allocator))) {
        return TRL_ERROR_INVALID;
    }
    trl_context_desc filled = *desc;
    if (is_absent(&filled.allocator)) {
        filled.allocator = (trl_allocator){c_allocate, c_reallocate, c_release, NULL};
    }
    trl_context *ctx = filled.allocator.allocate(filled.allocator.user, sizeof *ctx);
    if (!ctx) {
        return TRL_ERROR_MEMORY;
    }
    *ctx = (trl_context){.desc = filled};
    ctx->data_dir =
        choose_dir(ctx, &(struct dir_choice){desc->data_dir, "TERRELLA_DATA", false, "data"});
    ctx->cache_dir =
        choose_dir(ctx, &(struct dir_choice){desc->cache_dir, "TERRELLA_CACHE", true, "tables"});
    if (!ctx->data_dir || !ctx->cache_dir) {
        trl_context_destroy(&ctx);
        return TRL_ERROR_MEMORY;
    }
    *out = ctx;
    return TRL_OK;
}

void trl_context_destroy(trl_context **ctx)
{
    if (!ctx || !*ctx) {
        return;
    }
    const trl_allocator allocator = (*ctx)->desc.allocator;
    mem_free(*ctx, (*ctx)->data_dir);
    mem_free(*ctx, (*ctx)->cache_dir);
    allocator.release(allocator.user, *ctx);
    *ctx = NULL;
}

const char *trl_context_data_dir(const trl_context *ctx)
{
    return ctx->data_dir;
}

const char *trl_context_cache_dir(const trl_context *ctx)
{
    return ctx->cache_dir;
}

static void log_va(const trl_context *ctx, trl_log_level level, trl_log_item item,
                   const char *format, va_list args)
{
    if (!ctx || !ctx->desc.log) {
        return;
    }
    char message[MESSAGE_MAX];
    vsnprintf(message, sizeof message, format, args);
    ctx->desc.log(ctx->desc.log_user, level, item, message);
}

trl_result trl_fail(const trl_context *ctx, trl_result code, trl_log_item item, const char *format,
                    ...)
{
    va_list args;
    va_start(args, format);
    log_va(ctx, TRL_LOG_ERROR, item, format, args);
    va_end(args);
    return code;
}

void trl_log(const trl_context *ctx, trl_log_level level, trl_log_item item, const char *format,
             ...)
{
    va_list args;
    va_start(args, format);
    log_va(ctx, level, item, format, args);
    va_end(args);
}

trl_context context_silenced(const trl_context *ctx)
{
    trl_context quiet = *ctx;
    quiet.desc.log = NULL;
    return quiet;
}

trl_result trl_progress(const trl_context *ctx, const char *stage, double fraction)
{
    if (!ctx->desc.progress || ctx->desc.progress(ctx->desc.progress_user, stage, fraction)) {
        return TRL_OK;
    }
    return trl_fail(ctx, TRL_ERROR_CANCELLED, TRL_LOG_ITEM_CANCELLED, "cancelled while %s", stage);
}

// The block that the allocator gave lies just before the aligned one that the caller sees.
void *mem_alloc(const trl_context *ctx, size_t count, size_t size)
{
    size_t bytes = 0;
    if (__builtin_mul_overflow(count, size, &bytes) || bytes > SIZE_MAX / 2) {
        (void)trl_fail(ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_MEMORY, "%zu x %zu bytes cannot be had",
                       count, size);
        return NULL;
    }
    char *raw = ctx->desc.allocator.allocate(ctx->desc.allocator.user, bytes + 2 * ALIGNMENT);
    if (!raw) {
        (void)trl_fail(ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_MEMORY, "out of memory (%zu bytes)",
                       bytes);
        return NULL;
    }
    char *block = raw + ALIGNMENT;
    block += (ALIGNMENT - (uintptr_t)block % ALIGNMENT) % ALIGNMENT;
    memcpy(block - sizeof raw, &raw, sizeof raw);
    if (ctx->desc.allocator.allocate != c_allocate) {
        memset(block, 0, bytes);
    }
    return block;
}

void mem_free(const trl_context *ctx, void *block)
{
    if (!block) {
        return;
    }
    char *raw = NULL;
    memcpy(&raw, (char *)block - sizeof raw, sizeof raw);
    ctx->desc.allocator.release(ctx->desc.allocator.user, raw);
}

char *mem_strdup(const trl_context *ctx, const char *text)
{
    const size_t bytes = strlen(text) + 1;
    char *copy = mem_alloc(ctx, bytes, 1);
    if (copy) {
        memcpy(copy, text, bytes);
    }
    return copy;
}

char *mem_printf(const trl_context *ctx, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    va_list again;
    va_copy(again, args);
    const int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    // A negative length is a format that the C library refuses; there is none in this tree.
    char *text = length < 0 ? NULL : mem_alloc(ctx, (size_t)length + 1, 1);
    if (text) {
        vsnprintf(text, (size_t)length + 1, format, again);
    }
    va_end(again);
    return text;
}

const char *trl_result_name(trl_result result)
{
    switch (result) {
    case TRL_OK:
        return "ok";
    case TRL_ERROR_INVALID:
        return "invalid";
    case TRL_ERROR_MEMORY:
        return "out of memory";
    case TRL_ERROR_IO:
        return "input/output error";
    case TRL_ERROR_GPU:
        return "graphics error";
    case TRL_ERROR_UNSUPPORTED:
        return "unsupported";
    case TRL_ERROR_CANCELLED:
        return "cancelled";
    }
    return "unknown result";
}

#define STRINGIFY_VALUE(value) #value
#define STRINGIFY(macro) STRINGIFY_VALUE(macro)

const char *trl_version(void)
{
    return STRINGIFY(TRL_VERSION_MAJOR) "." STRINGIFY(TRL_VERSION_MINOR) "." STRINGIFY(
        TRL_VERSION_PATCH);
}

void trl_log_stderr(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    (void)user;
    (void)item;
    if (level <= TRL_LOG_WARN) {
        fprintf(stderr, "terrella: %s: %s\n", level == TRL_LOG_ERROR ? "error" : "warning",
                message);
    }
}
