// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The readers of command lines and tables against random input: they answer, and stay within their
// memory (which the sanitised build checks).
#include "cli/csv.h"
#include "cli/options.h"
#include "cli/shrink.h"

#include <fcntl.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static uint32_t draw_bits(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*state >> 33);
}

// Messages and helps by the thousand are not for reading: they go nowhere until speak().
struct silence {
    int output, errors;
};

static struct silence fall_silent(void)
{
    fflush(stdout);
    const struct silence before = {dup(STDOUT_FILENO), dup(STDERR_FILENO)};
    const int nowhere = open("/dev/null", O_WRONLY);
    assert_true(nowhere >= 0);
    dup2(nowhere, STDOUT_FILENO);
    dup2(nowhere, STDERR_FILENO);
    close(nowhere);
    return before;
}

static void speak(struct silence before)
{
    fflush(stdout);
    dup2(before.output, STDOUT_FILENO);
    dup2(before.errors, STDERR_FILENO);
    close(before.output);
    close(before.errors);
}

// Everything that a command line can set.
struct values {
    bool flag;
    struct option_number number, word, whole;
    struct number_list list;
    const char *text;
    int choice;
    struct number_size size;
};

static const char *const choices[] = {"red", "green", NULL};

static enum options_outcome read_words(int argc, char **argv, struct values *v,
                                       struct option_arguments *arguments)
{
    const struct number_range range = {-10.0, 10.0};
    const struct option options[] = {
        {.name = "flag", .letter = 'f', .kind = OPTION_FLAG, .target.flag = &v->flag, .help = "A"},
        {.name = "number",
         .kind = OPTION_NUMBER,
         .target.number = &v->number,
         .range = range,
         .metavar = "N",
         .help = "B"},
        {.name = "word",
         .kind = OPTION_NUMBER,
         .target.number = &v->word,
         .range = range,
         .word = "auto",
         .metavar = "N",
         .help = "C"},
        {.name = "whole",
         .kind = OPTION_NUMBER,
         .target.number = &v->whole,
         .range = range,
         .is_whole = true,
         .metavar = "N",
         .help = "D"},
        {.name = "list",
         .letter = 'l',
         .kind = OPTION_LIST,
         .target.list = &v->list,
         .range = range,
         .metavar = "LIST",
         .help = "E"},
        {.name = "text",
         .letter = 'o',
         .kind = OPTION_TEXT,
         .target.text = &v->text,
         .metavar = "T",
         .help = "F"},
        {.name = "choice",
         .kind = OPTION_CHOICE,
         .target.choice = &v->choice,
         .choices = choices,
         .metavar = "C",
         .help = "G"},
        {.name = "size",
         .kind = OPTION_SIZE,
         .target.size = &v->size,
         .metavar = "WxH",
         .help = "H"},
    };
    const struct option_section section = {"Options", options, sizeof options / sizeof options[0]};
    const struct option_spec spec = {.command = "test",
                                     .positional = "FILE",
                                     .max_positionals = 3,
                                     .about = "",
                                     .examples = "",
                                     .sections = &section,
                                     .section_count = 1};
    return options_read(&spec, argc, argv, arguments);
}

static void words_go_where_they_belong(void **state)
{
    (void)state;
    char *words[] = {"a",    "-f", "--number=-2.5", "--word", "auto", "--whole", "3",   "-l1,2:4:1",
                     "-o",   "-",  "--choice",      "green",  "b",    "--size",  "4x5", "--text",
                     "last", "--", "--flag"};
    struct values v = {0};
    struct option_arguments arguments;
    assert_int_equal(read_words(sizeof words / sizeof words[0], words, &v, &arguments),
                     OPTIONS_READ);
    assert_true(v.flag && v.number.is_given && v.number.value == -2.5 && !v.number.is_word);
    assert_true(v.word.is_given && v.word.is_word && v.whole.value == 3.0);
    assert_int_equal(v.list.count, 4);
    assert_true(v.list.items[3].value == 4.0);
    assert_string_equal(v.list.items[3].text, "4");
    assert_string_equal(v.text, "last");
    assert_int_equal(v.choice, 1);
    assert_true(v.size.width == 4 && v.size.height == 5);
    assert_int_equal(arguments.count, 3);
    assert_string_equal(arguments.positionals[2], "--flag");
    number_list_finish(&v.list);
}

// A word made of pieces that readers take apart, and now and then of any bytes.
static void make_word(uint64_t *seed, char *word, size_t size)
{
    static const char *const pieces[] = {
        "--", "-",    "f",   "flag",        "=",      "number", "list",  "text", "size",
        "o",  "auto", "1",   "0",           "e9",     ".",      ",",     ":",    "x",
        "",   "nan",  "inf", "99999999999", "choice", "green",  "whole", "%s%n"};
    word[0] = '\0';
    const uint32_t count = draw_bits(seed) % 6;
    for (uint32_t i = 0; i < count; i++) {
        const char *piece = pieces[draw_bits(seed) % (sizeof pieces / sizeof pieces[0])];
        const size_t length = strlen(word);
        snprintf(word + length, size - length, "%s", piece);
    }
    if (draw_bits(seed) % 8 == 0) {
        const uint32_t length = draw_bits(seed) % (uint32_t)size;
        for (uint32_t i = 0; i < length; i++) {
            word[i] = (char)(1 + draw_bits(seed) % 255);
        }
        word[length] = '\0';
    }
}

static void check_values(const struct values *v, const struct option_arguments *arguments)
{
    assert_true(fabs(v->number.value) <= 10.0 && fabs(v->word.value) <= 10.0);
    assert_true(v->whole.value == floor(v->whole.value));
    assert_true(v->list.count <= NUMBER_LIST_MAX);
    for (size_t i = 0; i < v->list.count; i++) {
        assert_true(fabs(v->list.items[i].value) <= 10.0);
    }
    assert_true(v->size.width <= NUMBER_SIZE_MAX && v->size.height <= NUMBER_SIZE_MAX);
    assert_in_range(v->choice, 0, 1);
    assert_in_range(arguments->count, 0, 3);
}

static void random_words_are_read_or_refused(void **state)
{
    (void)state;
    enum { WORDS = 6, ROUNDS = 20000, SIZE = 100 };
    uint64_t seed = 42;
    int read = 0;
    int wrong = 0;
    const struct silence silence = fall_silent();
    for (int round = 0; round < ROUNDS; round++) {
        static char storage[WORDS][SIZE];
        char *words[WORDS];
        const int count = (int)(draw_bits(&seed) % (WORDS + 1));
        for (int i = 0; i < count; i++) {
            make_word(&seed, storage[i], SIZE);
            words[i] = storage[i];
        }
        struct values v = {0};
        struct option_arguments arguments;
        const enum options_outcome outcome = read_words(count, words, &v, &arguments);
        read += outcome == OPTIONS_READ;
        wrong += outcome == OPTIONS_WRONG;
        if (outcome == OPTIONS_READ) {
            check_values(&v, &arguments);
        }
        number_list_finish(&v.list);
    }
    speak(silence);
    // Both happen often, else the pieces are badly chosen.
    assert_true(read > ROUNDS / 20 && wrong > ROUNDS / 20);
}

static void random_tables_are_read_or_refused(void **state)
{
    (void)state;
    static const char letters[] = "a,,,,\n\n\r\"1 \t\xEF\xBB\xBF";
    char path[] = "/tmp/terrella-words.XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    uint64_t seed = 3;
    int read = 0;
    const struct silence silence = fall_silent();
    for (int round = 0; round < 5000; round++) {
        char text[64];
        const size_t length = draw_bits(&seed) % sizeof text;
        for (size_t i = 0; i < length; i++) {
            text[i] = letters[draw_bits(&seed) % (sizeof letters)]; // sometimes the 0 at its end
        }
        assert_true(pwrite(descriptor, text, length, 0) == (ssize_t)length);
        assert_int_equal(ftruncate(descriptor, (off_t)length), 0);
        struct csv_table table;
        if (csv_read(path, &table) == EXIT_OK) {
            read++;
            for (size_t row = 0; row < table.row_count; row++) {
                for (size_t column = 0; column < table.column_count; column++) {
                    assert_null(strpbrk(csv_field(&table, row, column), ",\n"));
                }
                assert_in_range(table.lines[row], 2, 64);
            }
        }
        csv_finish(&table);
    }
    speak(silence);
    close(descriptor);
    unlink(path);
    assert_in_range(read, 100, 4900);
}

static void the_nearest_name_is_near(void **state)
{
    (void)state;
    const char *const names[] = {"render", "sky", "view", "info", "bench"};
    assert_string_equal(report_nearest("rnder", names, 5), "render");
    assert_string_equal(report_nearest("veiw", names, 5), "view");
    assert_string_equal(report_nearest("bensh", names, 5), "bench");
    assert_null(report_nearest("xyzzy", names, 5));
    assert_null(report_nearest("", names, 5));
    char longest[200];
    memset(longest, 'r', sizeof longest - 1);
    longest[sizeof longest - 1] = '\0';
    assert_null(report_nearest(longest, names, 5));
}

static void blocks_are_averaged_as_light(void **state)
{
    (void)state;
    // Two blocks of 2 x 2: half black and half white, and one grey.
    uint8_t codes[32];
    float light[32];
    for (int y = 0; y < 2; y++) {
        for (int x = 0; x < 4; x++) {
            for (int c = 0; c < 4; c++) {
                codes[4 * (4 * y + x) + c] = (uint8_t)(x < 2 ? 255 * y : 100);
                light[4 * (4 * y + x) + c] = (float)(x < 2 ? 8 * y : 3);
            }
        }
    }
    shrink_srgb(codes, 2, 1, 2);
    assert_int_equal(codes[0], 188); // the sRGB code of half the light
    assert_int_equal(codes[4], 100);
    shrink_radiance(light, 2, 1, 2);
    assert_true(fabsf(light[0] - 4) < 1e-6f && fabsf(light[4] - 3) < 1e-6f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(words_go_where_they_belong),
        cmocka_unit_test(random_words_are_read_or_refused),
        cmocka_unit_test(random_tables_are_read_or_refused),
        cmocka_unit_test(the_nearest_name_is_near),
        cmocka_unit_test(blocks_are_averaged_as_light),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
