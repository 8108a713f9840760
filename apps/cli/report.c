// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "report.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { MESSAGE_MAX = 2048, WORD_MAX = 32 };

enum exit_status report_error(enum exit_status status, const char *format, ...)
{
    char message[MESSAGE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(message, sizeof message, format, args);
    va_end(args);
    // What was typed may hold line breaks; the message must stay one line.
    for (char *c = message; *c; c++) {
        if ((unsigned char)*c < ' ') {
            *c = '?';
        }
    }
    fprintf(stderr, "terrella: error: %s\n", message);
    return status;
}

enum exit_status report_result(trl_result result)
{
    return result == TRL_OK ? EXIT_OK : EXIT_FAILED;
}

static size_t min_size(size_t a, size_t b)
{
    return a < b ? a : b;
}

// Number of insertions, deletions and substitutions between two words (Levenshtein), row by row.
static size_t edit_distance(const char *a, const char *b)
{
    const size_t a_length = strlen(a);
    const size_t b_length = strlen(b);
    if (a_length > WORD_MAX || b_length > WORD_MAX) {
        return SIZE_MAX;
    }
    size_t row[WORD_MAX + 1];
    for (size_t j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t above = row[j];
            const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            row[j] = min_size(replaced, min_size(above, row[j - 1]) + 1);
            diagonal = above;
        }
    }
    return row[b_length];
}

const char *report_nearest(const char *word, const char *const *names, size_t count)
{
    // A third of the word may be wrong, and at least two letters: more would be guessing.
    size_t best = strlen(word) / 3 < 2 ? 3 : strlen(word) / 3 + 1;
    const char *nearest = NULL;
    for (size_t i = 0; i < count; i++) {
        const size_t distance = edit_distance(word, names[i]);
        if (distance < best && distance < strlen(names[i])) {
            best = distance;
            nearest = names[i];
        }
    }
    return nearest;
}
