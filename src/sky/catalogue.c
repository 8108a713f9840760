// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/catalogue.h"

#include "base/file.h"

#include <locale.h>
#include <stdlib.h>
#include <string.h>

enum { CATALOGUE_MAX_BYTES = 64 << 20, COLUMNS = 4 };

// What the columns may hold; a NaN is in no range.
static const double lowest[COLUMNS] = {-360, -90, -30, -5};
static const double highest[COLUMNS] = {360, 90, 30, 20};

// The file as it is being read. `c_locale` so that a program's decimal comma does not change what a
// file means.
struct reader {
    const trl_context *ctx;
    const char *path;
    char *text; // of the line and the rest, ends with a zero byte
    size_t line_number;
    locale_t c_locale;
    double limit_magnitude;
    struct catalogue *out;
};

static bool read_columns(const struct reader *reader, const char *line, double values[COLUMNS])
{
    const char *at = line;
    for (int i = 0; i < COLUMNS; i++) {
        char *end = NULL;
        values[i] = strtod_l(at, &end, reader->c_locale);
        if (end == at || !(values[i] >= lowest[i] && values[i] <= highest[i])) {
            return false;
        }
        at = end + strspn(end, " \t\r");
        if (i < COLUMNS - 1 && *at++ != ',') {
            return false;
        }
    }
    return *at == '\0';
}

static void add_star(struct reader *reader, const double values[COLUMNS])
{
    if (values[2] > reader->limit_magnitude) {
        return;
    }
    const double degree = M_PI / 180;
    reader->out->stars[reader->out->count++] = (struct catalogue_star){
        .direction = vec3_from_lat_lon(values[1] * degree, values[0] * degree),
        .magnitude = values[2],
        .colour_index = values[3]};
}

static trl_result read_line(struct reader *reader, bool *may_be_header)
{
    char *line = reader->text + strspn(reader->text, " \t\r");
    char *end = strchr(line, '\n');
    reader->text = end ? end + 1 : line + strlen(line);
    if (end) {
        *end = '\0';
    }
    reader->line_number++;
    if (*line == '#' || line[strspn(line, " \t\r")] == '\0') {
        return TRL_OK;
    }
    double values[COLUMNS];
    const bool is_header = *may_be_header && strchr("0123456789+-.", *line) == NULL;
    *may_be_header = false;
    if (is_header) {
        return TRL_OK;
    }
    if (!read_columns(reader, line, values)) {
        return trl_fail(reader->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE,
                        "%s:%zu: must be four numbers: right ascension and declination in degrees, "
                        "magnitude, colour index",
                        reader->path, reader->line_number);
    }
    add_star(reader, values);
    return TRL_OK;
}

static size_t count_lines(const char *text)
{
    size_t count = 1;
    for (; (text = strchr(text, '\n')); text++) {
        count++;
    }
    return count;
}

static trl_result read_lines(struct reader *reader)
{
    const size_t capacity = count_lines(reader->text);
    reader->out->stars = mem_alloc(reader->ctx, capacity, sizeof *reader->out->stars);
    trl_result result = reader->out->stars ? TRL_OK : TRL_ERROR_MEMORY;
    bool may_be_header = true;
    while (result == TRL_OK && *reader->text) {
        result = read_line(reader, &may_be_header);
    }
    return result;
}

trl_result catalogue_load(const trl_context *ctx, const char *path, double limit_magnitude,
                          struct catalogue *out)
{
    *out = (struct catalogue){0};
    char *text = NULL;
    size_t length = 0;
    trl_result result = file_read(ctx, path, CATALOGUE_MAX_BYTES, &text, &length);
    if (result != TRL_OK) {
        return result;
    }
    if (strlen(text) != length) {
        mem_free(ctx, text);
        return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE, "%s: holds a zero byte", path);
    }
    struct reader reader = {.ctx = ctx,
                            .path = path,
                            .text = text,
                            .c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0),
                            .limit_magnitude = limit_magnitude,
                            .out = out};
    result = reader.c_locale ? read_lines(&reader) : TRL_ERROR_MEMORY;
    if (reader.c_locale) {
        freelocale(reader.c_locale);
    }
    mem_free(ctx, text);
    if (result != TRL_OK) {
        catalogue_finish(ctx, out);
    }
    return result;
}

void catalogue_finish(const trl_context *ctx, struct catalogue *catalogue)
{
    mem_free(ctx, catalogue->stars);
    *catalogue = (struct catalogue){0};
}
