// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "bench_table.h"

#include <jansson.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NOTE_COLUMNS = 92 }; // of a note, behind its indent

// The row of that case and metric, made when it is new; NULL (reported) when there is no place.
static struct bench_row *find_row(struct bench_table *table, const struct bench_sample *sample)
{
    int i = 0;
    while (i < table->row_count && (strcmp(table->rows[i].case_name, sample->case_name) != 0 ||
                                    strcmp(table->rows[i].metric, sample->metric) != 0)) {
        i++;
    }
    if (i == BENCH_MAX_ROWS) {
        report_error(EXIT_FAILED, "bench: too many rows");
        return NULL;
    }
    struct bench_row *row = &table->rows[i];
    if (i < table->row_count) {
        return row;
    }
    *row = (struct bench_row){.unit = sample->unit,
                              .samples = calloc(BENCH_MAX_RUNS, sizeof *row->samples)};
    if (!row->samples) {
        report_error(EXIT_FAILED, "bench: out of memory");
        return NULL;
    }
    snprintf(row->case_name, sizeof row->case_name, "%s", sample->case_name);
    snprintf(row->metric, sizeof row->metric, "%s", sample->metric);
    table->row_count++;
    return row;
}

trl_result bench_add(struct bench_table *table, struct bench_sample sample)
{
    struct bench_row *row = find_row(table, &sample);
    if (row && row->runs == BENCH_MAX_RUNS) {
        report_error(EXIT_FAILED, "bench: too many runs");
        row = NULL;
    }
    if (!row) {
        return TRL_ERROR_MEMORY;
    }
    row->samples[row->runs++] = sample.value;
    return TRL_OK;
}

trl_result bench_add_paper(struct bench_table *table, struct bench_sample printed)
{
    struct bench_row *row = find_row(table, &printed);
    if (!row) {
        return TRL_ERROR_MEMORY;
    }
    row->has_paper = true;
    row->paper = printed.value;
    return TRL_OK;
}

void bench_note(struct bench_table *table, const char *format, ...)
{
    if (table->note_count == BENCH_MAX_NOTES) {
        return;
    }
    va_list args;
    va_start(args, format);
    vsnprintf(table->notes[table->note_count++], BENCH_NOTE_MAX, format, args);
    va_end(args);
}

static int compare_samples(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

// Sorts the samples; the median of an even number is between the two in the middle.
static double find_median(struct bench_row *row)
{
    qsort(row->samples, (size_t)row->runs, sizeof *row->samples, compare_samples);
    const int half = row->runs / 2;
    return row->runs % 2 ? row->samples[half] : 0.5 * (row->samples[half - 1] + row->samples[half]);
}

// Breaks at blanks.
static void print_note(const char *note)
{
    const char *indent = "  * ";
    while (*note) {
        size_t length = strlen(note);
        if (length > NOTE_COLUMNS) {
            length = NOTE_COLUMNS;
            while (length > 0 && note[length] != ' ') {
                length--;
            }
            length = length > 0 ? length : NOTE_COLUMNS;
        }
        printf("%s%.*s\n", indent, (int)length, note);
        note += length;
        note += strspn(note, " ");
        indent = "    ";
    }
}

static void print_row(struct bench_row *row, bool has_paper)
{
    char paper[32] = "";
    if (row->has_paper) {
        snprintf(paper, sizeof paper, "%.4g", row->paper);
    }
    printf("  %-28s %-24s", row->case_name, row->metric);
    if (has_paper) {
        printf(" %12s", paper);
    }
    if (row->runs > 0) {
        const double median = find_median(row);
        printf(" %12.4g %12.4g %-6s %4d\n", median, row->samples[0], row->unit, row->runs);
    } else {
        printf(" %12s %12s %-6s %4s\n", "", "", row->unit, "");
    }
}

static void print_head(const struct bench_table *table)
{
    printf("%s: %s\n", table->name, table->summary);
    if (table->source) {
        printf("  %s\n", table->source);
    }
    printf("  %-28s %-24s", "case", "metric");
    if (table->source) {
        printf(" %12s", "paper");
    }
    printf(" %12s %12s %-6s %4s\n", "median", "min", "unit", "runs");
}

void bench_table_print_rows(struct bench_table *table)
{
    if (table->shown_count == 0) {
        print_head(table);
    }
    for (; table->shown_count < table->row_count; table->shown_count++) {
        print_row(&table->rows[table->shown_count], table->source != NULL);
    }
    fflush(stdout);
}

void bench_table_print(struct bench_table *table)
{
    bench_table_print_rows(table);
    for (int i = 0; i < table->note_count; i++) {
        print_note(table->notes[i]);
    }
}

// json_pack answers NULL when memory is out, and takes NULL for it again.
static json_t *pack_row(struct bench_row *row)
{
    json_t *object = json_pack("{s:s, s:s, s:s}", "case", row->case_name, "metric", row->metric,
                               "unit", row->unit);
    if (row->runs > 0) {
        const double median = find_median(row);
        json_object_set_new(object, "median", json_real(median));
        json_object_set_new(object, "min", json_real(row->samples[0]));
    }
    json_object_set_new(object, "runs", json_integer(row->runs));
    if (row->has_paper) {
        json_object_set_new(object, "paper", json_real(row->paper));
    }
    return object;
}

enum exit_status bench_table_print_json(struct bench_table *table,
                                        const struct bench_machine *machine)
{
    json_t *rows = json_array();
    for (int i = 0; i < table->row_count; i++) {
        json_array_append_new(rows, pack_row(&table->rows[i]));
    }
    json_t *notes = json_array();
    for (int i = 0; i < table->note_count; i++) {
        json_array_append_new(notes, json_string(table->notes[i]));
    }
    json_t *object = json_pack("{s:s, s:s?, s:{s:s, s:i, s:f, s:s}, s:o, s:o}", "bench",
                               table->name, "source", table->source, "machine", "cpu", machine->cpu,
                               "cores", machine->cores, "load_average", machine->load_average,
                               "gl_renderer", machine->gl_renderer, "rows", rows, "notes", notes);
    char *text = object ? json_dumps(object, JSON_COMPACT | JSON_REAL_PRECISION(6)) : NULL;
    json_decref(object);
    if (!text) {
        return report_error(EXIT_FAILED, "bench: out of memory");
    }
    printf("%s\n", text);
    free(text);
    return EXIT_OK;
}

void bench_table_finish(struct bench_table *table)
{
    for (int i = 0; i < table->row_count; i++) {
        free(table->rows[i].samples);
    }
    *table = (struct bench_table){0};
}
