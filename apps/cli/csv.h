// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_CSV_H
#define CLI_CSV_H
// A table of text: a header line and rows of as many fields. Mistakes are reported with file and
// line.

#include "report.h"

// Owner: whoever read it. All strings point into `text`.
struct csv_table {
    const char *name; // of the file, for messages
    char *text;       // owned
    size_t column_count, row_count;
    const char **header; // owned; column_count names
    const char **fields; // owned; row_count x column_count
    size_t *lines;       // owned; line in the file of each row, from 1
};

// Reads a file, or standard input for "-". Lines end with LF or CRLF, blank lines are skipped, a
// field may stand in double quotes (without quotes or commas inside), blanks around fields are
// dropped. On failure the table is empty and the mistake is reported.
enum exit_status csv_read(const char *path, struct csv_table *out);

// The column of that name. EXIT_FAILED (reported) when it is missing or there twice.
enum exit_status csv_find_column(const struct csv_table *table, const char *name, size_t *out);

static inline const char *csv_field(const struct csv_table *table, size_t row, size_t column)
{
    return table->fields[row * table->column_count + column];
}

void csv_finish(struct csv_table *table);

#endif // CLI_CSV_H
