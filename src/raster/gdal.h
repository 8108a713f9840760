// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_GDAL_H
#define RASTER_GDAL_H
// GDAL's messages, caught: it may print nothing, and what it said becomes part of our one line of
// error.

#include "base/context.h"

// Between begin and end, GDAL's messages on this thread go to `message` (the first failure) or,
// when they are only warnings, to the log at debug level; and GDAL's file systems of networks open
// nothing, except between remote_begin and remote_end.
struct gdal_catcher {
    const trl_context *ctx;
    char message[512];
    bool was_closed;
};

// `catcher` must stay where it is until the end.
void gdal_catch_begin(struct gdal_catcher *catcher, const trl_context *ctx);
void gdal_catch_end(struct gdal_catcher *catcher);

// Whether GDAL's file systems of networks open anything on this thread.
void gdal_close_network(bool is_closed);

// GDAL's message without the name of the file that it begins with, which our line has already.
const char *gdal_message_about(const struct gdal_catcher *catcher, const char *path);

// Registers GDAL's drivers, once a process. Threads: any.
void gdal_register(void);

#endif // RASTER_GDAL_H
