// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/shader_source.h"
#include "base/file.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MAX_SHADER_BYTES = 1 << 20, MAX_DEPTH = 16, NAME_MAX_BYTES = 256 };

static trl_result append_bytes(struct shader_source *source, const char *bytes, size_t count)
{
    if (source->length + count + 1 > source->capacity) {
        const size_t capacity = 2 * (source->length + count + 1) + 4096;
        char *bigger = mem_alloc(source->ctx, capacity, 1);
        if (!bigger) {
            return TRL_ERROR_MEMORY;
        }
        if (source->text) {
            memcpy(bigger, source->text, source->length);
            mem_free(source->ctx, source->text);
        }
        source->text = bigger;
        source->capacity = capacity;
    }
    memcpy(source->text + source->length, bytes, count);
    source->length += count;
    source->text[source->length] = '\0';
    return TRL_OK;
}

__attribute__((format(printf, 2, 3))) static trl_result append_format(struct shader_source *source,
                                                                      const char *format, ...)
{
    char line[NAME_MAX_BYTES + 64];
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(line, sizeof line, format, args);
    va_end(args);
    if (length < 0 || (size_t)length >= sizeof line) {
        return trl_fail(source->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SHADER,
                        "a define is too long: %s", line);
    }
    return append_bytes(source, line, (size_t)length);
}

static const char *find_embedded(const char *name)
{
    for (const struct gpu_shader_file *file = gpu_shader_files; file->name; file++) {
        if (strcmp(file->name, name) == 0) {
            return file->text;
        }
    }
    return NULL;
}

// The text of a file; what is to be freed afterwards, if anything, is in *owned. TRL_SHADER_DIR
// goes before what is embedded, file by file, so that it may hold only what is being worked on.
static trl_result load_text(const trl_context *ctx, const char *name, const char **text,
                            char **owned)
{
    *owned = NULL;
    const char *dir = getenv("TRL_SHADER_DIR");
    if (!dir || !*dir) {
        *text = find_embedded(name);
        return TRL_OK;
    }
    char *path = mem_printf(ctx, "%s/%s", dir, name);
    if (!path) {
        return TRL_ERROR_MEMORY;
    }
    trl_result result = TRL_OK;
    if (access(path, F_OK) == 0) {
        size_t size = 0;
        result = file_read(ctx, path, MAX_SHADER_BYTES, owned, &size);
        *text = *owned;
    } else {
        *text = find_embedded(name);
    }
    mem_free(ctx, path);
    return result;
}

// Whether the line is `#include "name"`, and the name.
static bool parse_include(const char *line, size_t length, char name[NAME_MAX_BYTES])
{
    char copy[NAME_MAX_BYTES + 32];
    if (length >= sizeof copy) {
        return false;
    }
    memcpy(copy, line, length);
    copy[length] = '\0';
    return sscanf(copy, " # include \"%255[^\"]\"", name) == 1;
}

static bool is_included(const struct shader_source *source, const char *name)
{
    for (size_t i = 0; i < source->file_count; i++) {
        if (strcmp(source->files[i], name) == 0) {
            return true;
        }
    }
    return false;
}

struct include_site {
    const char *from; // file of the #include, NULL for the shader itself
    int line;
    int depth;
};

static trl_result expand_file(struct shader_source *source, const char *name,
                              struct include_site site);

static trl_result expand_line(struct shader_source *source, const char *line, size_t length,
                              size_t index_and_line[2], int depth)
{
    char included[NAME_MAX_BYTES];
    if (!parse_include(line, length, included)) {
        return append_bytes(source, line, length);
    }
    const struct include_site site = {source->files[index_and_line[0]], (int)index_and_line[1],
                                      depth + 1};
    const trl_result result = expand_file(source, included, site);
    return result != TRL_OK
               ? result
               : append_format(source, "#line %zu %zu\n", index_and_line[1] + 1, index_and_line[0]);
}

static trl_result expand_text(struct shader_source *source, const char *text, size_t index,
                              int depth)
{
    trl_result result = append_format(source, "#line 1 %zu\n", index);
    size_t line[2] = {index, 1};
    for (const char *at = text; result == TRL_OK && *at; line[1]++) {
        const char *end = strchr(at, '\n');
        const size_t length = end ? (size_t)(end - at) + 1 : strlen(at);
        result = expand_line(source, at, length, line, depth);
        at += length;
    }
    return result == TRL_OK ? append_bytes(source, "\n", 1) : result;
}

static trl_result expand_file(struct shader_source *source, const char *name,
                              struct include_site site)
{
    if (is_included(source, name)) {
        return TRL_OK;
    }
    const char *text = NULL;
    char *owned = NULL;
    trl_result result = load_text(source->ctx, name, &text, &owned);
    if (result != TRL_OK) {
        return result;
    }
    if (!text || source->file_count == SHADER_MAX_FILES || site.depth > MAX_DEPTH) {
        result = trl_fail(source->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SHADER,
                          "%s:%d: shader %s %s", site.from ? site.from : "program", site.line, name,
                          text ? "includes too much" : "does not exist");
    } else if (!(source->files[source->file_count] = mem_strdup(source->ctx, name))) {
        result = TRL_ERROR_MEMORY;
    } else {
        result = expand_text(source, text, source->file_count++, site.depth);
    }
    mem_free(source->ctx, owned);
    return result;
}

static trl_result append_head(struct shader_source *source, const struct shader_request *request)
{
    static const char precision[] = "precision highp float;\n"
                                    "precision highp int;\n"
                                    "precision highp sampler2D;\n"
                                    "precision highp sampler3D;\n"
                                    "precision highp sampler2DArray;\n"
                                    "precision highp isampler2D;\n"
                                    "precision highp isampler2DArray;\n";
    const struct shader_language *language = &request->language;
    trl_result result = append_format(source, "#version %d %s\n#define TRL_GLSL 1\n",
                                      language->version, language->is_es ? "es" : "core");
    if (result == TRL_OK && language->is_es) {
        result = append_bytes(source, precision, sizeof precision - 1);
    }
    if (result == TRL_OK) {
        result = append_format(source, "#define TRL_ES %d\n#define TRL_CLIP_CONTROL %d\n",
                               language->is_es, language->has_clip_control);
    }
    for (size_t i = 0; result == TRL_OK && i < request->define_count; i++) {
        result = append_format(source, "#define %s\n", request->defines[i]);
    }
    return result;
}

trl_result shader_source_init(const trl_context *ctx, const struct shader_request *request,
                              struct shader_source *out)
{
    *out = (struct shader_source){.ctx = ctx};
    trl_result result = append_head(out, request);
    if (result == TRL_OK) {
        result = expand_file(out, request->name, (struct include_site){0});
    }
    if (result != TRL_OK) {
        shader_source_finish(out);
    }
    return result;
}

void shader_source_finish(struct shader_source *source)
{
    if (!source->ctx) {
        return;
    }
    mem_free(source->ctx, source->text);
    for (size_t i = 0; i < source->file_count; i++) {
        mem_free(source->ctx, source->files[i]);
    }
    *source = (struct shader_source){0};
}

// Drivers write "0:12(5): error" (Mesa), "0(12) : error" (NVIDIA), "ERROR: 0:12: " (ANGLE, Apple).
// Returns how much of the line that is, or 0.
static size_t parse_place(const char *line, unsigned *file, unsigned *number)
{
    const size_t prefix = strncmp(line, "ERROR: ", 7) == 0     ? 7
                          : strncmp(line, "WARNING: ", 9) == 0 ? 9
                                                               : 0;
    int used = 0;
    if (!isdigit((unsigned char)line[prefix])) {
        return 0;
    }
    if (sscanf(line + prefix, "%u(%u)%n", file, number, &used) == 2 && used > 0) {
        return prefix + (size_t)used;
    }
    if (sscanf(line + prefix, "%u:%u%n", file, number, &used) == 2 && used > 0) {
        return prefix + (size_t)used;
    }
    return 0;
}

char *shader_source_explain(const struct shader_source *source, const char *driver_log)
{
    struct shader_source out = {.ctx = source->ctx};
    trl_result result = append_bytes(&out, "", 0);
    for (const char *at = driver_log; result == TRL_OK && *at;) {
        const size_t length = strcspn(at, "\n");
        unsigned file = 0, number = 0;
        size_t place = parse_place(at, &file, &number);
        place = place <= length && file < source->file_count ? place : 0;
        if (place > 0) {
            result = append_format(&out, "%s:%u", source->files[file], number);
        }
        if (result == TRL_OK) {
            result = append_bytes(&out, at + place, length - place + (at[length] == '\n'));
        }
        at += length + (at[length] == '\n');
    }
    // Messages of the log have no newline at their end.
    while (out.length > 0 && isspace((unsigned char)out.text[out.length - 1])) {
        out.text[--out.length] = '\0';
    }
    if (result != TRL_OK) {
        mem_free(out.ctx, out.text);
        return NULL;
    }
    return out.text;
}
