// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "raster/remote.h"

#include "raster/gdal.h"

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

// A server that does not answer must not stop a viewer for minutes: 10 s to connect, 10 s in which
// less than 1 kB/s comes, a minute for one request. One more try each, since networks lose packets.
// Limits of the user's own (GDAL's names in the environment) count instead of these.
static const struct {
    const char *name, *value;
    bool is_limit;
} OPTIONS[] = {{"GDAL_DISABLE_READDIR_ON_OPEN", "EMPTY_DIR", false},
               {"GDAL_HTTP_CONNECTTIMEOUT", "10", true},
               {"GDAL_HTTP_LOW_SPEED_TIME", "10", true},
               {"GDAL_HTTP_LOW_SPEED_LIMIT", "1000", true},
               {"GDAL_HTTP_TIMEOUT", "60", true},
               {"GDAL_HTTP_MAX_RETRY", "1", true},
               {"GDAL_HTTP_RETRY_DELAY", "0.5", true},
               {"GDAL_INGESTED_BYTES_AT_OPEN", "32768", false},
               {"GDAL_PAM_ENABLED", "NO", false}};
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

void remote_begin(bool is_remote)
{
    gdal_close_network(!is_remote);
    for (int i = 0; is_remote && i < OPTION_COUNT; i++) {
        if (!OPTIONS[i].is_limit || !CPLGetConfigOption(OPTIONS[i].name, NULL)) {
            CPLSetThreadLocalConfigOption(OPTIONS[i].name, OPTIONS[i].value);
        }
    }
}

void remote_end(bool is_remote)
{
    gdal_close_network(true);
    for (int i = 0; is_remote && i < OPTION_COUNT; i++) {
        CPLSetThreadLocalConfigOption(OPTIONS[i].name, NULL);
    }
}
