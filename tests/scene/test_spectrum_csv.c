// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Spectra from text: what is read, and which line is named when it cannot be.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdlib.h>
#include <string.h>

#include "log.h"
#include "spectrum/spectrum_csv.h"

// From a block of exactly the text's size, so that a sanitizer sees reads behind it.
static trl_result parse(struct fixture *f, const char *text, struct spectrum *out)
{
    const size_t length = strlen(text);
    char *copy = malloc(length + 1);
    assert_non_null(copy);
    memcpy(copy, text, length);
    copy = realloc(copy, length > 0 ? length : 1);
    const trl_result result = spectrum_csv_parse(f->ctx, copy, length, "x.csv", out);
    free(copy);
    return result;
}

static void header_comments_and_spaces_are_passed_over(void **state)
{
    struct fixture *f = *state;
    struct spectrum s;
    const char *text = "\xEF\xBB\xBF# a spectrum\n\nwavelength_nm, value\r\n 400 , 1.5\r\n"
                       "500,\t2e0 # here\n#600,9\n700,+3.5";
    assert_int_equal(parse(f, text, &s), TRL_OK);
    assert_int_equal(s.kind, SPECTRUM_TABLE);
    assert_int_equal(s.table.count, 3);
    assert_true(s.table.nm[0] == 400 && s.table.value[0] == 1.5);
    assert_true(s.table.nm[2] == 700 && s.table.value[2] == 3.5);
    spectrum_finish(f->ctx, &s);
}

static void wrong_lines_are_named(void **state)
{
    struct fixture *f = *state;
    const struct {
        const char *text, *message;
    } cases[] = {
        {"", "x.csv:0: holds no numbers"},
        {"nm,value\n", "x.csv:1: holds no numbers"},
        {"nm,value\nnm,value\n", "x.csv:2: must be two finite numbers"},
        {"400,1\n500\n", "x.csv:2: must be two finite numbers"},
        {"400,1,2\n", "x.csv:1: must be two finite numbers"},
        {"400;1\n", "x.csv:1: must be two finite numbers"},
        {"400,\n", "x.csv:1: must be two finite numbers"},
        {"400,nan\n", "x.csv:1: must be two finite numbers"},
        {"400,inf\n", "x.csv:1: must be two finite numbers"},
        {"400,0x10\n", "x.csv:1: must be two finite numbers"},
        {"400,1e999\n", "x.csv:1: must be two finite numbers"},
        {"400,1e\n", "x.csv:1: must be two finite numbers"},
        {"0,1\n", "x.csv:1: the wavelength must be > 0"},
        {"-5,1\n", "x.csv:1: the wavelength must be > 0"},
        {"400,1\n400,2\n", "x.csv:2: wavelengths must ascend"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        struct spectrum s;
        f->log.errors = 0;
        assert_int_equal(parse(f, cases[i].text, &s), TRL_ERROR_INVALID);
        assert_int_equal(f->log.errors, 1);
        if (!strstr(f->log.error, cases[i].message)) {
            fail_msg("case %zu: got \"%s\"", i, f->log.error);
        }
    }
}

static void long_lines_zero_bytes_and_too_many_lines_are_errors(void **state)
{
    struct fixture *f = *state;
    struct spectrum s;
    char line[400];
    memset(line, '1', sizeof line);
    assert_int_equal(spectrum_csv_parse(f->ctx, line, sizeof line, "x.csv", &s), TRL_ERROR_INVALID);
    assert_int_equal(spectrum_csv_parse(f->ctx, "400,1\0\n", 7, "x.csv", &s), TRL_ERROR_INVALID);

    const int lines = 100001;
    char *many = malloc((size_t)lines * 16);
    assert_non_null(many);
    size_t length = 0;
    for (int i = 0; i < lines; i++) {
        length += (size_t)sprintf(many + length, "%d,1\n", i + 1);
    }
    assert_int_equal(spectrum_csv_parse(f->ctx, many, length, "x.csv", &s), TRL_ERROR_INVALID);
    assert_non_null(strstr(f->log.error, "x.csv:100001: more than 100000 lines"));
    free(many);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(header_comments_and_spaces_are_passed_over),
        cmocka_unit_test(wrong_lines_are_named),
        cmocka_unit_test(long_lines_zero_bytes_and_too_many_lines_are_errors),
    };
    return cmocka_run_group_tests(tests, make_fixture, free_fixture);
}
