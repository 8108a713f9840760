// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TRL_CONTEXT_H
#define TRL_CONTEXT_H

#include <terrella/base.h>

TRL_BEGIN

/// Where everything hangs: log, memory, progress, folders. There is no global state.
/// Owner: caller. Lifetime: destroy after everything made from it. Threads: calls on objects of one
/// context must not overlap unless a function says so; different contexts are independent.
typedef struct trl_context trl_context;

typedef enum trl_log_level {
    TRL_LOG_ERROR = 0,
    TRL_LOG_WARN = 1,
    TRL_LOG_INFO = 2,
    TRL_LOG_DEBUG = 3
} trl_log_level;

/// Stable numbers for what is logged, so that programs and tests need not compare texts.
#define TRL_LOG_ITEMS(X)                                                                           \
    X(GENERAL, 0, "general")                                                                       \
    X(ARGUMENT, 1, "argument")                                                                     \
    X(MEMORY, 2, "memory")                                                                         \
    X(FILE_READ, 10, "file cannot be read")                                                        \
    X(FILE_WRITE, 11, "file cannot be written")                                                    \
    X(CACHE, 12, "cache")                                                                          \
    X(SCENE, 20, "scene")                                                                          \
    X(SOLVER, 30, "solver")                                                                        \
    X(RASTER, 40, "raster")                                                                        \
    X(GPU_CONTEXT, 50, "GL context")                                                               \
    X(GPU_OBJECT, 51, "GL object")                                                                 \
    X(SHADER, 52, "shader")                                                                        \
    X(IMAGE, 60, "image")                                                                          \
    X(CANCELLED, 70, "cancelled")

typedef enum trl_log_item {
#define TRL_LOG_ITEM_ENUM(name, number, text) TRL_LOG_ITEM_##name = (number),
    TRL_LOG_ITEMS(TRL_LOG_ITEM_ENUM)
#undef TRL_LOG_ITEM_ENUM
} trl_log_item;

/// Receives one line of log, without a newline. May be called from worker threads of a blocking
/// call.
typedef void (*trl_log_fn)(void *user, trl_log_level level, trl_log_item item, const char *message);

/// Told how far a long call is. `stage` says what is done ("solving the atmosphere"), `fraction` is
/// in [0, 1] of that stage. Called on the thread of the blocking call. Return false to cancel the
/// call, which then returns TRL_ERROR_CANCELLED.
typedef bool (*trl_progress_fn)(void *user, const char *stage, double fraction);

/// Memory functions with the meaning of the C ones; all three or none. `user` is the desc's.
/// Threads: called from several at once during a blocking call (solving an atmosphere), so they
/// must be safe for that, as malloc is.
typedef struct trl_allocator {
    void *(*allocate)(void *user, size_t bytes); ///< as malloc
    void *(*reallocate)(void *user, void *block, size_t bytes);
    void (*release)(void *user, void *block);
    void *user;
} trl_allocator;

enum { TRL_CONTEXT_MIN_RASTER_MB = 64 }; ///< of trl_context_desc.raster_mb

typedef struct trl_context_desc {
    uint32_t canary;          ///< set by trl_context_desc_default(); never touch
    trl_log_fn log;           ///< NULL: silent
    void *log_user;           ///< passed to log
    trl_progress_fn progress; ///< NULL: nobody is told
    void *progress_user;      ///< passed to progress
    trl_allocator allocator;  ///< all NULL: the C library's
    /// Where rasters named by scenes are. NULL: $TERRELLA_DATA; without it, or where it is empty,
    /// terrella/data below $XDG_CACHE_HOME or ~/.cache.
    const char *data_dir;
    /// Where solved tables are kept; "": nowhere. NULL: $TERRELLA_CACHE (empty: nowhere); without
    /// it terrella/tables below $XDG_CACHE_HOME or ~/.cache.
    const char *cache_dir;
    /// Whether scenes may name rasters behind a network ("https://…", "s3://…"); they are read in
    /// parts as far as views need them. Default false: such a scene is refused.
    bool allows_remote;
    /// What rasters of a renderer or of a traced picture may take, in MB, at least
    /// TRL_CONTEXT_MIN_RASTER_MB; default 3000. Rasters that need more together are held in tiles,
    /// of which views load those that they show.
    uint32_t raster_mb;
} trl_context_desc;

/// A desc with every default set. Threads: any.
TRL_API trl_context_desc trl_context_desc_default(void);

/// Makes a context. The desc's strings are copied.
/// @return TRL_OK; TRL_ERROR_INVALID (desc not from the default function, an allocator without all
/// of its functions, too little memory for rasters); TRL_ERROR_MEMORY
TRL_API TRL_MUST_USE trl_result trl_context_create(const trl_context_desc *desc, trl_context **out);

/// Frees *ctx and sets it to NULL.
TRL_API void trl_context_destroy(trl_context **ctx);

/// The folder of rasters; owned by the context. Threads: any.
TRL_API const char *trl_context_data_dir(const trl_context *ctx);

/// The folder of solved tables; owned by the context; "" when nothing is kept. Threads: any.
TRL_API const char *trl_context_cache_dir(const trl_context *ctx);

/// A log callback that prints "terrella: error: …" to standard error, errors and warnings only.
TRL_API void trl_log_stderr(void *user, trl_log_level level, trl_log_item item,
                            const char *message);

TRL_END
#endif // TRL_CONTEXT_H
