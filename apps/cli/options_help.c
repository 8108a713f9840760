// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The help of a command, from the same tables that read its options.
#include "options.h"

#include <stdio.h>
#include <string.h>

enum { LINE_WIDTH = 80, HELP_COLUMN = 28, LABEL_MAX = 80 };

// Prints words from the current column on, further lines indented to `indent`.
static void print_wrapped(const char *text, int column, int indent)
{
    const char *gap = "";
    while (*text) {
        const int length = (int)strcspn(text, " ");
        if (column + (int)strlen(gap) + length > LINE_WIDTH) {
            printf("\n%*s", indent, "");
            column = indent;
            gap = "";
        }
        column += printf("%s%.*s", gap, length, text);
        text += length;
        text += strspn(text, " ");
        gap = " ";
    }
    printf("\n");
}

static void print_entry(const char *label, const char *help)
{
    printf("%s", label);
    const int length = (int)strlen(label);
    if (length + 2 > HELP_COLUMN) {
        printf("\n%*s", HELP_COLUMN, "");
    } else {
        printf("%*s", HELP_COLUMN - length, "");
    }
    print_wrapped(help, HELP_COLUMN, HELP_COLUMN);
}

static void print_option(const struct option *option)
{
    char label[LABEL_MAX];
    const char letter[] = {'-', option->letter, ',', ' ', '\0'};
    snprintf(label, sizeof label, "  %s--%s%s%s", option->letter ? letter : "    ", option->name,
             option->metavar ? " " : "", option->metavar ? option->metavar : "");
    print_entry(label, option->help);
}

void options_print_help(const struct option_spec *spec)
{
    printf("Usage: terrella %s%s%s [options]\n\n%s", spec->command, spec->positional ? " " : "",
           spec->positional ? spec->positional : "", spec->about);
    for (size_t s = 0; s < spec->section_count; s++) {
        printf("\n%s:\n", spec->sections[s].heading);
        for (size_t i = 0; i < spec->sections[s].count; i++) {
            print_option(&spec->sections[s].options[i]);
        }
    }
    printf("\n");
    print_entry("  -h, --help", "Print this.");
    printf("\nExamples:\n%s", spec->examples);
}
