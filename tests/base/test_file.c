// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Files: read whole within a bound, written whole or not at all.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/file.h"
#include "fixture.h"

enum { BOUND = 16 };

static void write_plain(const char *path, const char *text)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(text, 1, strlen(text), file), strlen(text));
    assert_int_equal(fclose(file), 0);
}

static void assert_content(struct fixture *f, const char *path, const char *expected)
{
    char *data = NULL;
    size_t size = 0;
    assert_int_equal(file_read(f->ctx, path, 1 << 20, &data, &size), TRL_OK);
    assert_int_equal(size, strlen(expected));
    assert_memory_equal(data, expected, size + 1); // with the 0 that is not counted
    mem_free(f->ctx, data);
}

static void assert_unreadable(struct fixture *f, const char *path, const char *why)
{
    char *data = (char *)f;
    size_t size = 1;
    const size_t before = f->messages;
    assert_int_equal(file_read(f->ctx, path, BOUND, &data, &size), TRL_ERROR_IO);
    assert_null(data);
    assert_int_equal(size, 0);
    assert_int_equal(f->messages, before + 1);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_FILE_READ);
    assert_non_null(strstr(f->last_message, path));
    assert_non_null(strstr(f->last_message, why));
}

static size_t count_entries(const char *folder)
{
    size_t count = 0;
    DIR *dir = opendir(folder);
    assert_non_null(dir);
    for (struct dirent *entry = readdir(dir); entry; entry = readdir(dir)) {
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    }
    closedir(dir);
    return count;
}

static void files_up_to_the_bound_are_read(void **state)
{
    struct fixture *f = *state;
    const char *path = fixture_path(f, "a");
    write_plain(path, "");
    assert_content(f, path, "");
    write_plain(path, "0123456789abcdef"); // BOUND characters
    char *data = NULL;
    size_t size = 0;
    assert_int_equal(file_read(f->ctx, path, BOUND, &data, &size), TRL_OK);
    assert_int_equal(size, BOUND);
    mem_free(f->ctx, data);
    write_plain(path, "0123456789abcdef+");
    assert_unreadable(f, path, "larger");
}

static void what_is_no_file_is_refused_without_waiting(void **state)
{
    struct fixture *f = *state;
    assert_unreadable(f, fixture_path(f, "missing"), "No such file");
    assert_unreadable(f, f->folder, "not a file");
    assert_unreadable(f, "/dev/zero", "not a file");
    const char *pipe = fixture_path(f, "pipe");
    assert_int_equal(mkfifo(pipe, 0600), 0);
    alarm(10); // a reader that waited for a writer would end here
    assert_unreadable(f, pipe, "not a file");
    alarm(0);
}

static void reading_without_memory_leaves_nothing(void **state)
{
    struct fixture *f = *state;
    const char *path = fixture_path(f, "a");
    write_plain(path, "text");
    char *data = NULL;
    size_t size = 0;
    f->allocations_left = 0;
    assert_int_equal(file_read(f->ctx, path, BOUND, &data, &size), TRL_ERROR_MEMORY);
    f->allocations_left = -1;
    assert_null(data);
}

static void written_file_replaces_the_old_one(void **state)
{
    struct fixture *f = *state;
    const char *path = fixture_path(f, "a");
    assert_int_equal(file_write(f->ctx, path, "first", 5), TRL_OK);
    assert_content(f, path, "first");
    assert_int_equal(file_write(f->ctx, path, "", 0), TRL_OK);
    assert_content(f, path, "");
    assert_int_equal(count_entries(f->folder), 1); // nothing temporary is left
}

static void aborted_replacement_leaves_the_old_file(void **state)
{
    struct fixture *f = *state;
    const char *path = fixture_path(f, "a");
    write_plain(path, "old");
    struct file_replacement r;
    assert_int_equal(file_replacement_begin(f->ctx, path, &r), TRL_OK);
    write_plain(r.temp_path, "half of the n");
    file_replacement_abort(f->ctx, &r);
    file_replacement_abort(f->ctx, &r); // finished: nothing to do
    assert_content(f, path, "old");
    assert_int_equal(count_entries(f->folder), 1);
}

static void commit_whose_file_is_gone_leaves_the_old_file(void **state)
{
    struct fixture *f = *state;
    const char *path = fixture_path(f, "a");
    write_plain(path, "old");
    struct file_replacement r;
    assert_int_equal(file_replacement_begin(f->ctx, path, &r), TRL_OK);
    assert_int_equal(unlink(r.temp_path), 0);
    assert_int_equal(file_replacement_commit(f->ctx, &r), TRL_ERROR_IO);
    assert_null(r.path);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_FILE_WRITE);
    assert_content(f, path, "old");
}

static void assert_unwritable(struct fixture *f, const char *path)
{
    const size_t before = f->messages;
    assert_int_equal(file_write(f->ctx, path, "x", 1), TRL_ERROR_IO);
    assert_int_equal(f->messages, before + 1);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_FILE_WRITE);
}

static void unwritable_places_are_told_at_once(void **state)
{
    struct fixture *f = *state;
    assert_unwritable(f, fixture_path(f, "no/such/folder"));
    assert_unwritable(f, f->folder);
    assert_unwritable(f, "/dev/full");
    assert_unwritable(f, "/proc/terrella"); // where nobody, not even root, makes files
    assert_unwritable(f, "");
    const char *pipe = fixture_path(f, "pipe");
    assert_int_equal(mkfifo(pipe, 0600), 0);
    assert_unwritable(f, pipe);
    assert_int_equal(count_entries(f->folder), 1);
}

static void writing_survives_every_failed_allocation(void **state)
{
    struct fixture *f = *state;
    const char *path = fixture_path(f, "a");
    const long before = f->live;
    trl_result result = TRL_ERROR_MEMORY;
    long n = 0;
    for (; result != TRL_OK && n < 100; n++) {
        f->allocations_left = n;
        result = file_write(f->ctx, path, "x", 1);
        assert_true(result == TRL_OK || result == TRL_ERROR_MEMORY);
        assert_int_equal(f->live, before);
        assert_int_equal(count_entries(f->folder), result == TRL_OK);
    }
    f->allocations_left = -1;
    assert_int_equal(result, TRL_OK);
    assert_int_equal(n, 3); // two names
}

static void folders_are_made_with_those_above(void **state)
{
    struct fixture *f = *state;
    char path[512];
    snprintf(path, sizeof path, "%s/a/b//c/", f->folder);
    assert_int_equal(file_make_dirs(f->ctx, path), TRL_OK);
    assert_int_equal(file_make_dirs(f->ctx, path), TRL_OK); // all there
    struct stat info;
    assert_int_equal(stat(path, &info), 0);
    assert_true(S_ISDIR(info.st_mode));
}

static void folder_below_a_file_is_refused(void **state)
{
    struct fixture *f = *state;
    write_plain(fixture_path(f, "file"), "");
    assert_int_equal(file_make_dirs(f->ctx, fixture_path(f, "file/below")), TRL_ERROR_IO);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_FILE_WRITE);
    // A file of the folder's own name is none either.
    assert_int_equal(file_make_dirs(f->ctx, fixture_path(f, "file")), TRL_ERROR_IO);
}

int main(void)
{
#define WITH_FIXTURE(test) cmocka_unit_test_setup_teardown(test, fixture_set_up, fixture_tear_down)
    const struct CMUnitTest tests[] = {
        WITH_FIXTURE(files_up_to_the_bound_are_read),
        WITH_FIXTURE(what_is_no_file_is_refused_without_waiting),
        WITH_FIXTURE(reading_without_memory_leaves_nothing),
        WITH_FIXTURE(written_file_replaces_the_old_one),
        WITH_FIXTURE(aborted_replacement_leaves_the_old_file),
        WITH_FIXTURE(commit_whose_file_is_gone_leaves_the_old_file),
        WITH_FIXTURE(unwritable_places_are_told_at_once),
        WITH_FIXTURE(writing_survives_every_failed_allocation),
        WITH_FIXTURE(folders_are_made_with_those_above),
        WITH_FIXTURE(folder_below_a_file_is_refused),
    };
#undef WITH_FIXTURE
    return cmocka_run_group_tests(tests, NULL, NULL);
}
