// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_QUERY_LISTS_H
#define CLI_QUERY_LISTS_H
// Queries as every combination of lists of numbers, one list for each part of a query, and as the
// first columns of a table of answers.

#include "options.h"
#include <stdio.h>

enum { QUERY_MAX_PARTS = 8 };

struct query_part {
    const char *column; // of the table
    const char *option;
    const char *metavar;
    struct number_range range;
    const struct number_item
        *fallback; // what stands for a list that is not given; NULL: it must be
    const char *help;
};

struct query_lists {
    const char *command;
    const struct query_part *parts; // in the order of the columns
    size_t part_count;
    size_t max_count;        // of queries
    const char *alternative; // what may stand instead of the lists: " (or --queries)"; or ""
    struct number_list lists[QUERY_MAX_PARTS];
};

// One for each part.
void query_lists_make_options(struct query_lists *lists, struct option *out);
void query_lists_finish(struct query_lists *lists);

// How many queries there are, or one more than are allowed. EXIT_USAGE: a list is missing, which
// was reported.
enum exit_status query_lists_count(const struct query_lists *lists, size_t *count);

// The numbers of a query, the last part running fastest, and each as it was given. The texts live
// as long as the lists.
void query_lists_get(const struct query_lists *lists, size_t index, double *values,
                     const char **texts);

// The parts' columns and a query's texts, a comma behind each.
void query_lists_print_columns(const struct query_lists *lists, FILE *stream);
void query_lists_print_texts(const struct query_lists *lists, const char *const *texts,
                             FILE *stream);

#endif // CLI_QUERY_LISTS_H
