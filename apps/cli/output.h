// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_OUTPUT_H
#define CLI_OUTPUT_H
// Where results go: checked before the work, whole or not at all after it.

#include "report.h"

#include <stdio.h>

// Fails (reported, EXIT_FAILED) when a file of that name could not be made or replaced. Leaves
// nothing.
enum exit_status output_check_writable(const char *path);

// The letters behind the last dot of the file's name, or "".
const char *output_suffix(const char *path);

// Text being written: to standard output, or beside its final place until it is complete.
struct output_text {
    const char *path; // NULL: standard output
    char *temp_path;  // owned
    FILE *stream;
};

enum exit_status output_text_begin(const char *path, struct output_text *out);
// Finishes it; EXIT_FAILED (reported) when something could not be written, and then no file is
// left.
enum exit_status output_text_commit(struct output_text *text);
// Drops what was written to a file. A finished or zeroed one is a no-op.
void output_text_abort(struct output_text *text);

#endif // CLI_OUTPUT_H
