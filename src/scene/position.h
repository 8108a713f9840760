// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCENE_POSITION_H
#define SCENE_POSITION_H
// Where things are in the text of a JSON file. Jansson keeps no positions, so they are looked for
// in the text when there is an error to report, and only then.

#include <stdbool.h>
#include <stddef.h>

// JSON nested deeper than this is refused before it is parsed.
enum { POSITION_MAX_DEPTH = 64, POSITION_MAX_PATH = 512 };

// A path such as atmosphere.constituents[1].profile; keys with other characters than letters,
// digits, _ and - are written ["like this"]. Long keys are cut.
struct position_path {
    char text[POSITION_MAX_PATH];
    size_t length;
};

void position_path_add_key(struct position_path *path, const char *key, size_t length);
void position_path_add_index(struct position_path *path, size_t index);

// What the text holds, without parsing it: is it nested too deeply, how many values at most?
struct position_size {
    size_t depth;  // deepest nesting
    size_t values; // upper bound of the number of values
};
struct position_size position_measure(const char *text, size_t length);

// Offset of the value (or of its key) at `path`; of the nearest enclosing value when there is none.
size_t position_find(const char *text, size_t length, const char *path, bool wants_key);

// The path of what stands at an offset; what follows it need not be JSON.
struct position_path position_path_at(const char *text, size_t length, size_t offset);

// Line and column from 1; columns count characters, not bytes.
struct position_place {
    size_t line, column;
};
struct position_place position_place_of(const char *text, size_t length, size_t offset);

#endif // SCENE_POSITION_H
