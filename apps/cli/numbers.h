// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_NUMBERS_H
#define CLI_NUMBERS_H
// Numbers as people type them: decimal, finite, nothing behind them.

#include "report.h"
#include <terrella/renderer.h>

// Closed interval of what is accepted.
struct number_range {
    double min, max;
};

// One number of a list with the text that stands for it in output.
struct number_item {
    double value;
    char text[32];
};

// Numbers in the order in which they were asked for. Zeroed is empty.
struct number_list {
    struct number_item *items; // owned
    size_t count;
};

// Pixels.
struct number_size {
    uint32_t width, height;
};

enum {
    NUMBER_LIST_MAX = 1000000,               // items of a list
    NUMBER_SIZE_MAX = TRL_RENDERER_MAX_SIDE, // pixels of a side
    NUMBER_MESSAGE_MAX = 160
};

// Why a text was not accepted, to be put behind the name of the option or field: "'x' is not a
// number".
struct number_message {
    char text[NUMBER_MESSAGE_MAX];
};

// A decimal number ("-1.5e3"); no hexadecimal, no infinity, no NaN, no unit.
bool number_parse(const char *text, double *out, struct number_message *message);

// The same, within the range.
bool number_parse_in(const char *text, struct number_range range, double *out,
                     struct number_message *message);

// "WIDTHxHEIGHT", each from 1 to NUMBER_SIZE_MAX.
bool number_size_parse(const char *text, struct number_size *out, struct number_message *message);

// Numbers separated by commas; from:to:step stands for from, from + step, … not beyond to.
// Replaces what the list holds; on failure the list is empty.
bool number_list_parse(const char *text, struct number_range range, struct number_list *out,
                       struct number_message *message);

void number_list_finish(struct number_list *list);

#endif // CLI_NUMBERS_H
