// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/gdal.h"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

static void catch_message(CPLErr kind, CPLErrorNum number, const char *text)
{
    (void)number;
    struct gdal_catcher *catcher = CPLGetErrorHandlerUserData();
    if (kind < CE_Failure) {
        trl_log(catcher->ctx, TRL_LOG_DEBUG, TRL_LOG_ITEM_RASTER, "GDAL: %s", text);
    } else if (!catcher->message[0]) {
        snprintf(catcher->message, sizeof catcher->message, "%s", text);
        // One line: what comes after the first is GDAL's advice, which names its own options.
        for (char *at = catcher->message; *at; at++) {
            if (*at == '\n') {
                *at = '\0';
                break;
            }
        }
    }
}

// The only file that may be opened; this is none.
static const char ALLOWED_FILE[] = "CPL_VSIL_CURL_ALLOWED_FILENAME";

void gdal_close_network(bool is_closed)
{
    CPLSetThreadLocalConfigOption(ALLOWED_FILE, is_closed ? "none" : NULL);
}

void gdal_catch_begin(struct gdal_catcher *catcher, const trl_context *ctx)
{
    *catcher = (struct gdal_catcher){
        .ctx = ctx, .was_closed = CPLGetThreadLocalConfigOption(ALLOWED_FILE, NULL) != NULL};
    gdal_close_network(true);
    CPLErrorReset();
    CPLPushErrorHandlerEx(catch_message, catcher);
}

void gdal_catch_end(struct gdal_catcher *catcher)
{
    gdal_close_network(catcher->was_closed);
    CPLPopErrorHandler();
}

const char *gdal_message_about(const struct gdal_catcher *catcher, const char *path)
{
    const char *text = catcher->message;
    const char *name = strstr(text, path);
    // "`path' not recognized…", "/vsicurl/path: …", or in the middle, where it stays.
    if (name && name - text <= 12) {
        text = name + strlen(path);
        text += strspn(text, "':, ");
    }
    return text;
}

void gdal_register(void)
{
    // GDAL's list of drivers is one a process, and so is this.
    static pthread_once_t once = PTHREAD_ONCE_INIT;
    pthread_once(&once, GDALAllRegister);
}
