// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCENE_NODE_H
#define SCENE_NODE_H
// Values of a JSON document that know where they are, with checked reading: what is wrong with one
// becomes a single line "file:line:column: path: what is wrong".

#include <jansson.h>

#include "base/context.h"

// The file that is being read. Lives on the stack of the reader.
struct scene_doc {
    const trl_context *ctx;
    const char *name;     // of the file, for messages
    const char *base_dir; // where the files that it names are looked for first
    const char *text;
    size_t length;
};

// A value and how it is reached. Parents live on the stack of the callers.
struct scene_node {
    const struct scene_doc *doc;
    const struct scene_node *parent; // NULL: the root
    const char *key;                 // NULL: element `index` of an array
    size_t index;
    const json_t *value; // NULL: there is none
};

// What a number may be. With an open end the limit itself is not allowed.
struct scene_range {
    double min, max;
    bool is_min_open, is_max_open;
    bool is_whole; // of a node: without a fraction
};

// Reports and returns TRL_ERROR_INVALID.
__attribute__((format(printf, 2, 3))) trl_result scene_node_fail(const struct scene_node *node,
                                                                 const char *format, ...);

// The root of a text of at most 16 MiB. `out->value` is a new reference: json_decref it.
TRL_MUST_USE trl_result scene_node_parse(const struct scene_doc *doc, struct scene_node *out,
                                         json_t **root);

// Children; their value is NULL when they do not exist.
struct scene_node scene_node_member(const struct scene_node *object, const char *key);
struct scene_node scene_node_element(const struct scene_node *array, size_t index);

// It is an object, and has no keys but these (NULL at the end) and "comment", which has to be a
// string.
TRL_MUST_USE trl_result scene_node_check_keys(const struct scene_node *node,
                                              const char *const *known);

// It is an array of at most `max` elements.
TRL_MUST_USE trl_result scene_node_check_array(const struct scene_node *node, size_t max,
                                               const char *what);

// Which one of the `forms` (NULL at the end) the object has as its only key beside `extra` ones and
// "comment"; `index` is its place among the forms.
struct scene_choice {
    const char *const *forms;
    const char *const *extra; // or NULL
    const char *what; // what is wanted: "must be a number, ... or an object with one of ..."
};
TRL_MUST_USE trl_result scene_node_choose(const struct scene_node *node,
                                          const struct scene_choice *choice, size_t *index);

// A string that is one of `words` (NULL at the end).
TRL_MUST_USE trl_result scene_node_word(const struct scene_node *node, const char *const *words,
                                        size_t *index);

// A number in the range. `scene_node_number_or` leaves *out alone when there is none.
TRL_MUST_USE trl_result scene_node_number(const struct scene_node *node,
                                          const struct scene_range *range, double *out);
TRL_MUST_USE trl_result scene_node_number_or(const struct scene_node *node,
                                             const struct scene_range *range, double *out);

// A string that is not empty, at most 4096 bytes; owned by the document.
TRL_MUST_USE trl_result scene_node_string(const struct scene_node *node, const char **out);

TRL_MUST_USE trl_result scene_node_bool_or(const struct scene_node *node, bool *out);

// For numbers that come from elsewhere than a node.
bool scene_range_holds(const struct scene_range *range, double number);
void scene_range_describe(const struct scene_range *range, char *text, size_t size);

// A list of pairs [x, y], x ascending, 1 to 100000 of them. `x` and `y` are one block: mem_free(x).
struct scene_table_desc {
    struct scene_range x, y;
    const char *pair; // what is in a pair: "[nm, value]"
};
struct scene_table {
    double *x, *y;
    size_t count;
};
TRL_MUST_USE trl_result scene_node_table(const struct scene_node *node,
                                         const struct scene_table_desc *desc,
                                         struct scene_table *out);

#endif // SCENE_NODE_H
