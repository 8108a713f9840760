// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "options.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAMES_MAX = 64 };

// One word list being read.
struct reader {
    const struct option_spec *spec;
    int argc;
    char **argv;
    int next; // index of the word to read
};

static const struct option *find_by_name(const struct option_spec *spec, const char *name,
                                         size_t length)
{
    for (size_t s = 0; s < spec->section_count; s++) {
        for (size_t i = 0; i < spec->sections[s].count; i++) {
            const struct option *option = &spec->sections[s].options[i];
            if (strlen(option->name) == length && memcmp(option->name, name, length) == 0) {
                return option;
            }
        }
    }
    return NULL;
}

static const struct option *find_by_letter(const struct option_spec *spec, char letter)
{
    for (size_t s = 0; s < spec->section_count; s++) {
        for (size_t i = 0; i < spec->sections[s].count; i++) {
            if (letter && spec->sections[s].options[i].letter == letter) {
                return &spec->sections[s].options[i];
            }
        }
    }
    return NULL;
}

static enum options_outcome report_unknown(const struct option_spec *spec, const char *word)
{
    const char *names[NAMES_MAX] = {"help"};
    size_t count = 1;
    for (size_t s = 0; s < spec->section_count; s++) {
        for (size_t i = 0; i < spec->sections[s].count && count < NAMES_MAX; i++) {
            names[count++] = spec->sections[s].options[i].name;
        }
    }
    char bare[64];
    snprintf(bare, sizeof bare, "%s", word + strspn(word, "-"));
    bare[strcspn(bare, "=")] = '\0';
    const char *nearest = report_nearest(bare, names, count);
    report_error(EXIT_USAGE, "%s: unknown option '%.60s'%s%s%s", spec->command, word,
                 nearest ? "; did you mean --" : "; see terrella ",
                 nearest ? nearest : spec->command, nearest ? "?" : " --help");
    return OPTIONS_WRONG;
}

static bool store_choice(const struct option *option, const char *value,
                         struct number_message *message)
{
    size_t length = 0;
    length += (size_t)snprintf(message->text, sizeof message->text, "'%.40s' is not one of", value);
    for (int i = 0; option->choices[i]; i++) {
        if (strcmp(option->choices[i], value) == 0) {
            *option->target.choice = i;
            return true;
        }
        if (length < sizeof message->text) {
            length += (size_t)snprintf(message->text + length, sizeof message->text - length,
                                       "%s %s", i ? "," : "", option->choices[i]);
        }
    }
    return false;
}

static bool store_number(const struct option *option, const char *value,
                         struct number_message *message)
{
    struct option_number read = {.is_given = true};
    read.is_word = option->word && strcmp(option->word, value) == 0;
    if (!read.is_word && !number_parse_in(value, option->range, &read.value, message)) {
        return false;
    }
    if (option->is_whole && read.value != floor(read.value)) {
        snprintf(message->text, sizeof message->text, "'%.40s' is not a whole number", value);
        return false;
    }
    *option->target.number = read;
    return true;
}

static bool store_value(const struct option *option, const char *value,
                        struct number_message *message)
{
    switch (option->kind) {
    case OPTION_FLAG:
        *option->target.flag = true;
        return true;
    case OPTION_NUMBER:
        return store_number(option, value, message);
    case OPTION_LIST:
        return number_list_parse(value, option->range, option->target.list, message);
    case OPTION_TEXT:
        snprintf(message->text, sizeof message->text, "the value is empty");
        *option->target.text = value;
        return *value != '\0';
    case OPTION_CHOICE:
        return store_choice(option, value, message);
    case OPTION_SIZE:
        return number_size_parse(value, option->target.size, message);
    }
    return false;
}

// `attached` is the value written in the same word, or NULL: then the next word is the value.
static enum options_outcome read_value(struct reader *reader, const struct option *option,
                                       const char *attached)
{
    const char *command = reader->spec->command;
    const char *value = attached;
    if (option->kind == OPTION_FLAG && attached) {
        report_error(EXIT_USAGE, "%s: --%s takes no value", command, option->name);
        return OPTIONS_WRONG;
    }
    if (option->kind != OPTION_FLAG && !attached) {
        if (reader->next == reader->argc) {
            report_error(EXIT_USAGE, "%s: --%s needs a value: %s", command, option->name,
                         option->metavar);
            return OPTIONS_WRONG;
        }
        value = reader->argv[reader->next++];
    }
    struct number_message message;
    if (!store_value(option, value, &message)) {
        report_error(EXIT_USAGE, "%s: --%s: %s", command, option->name, message.text);
        return OPTIONS_WRONG;
    }
    return OPTIONS_READ;
}

static enum options_outcome read_long(struct reader *reader, const char *word)
{
    const size_t length = strcspn(word + 2, "=");
    const struct option *option = find_by_name(reader->spec, word + 2, length);
    if (!option) {
        return report_unknown(reader->spec, word);
    }
    return read_value(reader, option, word[2 + length] == '=' ? word + 2 + length + 1 : NULL);
}

// -oFILE or -o FILE; letters are not bundled.
static enum options_outcome read_short(struct reader *reader, const char *word)
{
    const struct option *option = find_by_letter(reader->spec, word[1]);
    if (!option) {
        return report_unknown(reader->spec, word);
    }
    return read_value(reader, option, word[2] ? word + 2 : NULL);
}

static enum options_outcome read_positional(const struct option_spec *spec, const char *word,
                                            struct option_arguments *out)
{
    if (out->count == spec->max_positionals || out->count == OPTIONS_MAX_POSITIONALS) {
        report_error(EXIT_USAGE, "%s: '%.200s' is one argument too many; see terrella %s --help",
                     spec->command, word, spec->command);
        return OPTIONS_WRONG;
    }
    if (!*word) {
        report_error(EXIT_USAGE, "%s: an argument is empty", spec->command);
        return OPTIONS_WRONG;
    }
    out->positionals[out->count++] = word;
    return OPTIONS_READ;
}

static bool is_help(const char *word)
{
    return strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0;
}

enum options_outcome options_read(const struct option_spec *spec, int argc, char **argv,
                                  struct option_arguments *out)
{
    *out = (struct option_arguments){0};
    struct reader reader = {spec, argc, argv, 0};
    bool may_be_option = true;
    while (reader.next < argc) {
        const char *word = argv[reader.next++];
        enum options_outcome outcome = OPTIONS_READ;
        if (!may_be_option || word[0] != '-' || word[1] == '\0') {
            outcome = read_positional(spec, word, out);
        } else if (strcmp(word, "--") == 0) {
            may_be_option = false;
        } else if (is_help(word)) {
            options_print_help(spec);
            return OPTIONS_HELP;
        } else if (word[1] == '-') {
            outcome = read_long(&reader, word);
        } else {
            outcome = read_short(&reader, word);
        }
        if (outcome != OPTIONS_READ) {
            return outcome;
        }
    }
    if (out->count < spec->min_positionals) {
        report_error(EXIT_USAGE, "%s: %s is missing; see terrella %s --help", spec->command,
                     spec->positional, spec->command);
        return OPTIONS_WRONG;
    }
    return OPTIONS_READ;
}
