// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "csv.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 16, COLUMNS_MAX = 256 };
static const size_t text_max = (size_t)256 << 20; // bytes of a file

// Reads a stream to its end; *out is owned by the caller and ends with a 0.
static enum exit_status read_stream(FILE *stream, const char *name, char **out, size_t *size)
{
    char *text = NULL;
    size_t length = 0;
    for (;;) {
        char *larger = realloc(text, length + CHUNK + 1);
        if (!larger || length > text_max) {
            free(larger ? larger : text);
            return report_error(EXIT_FAILED, "%s: %s", name,
                                larger ? "more than 256 MB" : "out of memory");
        }
        text = larger;
        const size_t got = fread(text + length, 1, CHUNK, stream);
        length += got;
        if (got < CHUNK) {
            break;
        }
    }
    if (ferror(stream)) {
        free(text);
        return report_error(EXIT_FAILED, "%s: cannot be read: %s", name, strerror(errno));
    }
    text[length] = '\0';
    *out = text;
    *size = length;
    return EXIT_OK;
}

static enum exit_status read_text(const char *path, struct csv_table *out)
{
    const bool is_standard = strcmp(path, "-") == 0;
    out->name = is_standard ? "(standard input)" : path;
    FILE *stream = is_standard ? stdin : fopen(path, "rb");
    if (!stream) {
        return report_error(EXIT_FAILED, "%s: cannot be read: %s", path, strerror(errno));
    }
    size_t size = 0;
    const enum exit_status status = read_stream(stream, out->name, &out->text, &size);
    if (!is_standard) {
        fclose(stream);
    }
    if (status == EXIT_OK && strlen(out->text) != size) {
        return report_error(EXIT_FAILED, "%s: is not a text file", out->name);
    }
    return status;
}

// Cuts blanks and quotes off both ends, in place.
static char *trim_field(char *field)
{
    field += strspn(field, " \t");
    size_t length = strlen(field);
    while (length && strchr(" \t\r", field[length - 1])) {
        field[--length] = '\0';
    }
    if (length >= 2 && field[0] == '"' && field[length - 1] == '"') {
        field[length - 1] = '\0';
        field++;
    }
    return field;
}

// Splits a line at its commas. Returns the number of fields, of which at most COLUMNS_MAX are
// stored.
static size_t split_line(char *line, const char *fields[COLUMNS_MAX])
{
    size_t count = 0;
    for (char *field = line; field;) {
        char *comma = strchr(field, ',');
        if (comma) {
            *comma = '\0';
        }
        const char *trimmed = trim_field(field);
        if (count < COLUMNS_MAX) {
            fields[count] = trimmed;
        }
        count++;
        field = comma ? comma + 1 : NULL;
    }
    return count;
}

static bool is_blank(const char *line)
{
    return line[strspn(line, " \t\r")] == '\0';
}

// Memory for as many rows as there are lines left.
static enum exit_status reserve_rows(struct csv_table *table, const char *rest)
{
    size_t lines = 1;
    for (const char *c = rest; c && *c; c++) {
        lines += *c == '\n';
    }
    table->fields = calloc(lines * table->column_count, sizeof *table->fields);
    table->lines = calloc(lines, sizeof *table->lines);
    return table->fields && table->lines
               ? EXIT_OK
               : report_error(EXIT_FAILED, "%s: out of memory", table->name);
}

static enum exit_status take_header(struct csv_table *table, char *line, const char *rest)
{
    const char *fields[COLUMNS_MAX];
    const size_t count = split_line(line, fields);
    if (count > COLUMNS_MAX) {
        return report_error(EXIT_FAILED, "%s:1: more than %d columns", table->name, COLUMNS_MAX);
    }
    table->header = calloc(count, sizeof *table->header);
    if (!table->header) {
        return report_error(EXIT_FAILED, "%s: out of memory", table->name);
    }
    memcpy(table->header, fields, count * sizeof *fields);
    table->column_count = count;
    return reserve_rows(table, rest);
}

static enum exit_status take_row(struct csv_table *table, char *line, size_t number)
{
    const char *fields[COLUMNS_MAX];
    const size_t count = split_line(line, fields);
    if (count != table->column_count) {
        return report_error(EXIT_FAILED, "%s:%zu: %zu fields where the header has %zu", table->name,
                            number, count, table->column_count);
    }
    memcpy(&table->fields[table->row_count * count], fields, count * sizeof *fields);
    table->lines[table->row_count++] = number;
    return EXIT_OK;
}

static enum exit_status split_text(struct csv_table *table)
{
    char *line = table->text;
    if (strncmp(line, "\xEF\xBB\xBF", 3) == 0) {
        line += 3; // the byte order mark that spreadsheets write
    }
    enum exit_status status = EXIT_OK;
    for (size_t number = 1; line && status == EXIT_OK; number++) {
        char *end = strchr(line, '\n');
        if (end) {
            *end = '\0';
        }
        char *rest = end ? end + 1 : NULL;
        if (!is_blank(line)) {
            status = table->header ? take_row(table, line, number) : take_header(table, line, rest);
        }
        line = rest;
    }
    if (status == EXIT_OK && !table->header) {
        return report_error(EXIT_FAILED, "%s:1: is empty; a header line is wanted", table->name);
    }
    return status;
}

enum exit_status csv_read(const char *path, struct csv_table *out)
{
    *out = (struct csv_table){0};
    enum exit_status status = read_text(path, out);
    if (status == EXIT_OK) {
        status = split_text(out);
    }
    if (status != EXIT_OK) {
        csv_finish(out);
    }
    return status;
}

enum exit_status csv_find_column(const struct csv_table *table, const char *name, size_t *out)
{
    size_t found = 0;
    for (size_t i = 0; i < table->column_count; i++) {
        if (strcmp(table->header[i], name) == 0) {
            *out = i;
            found++;
        }
    }
    if (found == 1) {
        return EXIT_OK;
    }
    return report_error(EXIT_FAILED, "%s:1: the column %s is %s", table->name, name,
                        found ? "there more than once" : "missing");
}

void csv_finish(struct csv_table *table)
{
    free(table->text);
    free(table->header);
    free(table->fields);
    free(table->lines);
    *table = (struct csv_table){0};
}
