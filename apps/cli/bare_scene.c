// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "bare_scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_BYTES = 1 << 20 };

// The text of a file, to be freed; NULL is reported.
static char *read_text(const char *path, size_t *length)
{
    FILE *file = fopen(path, "rb");
    char *text = file ? malloc(MAX_BYTES) : NULL;
    *length = text ? fread(text, 1, MAX_BYTES, file) : 0;
    if (file) {
        fclose(file);
    }
    if (*length == 0) {
        report_error(EXIT_FAILED, "%s cannot be read", path);
        free(text);
        return NULL;
    }
    return text;
}

trl_result bare_scene_make(const struct app *app, const char *name, const char *keys,
                           trl_scene **out)
{
    *out = NULL;
    char *path = app_find_scene("bare-sphere.json");
    size_t length = 0;
    char *text = path ? read_text(path, &length) : NULL;
    char *all = text ? malloc(length + strlen(keys) + 2) : NULL;
    trl_result result = all ? TRL_OK : TRL_ERROR_IO;
    if (all) {
        const int head = sprintf(all, "{%s,", keys);
        const char *rest = memchr(text, '{', length);
        const size_t left = rest ? length - (size_t)(rest + 1 - text) : 0;
        memcpy(all + head, rest ? rest + 1 : "", left);
        result = trl_scene_parse(app->ctx, all, (size_t)head + left, name, ".", out);
    }
    free(all);
    free(text);
    free(path);
    return result;
}

trl_result bare_scene_make_cloudy(const struct app *app, double cover, trl_scene **out)
{
    char keys[64];
    snprintf(keys, sizeof keys, "\"clouds\": {\"layers\": [{\"cover\": %g}]}", cover);
    return bare_scene_make(app, "clouds", keys, out);
}
