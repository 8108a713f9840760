// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/node.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "scene/position.h"

enum {
    MESSAGE_MAX = 1024,
    WORD_MAX = 48, // of what is compared with known words
    SHOWN_MAX = 48,
    STRING_MAX = 4096,
    TABLE_MAX = 100000,
    VALUES_MAX = 1000000, // bounds what Jansson takes to some 300 MB
    TEXT_MAX = 16 << 20
};

// One line whatever was in the file.
static void blank_controls(char *text)
{
    for (char *c = text; *c; c++) {
        if ((unsigned char)*c < 0x20 || *c == 0x7f) {
            *c = ' ';
        }
    }
}

static void build_path(const struct scene_node *node, struct position_path *path)
{
    if (!node->parent) {
        *path = (struct position_path){.length = 0};
        return;
    }
    build_path(node->parent, path);
    if (node->key) {
        position_path_add_key(path, node->key, strlen(node->key));
    } else {
        position_path_add_index(path, node->index);
    }
}

static trl_result report(const struct scene_doc *doc, size_t offset,
                         const struct position_path *path, const char *what)
{
    const struct position_place place = position_place_of(doc->text, doc->length, offset);
    char line[MESSAGE_MAX + POSITION_MAX_PATH];
    snprintf(line, sizeof line, "%s%s%s", path->text, path->length > 0 ? ": " : "", what);
    blank_controls(line);
    return trl_fail(doc->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE, "%s:%zu:%zu: %s", doc->name,
                    place.line, place.column, line);
}

static trl_result report_node(const struct scene_node *node, bool wants_key, const char *what)
{
    struct position_path path;
    build_path(node, &path);
    const struct scene_doc *doc = node->doc;
    const size_t offset = position_find(doc->text, doc->length, path.text, wants_key);
    return report(doc, offset, &path, what);
}

trl_result scene_node_fail(const struct scene_node *node, const char *format, ...)
{
    char what[MESSAGE_MAX];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof what, format, args);
    va_end(args);
    return report_node(node, false, what);
}

// Jansson stops behind the token that it does not like; people look at its start.
static size_t find_token_start(const struct scene_doc *doc, size_t end)
{
    if (end == 0 || end > doc->length) {
        return 0;
    }
    size_t at = end - 1;
    const bool is_string = doc->text[at] == '"';
    while (at > 0 && !strchr(is_string ? "\"\n" : ",:{}[]\" \t\r\n", doc->text[at - 1])) {
        at--;
    }
    return is_string && at > 0 ? at - 1 : at;
}

// Jansson's text names the last token, which can be long.
static trl_result report_syntax(const struct scene_doc *doc, const json_error_t *error)
{
    if (json_error_code(error) == json_error_out_of_memory) {
        return trl_fail(doc->ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_MEMORY, "%s: out of memory",
                        doc->name);
    }
    const size_t offset = error->position > 0 ? (size_t)error->position : 0;
    const struct position_path path = position_path_at(doc->text, doc->length, offset);
    char what[MESSAGE_MAX];
    snprintf(what, sizeof what, "not JSON: %s", error->text);
    return report(doc, find_token_start(doc, offset), &path, what);
}

trl_result scene_node_parse(const struct scene_doc *doc, struct scene_node *out, json_t **root)
{
    *out = (struct scene_node){.doc = doc};
    *root = NULL;
    if (doc->length > TEXT_MAX) {
        return scene_node_fail(out, "larger than 16 MiB");
    }
    const struct position_size size = position_measure(doc->text, doc->length);
    if (size.depth > POSITION_MAX_DEPTH) {
        return scene_node_fail(out, "nested more than %d deep", POSITION_MAX_DEPTH);
    }
    if (size.values > VALUES_MAX) {
        return scene_node_fail(out, "more than %d values", VALUES_MAX);
    }
    json_error_t error;
    *root = json_loadb(doc->text, doc->length, JSON_REJECT_DUPLICATES | JSON_DECODE_INT_AS_REAL,
                       &error);
    if (!*root) {
        return report_syntax(doc, &error);
    }
    out->value = *root;
    return TRL_OK;
}

struct scene_node scene_node_member(const struct scene_node *object, const char *key)
{
    return (struct scene_node){.doc = object->doc,
                               .parent = object,
                               .key = key,
                               .value = json_object_get(object->value, key)};
}

struct scene_node scene_node_element(const struct scene_node *array, size_t index)
{
    return (struct scene_node){.doc = array->doc,
                               .parent = array,
                               .index = index,
                               .value = json_array_get(array->value, index)};
}

static const char *describe_type(const json_t *value)
{
    if (!value) {
        return "is missing";
    }
    switch (json_typeof(value)) {
    case JSON_OBJECT:
        return "is an object";
    case JSON_ARRAY:
        return "is a list";
    case JSON_STRING:
        return "is a string";
    case JSON_INTEGER:
    case JSON_REAL:
        return "is a number";
    case JSON_TRUE:
    case JSON_FALSE:
        return "is true or false";
    case JSON_NULL:
        return "is null";
    }
    return "is wrong";
}

static trl_result fail_type(const struct scene_node *node, const char *wanted)
{
    return scene_node_fail(node, "%s; must be %s", describe_type(node->value), wanted);
}

static size_t smallest(size_t a, size_t b, size_t c)
{
    const size_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}

// Levenshtein's distance of the first WORD_MAX characters.
static size_t measure_distance(const char *a, const char *b)
{
    const size_t a_length = strnlen(a, WORD_MAX);
    const size_t b_length = strnlen(b, WORD_MAX);
    size_t row[WORD_MAX + 1];
    for (size_t j = 0; j <= b_length; j++) {
        row[j] = j;
    }
    for (size_t i = 1; i <= a_length; i++) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b_length; j++) {
            const size_t above = row[j];
            row[j] = smallest(above + 1, row[j - 1] + 1, diagonal + (a[i - 1] != b[j - 1]));
            diagonal = above;
        }
    }
    return row[b_length];
}

// The words separated by commas, and the one nearest to `to`.
struct word_list {
    char text[MESSAGE_MAX / 2];
    const char *nearest; // NULL: there are none
    size_t distance;
};

static void list_words(const char *const *words, const char *to, struct word_list *list)
{
    size_t length = strlen(list->text);
    for (; words && *words; words++) {
        const int added = snprintf(list->text + length, sizeof list->text - length, "%s%s",
                                   length > 0 ? ", " : "", *words);
        length = strlen(list->text);
        (void)added; // the lists are the reader's own and fit
        const size_t distance = to ? measure_distance(to, *words) : 0;
        if (!list->nearest || distance < list->distance) {
            list->nearest = *words;
            list->distance = distance;
        }
    }
}

static bool has_word(const char *const *words, const char *word)
{
    for (; words && *words; words++) {
        if (strcmp(*words, word) == 0) {
            return true;
        }
    }
    return false;
}

static trl_result fail_unknown_key(const struct scene_node *node, const struct word_list *known)
{
    char what[MESSAGE_MAX];
    snprintf(what, sizeof what, "unknown key; the nearest known one is \"%s\" (known: %s)",
             known->nearest, known->text);
    return report_node(node, true, what);
}

// `extra` are known keys too, or NULL.
static trl_result check_keys(const struct scene_node *node, const char *const *known,
                             const char *const *extra)
{
    const char *key;
    json_t *value;
    json_object_foreach((json_t *)node->value, key, value)
    {
        const struct scene_node member = scene_node_member(node, key);
        if (strcmp(key, "comment") == 0) {
            if (!json_is_string(value)) {
                return fail_type(&member, "a string");
            }
        } else if (!has_word(known, key) && !has_word(extra, key)) {
            struct word_list list = {.nearest = NULL};
            list_words(known, key, &list);
            list_words(extra, key, &list);
            list_words((const char *const[]){"comment", NULL}, key, &list);
            return fail_unknown_key(&member, &list);
        }
    }
    return TRL_OK;
}

trl_result scene_node_check_keys(const struct scene_node *node, const char *const *known)
{
    if (!json_is_object(node->value)) {
        return fail_type(node, "an object");
    }
    return check_keys(node, known, NULL);
}

trl_result scene_node_check_array(const struct scene_node *node, size_t max, const char *what)
{
    if (!json_is_array(node->value)) {
        return fail_type(node, what);
    }
    if (json_array_size(node->value) > max) {
        return scene_node_fail(node, "has %zu elements; at most %zu are allowed",
                               json_array_size(node->value), max);
    }
    return TRL_OK;
}

trl_result scene_node_choose(const struct scene_node *node, const struct scene_choice *choice,
                             size_t *index)
{
    if (!json_is_object(node->value)) {
        return fail_type(node, choice->what);
    }
    const trl_result result = check_keys(node, choice->forms, choice->extra);
    if (result != TRL_OK) {
        return result;
    }
    size_t found = 0;
    for (size_t i = 0; choice->forms[i]; i++) {
        if (json_object_get(node->value, choice->forms[i])) {
            *index = i;
            found++;
        }
    }
    if (found != 1) {
        struct word_list list = {.nearest = NULL};
        list_words(choice->forms, NULL, &list);
        return scene_node_fail(node, "has %zu of the keys %s; must have exactly one", found,
                               list.text);
    }
    return TRL_OK;
}

trl_result scene_node_word(const struct scene_node *node, const char *const *words, size_t *index)
{
    struct word_list list = {.nearest = NULL};
    const char *word = json_string_value(node->value);
    list_words(words, word, &list);
    if (!word) {
        char wanted[MESSAGE_MAX];
        snprintf(wanted, sizeof wanted, "one of the strings %s", list.text);
        return fail_type(node, wanted);
    }
    for (size_t i = 0; words[i]; i++) {
        if (strcmp(words[i], word) == 0) {
            *index = i;
            return TRL_OK;
        }
    }
    return scene_node_fail(node, "is \"%.*s\"; the nearest known word is \"%s\" (known: %s)",
                           SHOWN_MAX, word, list.nearest, list.text);
}

bool scene_range_holds(const struct scene_range *range, double number)
{
    const bool is_above = range->is_min_open ? number > range->min : number >= range->min;
    const bool is_below = range->is_max_open ? number < range->max : number <= range->max;
    return is_above && is_below; // NaN is neither
}

void scene_range_describe(const struct scene_range *range, char *text, size_t size)
{
    snprintf(text, size, "a number %s %g and %s %g", range->is_min_open ? ">" : ">=", range->min,
             range->is_max_open ? "<" : "<=", range->max);
}

trl_result scene_node_number(const struct scene_node *node, const struct scene_range *range,
                             double *out)
{
    char allowed[128];
    scene_range_describe(range, allowed, sizeof allowed);
    if (!json_is_number(node->value)) {
        return fail_type(node, allowed);
    }
    const double number = json_number_value(node->value);
    if (!scene_range_holds(range, number)) {
        return scene_node_fail(node, "is %.10g; must be %s", number, allowed);
    }
    if (range->is_whole && number != floor(number)) {
        return scene_node_fail(node, "is %g; must be a whole number", number);
    }
    *out = number;
    return TRL_OK;
}

trl_result scene_node_number_or(const struct scene_node *node, const struct scene_range *range,
                                double *out)
{
    return node->value ? scene_node_number(node, range, out) : TRL_OK;
}

trl_result scene_node_string(const struct scene_node *node, const char **out)
{
    if (!json_is_string(node->value)) {
        return fail_type(node, "a string");
    }
    const size_t length = json_string_length(node->value);
    if (length == 0 || length > STRING_MAX) {
        return scene_node_fail(node, "has %zu bytes; must have 1 to %d", length, STRING_MAX);
    }
    *out = json_string_value(node->value);
    return TRL_OK;
}

trl_result scene_node_bool_or(const struct scene_node *node, bool *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    if (!json_is_boolean(node->value)) {
        return fail_type(node, "true or false");
    }
    *out = json_is_true(node->value);
    return TRL_OK;
}

static trl_result read_pair(const struct scene_node *pair, const struct scene_table_desc *desc,
                            double *x, double *y)
{
    if (!json_is_array(pair->value) || json_array_size(pair->value) != 2) {
        return scene_node_fail(pair, "must be a pair %s", desc->pair);
    }
    const struct scene_node first = scene_node_element(pair, 0);
    const struct scene_node second = scene_node_element(pair, 1);
    trl_result result = scene_node_number(&first, &desc->x, x);
    if (result == TRL_OK) {
        result = scene_node_number(&second, &desc->y, y);
    }
    return result;
}

static trl_result read_pairs(const struct scene_node *node, const struct scene_table_desc *desc,
                             struct scene_table *table)
{
    for (size_t i = 0; i < table->count; i++) {
        const struct scene_node pair = scene_node_element(node, i);
        const trl_result result = read_pair(&pair, desc, &table->x[i], &table->y[i]);
        if (result != TRL_OK) {
            return result;
        }
        if (i > 0 && !(table->x[i] > table->x[i - 1])) {
            const struct scene_node first = scene_node_element(&pair, 0);
            return scene_node_fail(&first, "is %.10g after %.10g; must ascend", table->x[i],
                                   table->x[i - 1]);
        }
    }
    return TRL_OK;
}

trl_result scene_node_table(const struct scene_node *node, const struct scene_table_desc *desc,
                            struct scene_table *out)
{
    *out = (struct scene_table){0};
    char wanted[128];
    snprintf(wanted, sizeof wanted, "a list of pairs %s", desc->pair);
    trl_result result = scene_node_check_array(node, TABLE_MAX, wanted);
    if (result != TRL_OK) {
        return result;
    }
    const size_t count = json_array_size(node->value);
    if (count == 0) {
        return scene_node_fail(node, "is empty; must be %s", wanted);
    }
    double *block = mem_alloc(node->doc->ctx, count, 2 * sizeof *block);
    if (!block) {
        return TRL_ERROR_MEMORY;
    }
    *out = (struct scene_table){.x = block, .y = block + count, .count = count};
    result = read_pairs(node, desc, out);
    if (result != TRL_OK) {
        mem_free(node->doc->ctx, block);
        *out = (struct scene_table){0};
    }
    return result;
}
