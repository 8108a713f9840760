// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_BENCH_TABLE_H
#define CLI_BENCH_TABLE_H
// What a bench measured: rows of samples, each beside the number that a paper prints for it, and
// notes below them.

#include "app.h"

#include "bench_machine.h"

enum {
    BENCH_MAX_ROWS = 1024,
    BENCH_MAX_RUNS = 1000,
    BENCH_NAME_MAX = 64,
    BENCH_MAX_NOTES = 16,
    BENCH_NOTE_MAX = 400
};

// One quantity of one case, measured some times.
struct bench_row {
    char case_name[BENCH_NAME_MAX];
    char metric[BENCH_NAME_MAX];
    const char *unit;
    bool has_paper;
    double paper;    // what the paper prints for it, in the same unit
    double *samples; // owned; BENCH_MAX_RUNS of them; none measured: the paper's number alone
    int runs;
};

struct bench_table {
    const char *name, *summary;
    const char *source; // the paper and where in it; NULL: a bench of our own
    struct bench_row rows[BENCH_MAX_ROWS];
    int row_count;
    int shown_count; // of the rows, how many were printed for people
    char notes[BENCH_MAX_NOTES][BENCH_NOTE_MAX];
    int note_count;
};

struct bench_sample {
    const char *case_name;
    const char *metric;
    const char *unit; // a literal
    double value;
};

// Adds a sample to the row of its case and metric, which appears in the order of first use.
// TRL_ERROR_MEMORY (reported) when there is no place for it.
trl_result bench_add(struct bench_table *table, struct bench_sample sample);

// What the paper prints for the row of that case and metric, which need not be measured.
trl_result bench_add_paper(struct bench_table *table, struct bench_sample printed);

// A line below the table: the paper's machine, what differs, what follows from the numbers.
__attribute__((format(printf, 2, 3))) void bench_note(struct bench_table *table, const char *format,
                                                      ...);

// Prints the rows for people that were not printed before, which must have all their samples;
// before the first of them, the head of the table.
void bench_table_print_rows(struct bench_table *table);

// The rows that are left, and the notes.
void bench_table_print(struct bench_table *table);

// The same as one JSON object on one line. EXIT_FAILED is reported.
enum exit_status bench_table_print_json(struct bench_table *table,
                                        const struct bench_machine *machine);

// Frees what the rows own.
void bench_table_finish(struct bench_table *table);

#endif // CLI_BENCH_TABLE_H
