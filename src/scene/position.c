// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/position.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { KEY_SHOWN = 64 };

static void append(struct position_path *path, const char *text, size_t length)
{
    const size_t room = POSITION_MAX_PATH - 1 - path->length;
    const size_t taken = length < room ? length : room;
    memcpy(path->text + path->length, text, taken);
    path->length += taken;
    path->text[path->length] = '\0';
}

static bool is_plain(const char *key, size_t length)
{
    for (size_t i = 0; i < length; i++) {
        if (!isalnum((unsigned char)key[i]) && key[i] != '_' && key[i] != '-') {
            return false;
        }
    }
    return length > 0;
}

// A cut must not leave half a UTF-8 character.
static size_t cut_length(const char *key, size_t length)
{
    if (length <= KEY_SHOWN) {
        return length;
    }
    size_t cut = KEY_SHOWN;
    while (cut > 0 && ((unsigned char)key[cut] & 0xC0) == 0x80) {
        cut--;
    }
    return cut;
}

void position_path_add_key(struct position_path *path, const char *key, size_t length)
{
    const size_t shown = cut_length(key, length);
    if (is_plain(key, length)) {
        append(path, ".", path->length > 0 ? 1 : 0);
        append(path, key, shown);
    } else {
        append(path, "[\"", 2);
        append(path, key, shown);
        append(path, "\"]", 2);
    }
}

void position_path_add_index(struct position_path *path, size_t index)
{
    char text[32];
    const int length = snprintf(text, sizeof text, "[%zu]", index);
    append(path, text, (size_t)length);
}

// An open object or array.
struct level {
    bool is_array;
    size_t index;       // array: of the current element
    size_t path_length; // of the object or array itself
};

// Reads JSON as a row of keys and values and keeps the path of the current one. Forgiving: what is
// not JSON gives wrong paths, never a read outside the text.
struct scanner {
    const char *text;
    size_t length;
    size_t at;
    struct position_path path;
    struct level levels[POSITION_MAX_DEPTH];
    size_t depth;
    bool expects_key;
    size_t key_offset; // of the key of the current value, else of the value
};

enum event { EVENT_END, EVENT_KEY, EVENT_VALUE };

static void truncate_path(struct scanner *s, size_t length)
{
    s->path.length = length;
    s->path.text[length] = '\0';
}

// From the opening quote to behind the closing one.
static void skip_string(struct scanner *s)
{
    s->at++;
    while (s->at < s->length && s->text[s->at] != '"') {
        s->at += s->text[s->at] == '\\' ? 2 : 1;
    }
    s->at = s->at < s->length ? s->at + 1 : s->length;
}

static void skip_scalar(struct scanner *s)
{
    if (s->text[s->at] == '"') {
        skip_string(s);
        return;
    }
    while (s->at < s->length && !strchr(",:{}[]\" \t\r\n", s->text[s->at])) {
        s->at++;
    }
}

static void read_key(struct scanner *s)
{
    const size_t start = s->at;
    skip_string(s);
    const size_t content = s->at > start + 1 ? s->at - start - 2 : 0;
    s->key_offset = start;
    s->expects_key = false;
    truncate_path(s, s->levels[s->depth - 1].path_length);
    position_path_add_key(&s->path, s->text + start + 1, content);
}

static void open_level(struct scanner *s, bool is_array)
{
    if (s->depth < POSITION_MAX_DEPTH) {
        s->levels[s->depth] = (struct level){.is_array = is_array, .path_length = s->path.length};
        s->depth++;
    }
    s->expects_key = !is_array;
    s->at++;
}

static void close_level(struct scanner *s)
{
    if (s->depth > 0) {
        s->depth--;
        truncate_path(s, s->levels[s->depth].path_length);
    }
    s->expects_key = false;
    s->at++;
}

static void next_item(struct scanner *s)
{
    s->at++;
    if (s->depth > 0 && s->levels[s->depth - 1].is_array) {
        s->levels[s->depth - 1].index++;
    } else {
        s->expects_key = s->depth > 0;
    }
}

// The element of an array has its index for a key.
static void begin_value(struct scanner *s)
{
    if (s->depth > 0 && s->levels[s->depth - 1].is_array) {
        truncate_path(s, s->levels[s->depth - 1].path_length);
        position_path_add_index(&s->path, s->levels[s->depth - 1].index);
        s->key_offset = s->at;
    } else if (s->depth == 0) {
        s->key_offset = s->at;
    }
}

// Goes to the next key or value. `offset` is where it starts; a scalar has been passed over, of an
// object or array only the bracket.
static enum event scan_next(struct scanner *s, size_t *offset)
{
    while (s->at < s->length) {
        const char c = s->text[s->at];
        *offset = s->at;
        if (c == ',') {
            next_item(s);
        } else if (c == '}' || c == ']') {
            close_level(s);
        } else if (strchr(": \t\r\n", c)) {
            s->at++;
        } else if (c == '"' && s->expects_key) {
            read_key(s);
            return EVENT_KEY;
        } else if (c == '{' || c == '[') {
            begin_value(s);
            open_level(s, c == '[');
            return EVENT_VALUE;
        } else {
            begin_value(s);
            skip_scalar(s);
            return EVENT_VALUE;
        }
    }
    return EVENT_END;
}

struct position_size position_measure(const char *text, size_t length)
{
    struct position_size size = {0, 1};
    size_t depth = 0;
    bool is_string = false;
    for (size_t i = 0; i < length; i++) {
        const char c = text[i];
        if (is_string) {
            if (c == '\\') {
                i++;
            } else if (c == '"') {
                is_string = false;
            }
        } else if (c == '"') {
            is_string = true;
        } else if (c == '{' || c == '[') {
            depth++;
            size.values++;
            size.depth = depth > size.depth ? depth : size.depth;
        } else if (c == '}' || c == ']') {
            depth -= depth > 0;
        } else if (c == ',') {
            size.values++;
        }
    }
    return size;
}

// How much of `target` a path covers when it is the target or encloses it; 0 is the root, -1
// neither.
static long match_path(const struct position_path *path, const char *target)
{
    if (strncmp(path->text, target, path->length) != 0) {
        return -1;
    }
    const char next = target[path->length];
    const bool is_whole = next == '\0' || next == '.' || next == '[' || path->length == 0;
    return is_whole ? (long)path->length : -1;
}

size_t position_find(const char *text, size_t length, const char *path, bool wants_key)
{
    struct scanner s = {.text = text, .length = length};
    size_t best = 0;
    long best_match = -1;
    size_t offset = 0;
    for (enum event e = scan_next(&s, &offset); e != EVENT_END; e = scan_next(&s, &offset)) {
        const long match = e == EVENT_VALUE ? match_path(&s.path, path) : -1;
        if (match > best_match) {
            best_match = match;
            best = wants_key ? s.key_offset : offset;
        }
    }
    return best;
}

struct position_path position_path_at(const char *text, size_t length, size_t offset)
{
    struct scanner s = {.text = text, .length = offset < length ? offset : length};
    size_t ignored = 0;
    while (scan_next(&s, &ignored) != EVENT_END) {
    }
    return s.path;
}

struct position_place position_place_of(const char *text, size_t length, size_t offset)
{
    struct position_place place = {1, 1};
    for (size_t i = 0; i < offset && i < length; i++) {
        if (text[i] == '\n') {
            place.line++;
            place.column = 1;
        } else if (((unsigned char)text[i] & 0xC0) != 0x80) {
            place.column++;
        }
    }
    return place;
}
