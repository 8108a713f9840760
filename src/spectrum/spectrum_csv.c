// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "spectrum/spectrum_csv.h"

#include <locale.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { KNOTS_MAX = 100000, LINE_MAX_BYTES = 256 };

// The file as it is being read. `c_locale` so that a program's decimal comma does not change what a
// file means.
struct csv {
    const trl_context *ctx;
    const char *name;
    const char *text, *end;
    size_t line_number;
    char line[LINE_MAX_BYTES]; // the current one without comment and spaces at its ends
    locale_t c_locale;
    double *nm, *value;
    size_t count, capacity;
};

static trl_result fail_line(const struct csv *csv, const char *what)
{
    return trl_fail(csv->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE, "%s:%zu: %s", csv->name,
                    csv->line_number, what);
}

static bool is_space(char c)
{
    return c == ' ' || c == '\t' || c == '\r';
}

// Copies the next line to csv->line.
static trl_result take_line(struct csv *csv)
{
    const size_t left = (size_t)(csv->end - csv->text);
    const char *newline = memchr(csv->text, '\n', left);
    const char *start = csv->text;
    const char *stop = newline ? newline : csv->end;
    csv->text = newline ? newline + 1 : csv->end;
    csv->line_number++;
    const char *comment = memchr(start, '#', (size_t)(stop - start));
    stop = comment ? comment : stop;
    while (start < stop && is_space(*start)) {
        start++;
    }
    while (start < stop && is_space(stop[-1])) {
        stop--;
    }
    const size_t length = (size_t)(stop - start);
    if (length >= sizeof csv->line) {
        return fail_line(csv, "longer than 255 characters");
    }
    memcpy(csv->line, start, length);
    csv->line[length] = '\0';
    return strlen(csv->line) == length ? TRL_OK : fail_line(csv, "holds a zero byte");
}

// Only digits, signs, points and exponents: strtod would also take hexadecimal, infinities and NaN.
static bool read_number(const struct csv *csv, const char **at, double *out)
{
    const char *start = *at + strspn(*at, " \t");
    const size_t length = strspn(start, "0123456789+-.eE");
    char *end = NULL;
    *out = strtod_l(start, &end, csv->c_locale);
    *at = end + strspn(end, " \t");
    return length > 0 && end == start + length && isfinite(*out);
}

static bool looks_like_number(const char *line)
{
    return strchr("0123456789+-.", line[0]) != NULL;
}

static trl_result read_line(struct csv *csv)
{
    const char *at = csv->line;
    double nm = 0;
    double value = 0;
    bool is_pair = read_number(csv, &at, &nm) && *at == ',';
    if (is_pair) {
        at++;
        is_pair = read_number(csv, &at, &value) && *at == '\0';
    }
    if (!is_pair) {
        return fail_line(csv, "must be two finite numbers: nm,value");
    }
    if (!(nm > 0)) {
        return fail_line(csv, "the wavelength must be > 0");
    }
    if (csv->count > 0 && !(nm > csv->nm[csv->count - 1])) {
        return fail_line(csv, "wavelengths must ascend");
    }
    if (csv->count == csv->capacity) {
        return fail_line(csv, "more than 100000 lines");
    }
    csv->nm[csv->count] = nm;
    csv->value[csv->count] = value;
    csv->count++;
    return TRL_OK;
}

static trl_result read_lines(struct csv *csv)
{
    bool may_be_header = true;
    while (csv->text < csv->end) {
        trl_result result = take_line(csv);
        if (result == TRL_OK && csv->line[0] != '\0') {
            if (!may_be_header || looks_like_number(csv->line)) {
                result = read_line(csv);
            }
            may_be_header = false;
        }
        if (result != TRL_OK) {
            return result;
        }
    }
    return csv->count > 0 ? TRL_OK : fail_line(csv, "holds no numbers");
}

static size_t count_lines(const char *text, size_t length)
{
    size_t count = 1;
    for (size_t i = 0; i < length; i++) {
        count += text[i] == '\n';
    }
    return count < KNOTS_MAX ? count : KNOTS_MAX;
}

// Some editors put a byte-order mark before the text.
static size_t measure_mark(const char *text, size_t length)
{
    return length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
}

trl_result spectrum_csv_parse(const trl_context *ctx, const char *text, size_t length,
                              const char *name, struct spectrum *out)
{
    *out = (struct spectrum){0};
    const size_t mark = measure_mark(text, length);
    struct csv csv = {.ctx = ctx, .name = name, .text = text + mark, .end = text + length};
    trl_result result = TRL_ERROR_MEMORY;
    csv.capacity = count_lines(text, length);
    csv.nm = mem_alloc(ctx, csv.capacity, 2 * sizeof *csv.nm);
    csv.c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (csv.nm && csv.c_locale) {
        csv.value = csv.nm + csv.capacity;
        result = read_lines(&csv);
    }
    if (result == TRL_OK) {
        result = spectrum_table_init(ctx, csv.nm, csv.value, csv.count, out);
    }
    if (csv.c_locale) {
        freelocale(csv.c_locale);
    }
    mem_free(ctx, csv.nm);
    return result;
}
