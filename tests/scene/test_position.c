// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Places in JSON texts: found by path, and paths found by place.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <string.h>

#include "scene/position.h"

static const char text[] = "{ \"a\": [1, {\"b\": \"x,]}\\\"\", \"c d\": [[2]]}, null],\n"
                           "  \"\xC3\xA9\": true, \"f\" :{\"a\":{}} }";

static void assert_found(const char *path, bool wants_key, const char *what)
{
    const size_t offset = position_find(text, strlen(text), path, wants_key);
    if (strncmp(text + offset, what, strlen(what)) != 0) {
        fail_msg("%s is at %zu: %.12s", path, offset, text + offset);
    }
}

static void values_and_keys_are_found_by_path(void **state)
{
    (void)state;
    assert_found("", false, "{ \"a\"");
    assert_found("a", false, "[1");
    assert_found("a", true, "\"a\": [1");
    assert_found("a[0]", false, "1,");
    assert_found("a[1].b", false, "\"x,");
    assert_found("a[1][\"c d\"][0][0]", false, "2]]");
    assert_found("a[1][\"c d\"]", true, "\"c d\"");
    assert_found("a[2]", false, "null");
    assert_found("[\"\xC3\xA9\"]", false, "true");
    assert_found("f.a", false, "{}}");
}

static void missing_paths_give_what_encloses_them(void **state)
{
    (void)state;
    assert_found("a[1].missing", false, "{\"b\"");
    assert_found("f.a.b.c", false, "{}}");
    assert_found("nothing", false, "{ \"a\"");
    assert_found("a[1].bc", false, "{\"b\""); // not the value of "b"
}

static void paths_are_found_by_place(void **state)
{
    (void)state;
    const char *two = strstr(text, "2]]");
    const struct position_path path =
        position_path_at(text, strlen(text), (size_t)(two - text) + 1);
    assert_string_equal(path.text, "a[1][\"c d\"][0][0]");
}

static void columns_count_characters(void **state)
{
    (void)state;
    const char *colon = strstr(text, ": true");
    const struct position_place place =
        position_place_of(text, strlen(text), (size_t)(colon - text));
    assert_int_equal(place.line, 2);
    assert_int_equal(place.column, 6); // the two bytes of the accented letter are one
}

static void any_text_ends_without_reading_beyond_it(void **state)
{
    (void)state;
    const char *const broken[] = {"",    "\"",  "\\", "{\"", "{\"a",    "[\"\\",  "]]]}}}",
                                  "{,,", "[,1", ":",  "\0x", "{\"a\":", "[[[[[[["};
    for (size_t i = 0; i < sizeof broken / sizeof broken[0]; i++) {
        const size_t length = i == 10 ? 2 : strlen(broken[i]);
        assert_true(position_find(broken[i], length, "a[1].b", true) <= length);
        assert_true(position_path_at(broken[i], length, length).length < POSITION_MAX_PATH);
    }
    char deep[500];
    memset(deep, '[', sizeof deep);
    assert_int_equal(position_measure(deep, sizeof deep).depth, sizeof deep);
    assert_true(position_find(deep, sizeof deep, "x", false) < sizeof deep);
}

static void long_keys_are_cut_between_characters(void **state)
{
    (void)state;
    char key[200];
    memset(key, 'k', sizeof key);
    memcpy(key + 63, "\xC3\xA9", 2);
    struct position_path path = {.length = 0};
    position_path_add_key(&path, key, sizeof key);
    assert_int_equal(path.length, 63 + 4); // brackets and quotes around 63 letters
    for (int i = 0; i < 100; i++) {
        position_path_add_index(&path, 123456);
    }
    assert_int_equal(path.length, POSITION_MAX_PATH - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_and_keys_are_found_by_path),
        cmocka_unit_test(missing_paths_give_what_encloses_them),
        cmocka_unit_test(paths_are_found_by_place),
        cmocka_unit_test(columns_count_characters),
        cmocka_unit_test(any_text_ends_without_reading_beyond_it),
        cmocka_unit_test(long_keys_are_cut_between_characters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
