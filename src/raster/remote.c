// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/remote.h"

#include <cpl_conv.h>
#include <string.h>

// What users write, and what GDAL calls it.
static const struct {
    const char *prefix, *vsi;
    size_t dropped; // characters of the prefix that GDAL's name has not
} PREFIXES[] = {{"http://", "/vsicurl/", 0}, {"https://", "/vsicurl/", 0}, {"s3://", "/vsis3/", 5},
                {"gs://", "/vsigs/", 5},     {"/vsicurl/", "", 0},         {"/vsis3/", "", 0},
                {"/vsigs/", "", 0},          {"/vsiaz/", "", 0},           {"/vsioss/", "", 0},
                {"/vsiswift/", "", 0}};
enum { PREFIX_COUNT = sizeof PREFIXES / sizeof *PREFIXES };

// A server that does not answer must not stop a viewer for minutes: 10 s to connect, and 30 s in
// which less than 1 kB/s comes. One more try each, since networks lose packets.
static const char *const OPTIONS[][2] = {{"GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR"},
                                         {"GDAL_HTTP_CONNECTTIMEOUT", "10"},
                                         {"GDAL_HTTP_LOW_SPEED_TIME", "30"},
                                         {"GDAL_HTTP_LOW_SPEED_LIMIT", "1000"},
                                         {"GDAL_HTTP_MAX_RETRY", "1"},
                                         {"GDAL_HTTP_RETRY_DELAY", "1"},
                                         {"GDAL_INGESTED_BYTES_AT_OPEN", "32768"},
                                         {"GDAL_PAM_ENABLED", "NO"}};
enum { OPTION_COUNT = sizeof OPTIONS / sizeof *OPTIONS };

static int find_prefix(const char *path)
{
    for (int i = 0; i < PREFIX_COUNT; i++) {
        if (strncmp(path, PREFIXES[i].prefix, strlen(PREFIXES[i].prefix)) == 0) {
            return i;
        }
    }
    return -1;
}

bool remote_is_path(const char *path)
{
    return find_prefix(path) >= 0;
}

char *remote_vsi_path(const trl_context *ctx, const char *path)
{
    const int i = find_prefix(path);
    return i < 0 ? mem_strdup(ctx, path)
                 : mem_printf(ctx, "%s%s", PREFIXES[i].vsi, path + PREFIXES[i].dropped);
}

static void set_options(bool is_remote, bool is_on)
{
    for (int i = 0; is_remote && i < OPTION_COUNT; i++) {
        CPLSetThreadLocalConfigOption(OPTIONS[i][0], is_on ? OPTIONS[i][1] : NULL);
    }
}

void remote_begin(bool is_remote)
{
    set_options(is_remote, true);
}

void remote_end(bool is_remote)
{
    set_options(is_remote, false);
}
