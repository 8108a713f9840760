// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_OPTIONS_H
#define CLI_OPTIONS_H
// The options of a command as tables: what is accepted, where it goes, and the help that teaches
// it.

#include "numbers.h"

enum option_kind {
    OPTION_FLAG,
    OPTION_NUMBER,
    OPTION_LIST,
    OPTION_TEXT,
    OPTION_CHOICE, // one of a few words
    OPTION_SIZE    // WIDTHxHEIGHT
};

// A number that may have been given. `is_word`: the option's word stood in its place ("auto").
struct option_number {
    bool is_given, is_word;
    double value;
};

struct option {
    const char *name; // without the dashes
    char letter;      // short form; 0: none
    enum option_kind kind;
    union { // by kind; keeps its default when the option is not given
        bool *flag;
        struct option_number *number;
        struct number_list *list;
        const char **text; // points into argv
        int *choice;       // index in choices
        struct number_size *size;
    } target;
    const char *metavar;        // what stands for the value in the help, its unit where it has one
    const char *help;           // what it does, and the default
    struct number_range range;  // NUMBER and LIST
    bool is_whole;              // NUMBER: without a fraction
    const char *word;           // NUMBER: accepted in place of a number; NULL: none
    const char *const *choices; // CHOICE: ends with NULL
};

// Options under a heading of the help.
struct option_section {
    const char *heading;
    const struct option *options;
    size_t count;
};

struct option_spec {
    const char *command;    // "render"
    const char *positional; // how the arguments without dashes are written: "SCENE"; NULL: none
    size_t min_positionals, max_positionals;
    const char *about;    // paragraphs, each line at most 78 characters
    const char *examples; // lines
    const struct option_section *sections;
    size_t section_count;
};

enum { OPTIONS_MAX_POSITIONALS = 24 };

struct option_arguments {
    const char *positionals[OPTIONS_MAX_POSITIONALS];
    size_t count;
};

enum options_outcome {
    OPTIONS_READ, // go on
    OPTIONS_HELP, // the help was asked for and printed: end with EXIT_OK
    OPTIONS_WRONG // the mistake was reported: end with EXIT_USAGE
};

// Reads the words behind the command. A later option of the same name replaces an earlier one.
enum options_outcome options_read(const struct option_spec *spec, int argc, char **argv,
                                  struct option_arguments *out);

// Prints the help of the command on standard output.
void options_print_help(const struct option_spec *spec);

#endif // CLI_OPTIONS_H
