// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <string.h>
#include <sys/stat.h>

#include "raster/remote.h"
#include "scene/read.h"

bool scene_path_exists(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

// A scene from a stranger must not make GDAL fetch or unpack anything: its virtual file systems
// begin with /vsi, its drivers' own names and URLs have a colon.
static bool is_plain_path(const char *path)
{
    if (strncmp(path, "/vsi", 4) == 0) {
        return false;
    }
    for (const char *c = path; *c; c++) {
        if (*c == ':' || *c == '\\' || (unsigned char)*c < 0x20) {
            return false;
        }
    }
    return true;
}

// Never a path that begins with /vsi: an empty folder is the current one.
static char *join(const trl_context *ctx, const char *folder, const char *file)
{
    return mem_printf(ctx, "%s/%s", *folder ? folder : ".", file);
}

trl_result scene_read_path(const struct scene_node *node, char **out)
{
    *out = NULL;
    const char *file = NULL;
    const trl_result result = scene_node_string(node, &file);
    if (result != TRL_OK) {
        return result;
    }
    if (!is_plain_path(file)) {
        return scene_node_fail(node,
                               "is \"%.64s\"; must be the path of a file, without \":\", \"\\\" or "
                               "/vsi at its start",
                               file);
    }
    const trl_context *ctx = node->doc->ctx;
    if (file[0] == '/') {
        *out = mem_strdup(ctx, file);
        return *out ? TRL_OK : TRL_ERROR_MEMORY;
    }
    *out = join(ctx, node->doc->base_dir, file);
    if (*out && !scene_path_exists(*out)) {
        mem_free(ctx, *out);
        *out = join(ctx, trl_context_data_dir(ctx), file);
    }
    return *out ? TRL_OK : TRL_ERROR_MEMORY;
}

trl_result scene_read_raster_path(const struct scene_node *node, char **out)
{
    *out = NULL;
    const trl_context *ctx = node->doc->ctx;
    const char *file = NULL;
    const trl_result result = scene_node_string(node, &file);
    if (result != TRL_OK || !remote_is_path(file)) {
        return result == TRL_OK ? scene_read_path(node, out) : result;
    }
    if (!ctx->desc.allows_remote) {
        return scene_node_fail(node,
                               "is \"%.64s\", which is read over a network; that is done only "
                               "where it is allowed (--allow-remote)",
                               file);
    }
    *out = mem_strdup(ctx, file);
    return *out ? TRL_OK : TRL_ERROR_MEMORY;
}
