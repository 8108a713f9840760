// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Contexts: what they refuse, where their folders are, that memory running out is an answer.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fixture.h"

static void default_desc_makes_a_silent_context(void **state)
{
    (void)state;
    const trl_context_desc desc = trl_context_desc_default();
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    assert_int_equal(trl_fail(ctx, TRL_ERROR_IO, TRL_LOG_ITEM_GENERAL, "nobody hears"),
                     TRL_ERROR_IO);
    assert_int_equal(trl_progress(ctx, "nobody is told", 0.5), TRL_OK);
    trl_context_destroy(&ctx);
    assert_null(ctx);
    trl_context_destroy(&ctx);
    trl_context_destroy(NULL);
}

static void desc_without_canary_is_refused(void **state)
{
    (void)state;
    const trl_context_desc zeroed = {0};
    trl_context *ctx = (trl_context *)state;
    assert_int_equal(trl_context_create(&zeroed, &ctx), TRL_ERROR_INVALID);
    assert_null(ctx);
    assert_int_equal(trl_context_create(NULL, &ctx), TRL_ERROR_INVALID);
    const trl_context_desc desc = trl_context_desc_default();
    assert_int_equal(trl_context_create(&desc, NULL), TRL_ERROR_INVALID);
}

static void part_of_an_allocator_is_refused(void **state)
{
    trl_context_desc desc = fixture_desc(*state);
    const trl_allocator whole = desc.allocator;
    trl_context *ctx = NULL;
    desc.allocator.release = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_ERROR_INVALID);
    desc.allocator = (trl_allocator){.release = whole.release, .user = whole.user};
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_ERROR_INVALID);
    desc.allocator = (trl_allocator){whole.allocate, NULL, whole.release, whole.user};
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_ERROR_INVALID);
}

// What the folders are under an environment. NULL leaves a variable unset.
struct environment {
    const char *data, *cache, *xdg, *home;
};

static void set_variable(const char *name, const char *value)
{
    if (value) {
        setenv(name, value, 1);
    } else {
        unsetenv(name);
    }
}

static void assert_folders(const struct environment *env, const char *data, const char *cache)
{
    set_variable("TERRELLA_DATA", env->data);
    set_variable("TERRELLA_CACHE", env->cache);
    set_variable("XDG_CACHE_HOME", env->xdg);
    set_variable("HOME", env->home);
    const trl_context_desc desc = trl_context_desc_default();
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    assert_string_equal(trl_context_data_dir(ctx), data);
    assert_string_equal(trl_context_cache_dir(ctx), cache);
    trl_context_destroy(&ctx);
}

static void folders_follow_the_environment(void **state)
{
    (void)state;
    assert_folders(&(struct environment){.home = "/h"}, "/h/.cache/terrella/data",
                   "/h/.cache/terrella/tables");
    assert_folders(&(struct environment){.home = "/h", .xdg = "/x"}, "/x/terrella/data",
                   "/x/terrella/tables");
    assert_folders(&(struct environment){.home = "/h", .xdg = ""}, "/h/.cache/terrella/data",
                   "/h/.cache/terrella/tables");
    assert_folders(&(struct environment){.home = "/h", .xdg = "/x", .data = "/d", .cache = "/c"},
                   "/d", "/c");
    assert_folders(&(struct environment){0}, "/tmp/.cache/terrella/data",
                   "/tmp/.cache/terrella/tables");
}

static void empty_variables_mean_default_data_and_no_cache(void **state)
{
    (void)state;
    assert_folders(&(struct environment){.xdg = "/x", .data = "", .cache = ""}, "/x/terrella/data",
                   "");
}

static void folders_of_the_desc_go_before_the_environment(void **state)
{
    set_variable("TERRELLA_DATA", "/d");
    set_variable("TERRELLA_CACHE", "/c");
    trl_context_desc desc = fixture_desc(*state);
    char data[] = "/mine";
    desc.data_dir = data;
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    data[0] = '?'; // the context has a copy
    assert_string_equal(trl_context_data_dir(ctx), "/mine");
    assert_string_equal(trl_context_cache_dir(ctx), "");
    trl_context_destroy(&ctx);
}

static void context_survives_every_failed_allocation(void **state)
{
    struct fixture *f = *state;
    const trl_context_desc desc = fixture_desc(f);
    const long before = f->live;
    trl_result result = TRL_ERROR_MEMORY;
    long n = 0;
    for (; result != TRL_OK && n < 100; n++) {
        trl_context *ctx = NULL;
        f->allocations_left = n;
        result = trl_context_create(&desc, &ctx);
        assert_true(result == TRL_OK || (result == TRL_ERROR_MEMORY && !ctx));
        trl_context_destroy(&ctx);
        assert_int_equal(f->live, before);
    }
    f->allocations_left = -1;
    assert_int_equal(result, TRL_OK);
    assert_int_equal(n, 4); // the context and its two strings fail, the fourth attempt succeeds
}

static void memory_is_zeroed_and_aligned(void **state)
{
    struct fixture *f = *state;
    static const size_t counts[] = {0, 1, 3, 64, 1000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        unsigned char *block = mem_alloc(f->ctx, counts[i], 7);
        assert_non_null(block);
        assert_int_equal((uintptr_t)block % 64, 0);
        for (size_t k = 0; k < counts[i] * 7; k++) {
            assert_int_equal(block[k], 0);
        }
        memset(block, 0xff, counts[i] * 7); // under ASan this shows that all of it is there
        mem_free(f->ctx, block);
    }
    mem_free(f->ctx, NULL);
}

static void sizes_that_overflow_are_refused(void **state)
{
    struct fixture *f = *state;
    const long before = f->live;
    assert_null(mem_alloc(f->ctx, SIZE_MAX / 2, 3));
    assert_null(mem_alloc(f->ctx, SIZE_MAX, 1));
    assert_null(mem_alloc(f->ctx, 1, SIZE_MAX - 64));
    assert_int_equal(f->messages, 3);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_MEMORY);
    assert_int_equal(f->live, before);
}

static void strings_that_find_no_memory_are_null(void **state)
{
    struct fixture *f = *state;
    f->allocations_left = 0;
    assert_null(mem_strdup(f->ctx, "x"));
    assert_null(mem_printf(f->ctx, "%d", 1));
    assert_int_equal(f->last_item, TRL_LOG_ITEM_MEMORY);
    f->allocations_left = -1;
    char *text = mem_printf(f->ctx, "%s-%03d", "a", 7);
    assert_string_equal(text, "a-007");
    mem_free(f->ctx, text);
}

static void messages_longer_than_the_buffer_are_cut(void **state)
{
    struct fixture *f = *state;
    char longer[5000];
    memset(longer, 'a', sizeof longer - 1);
    longer[sizeof longer - 1] = '\0';
    (void)trl_fail(f->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_SCENE, "%s", longer);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_SCENE);
    assert_int_equal(strlen(f->last_message), sizeof f->last_message - 1);
}

static bool stop_half_way(void *user, const char *stage, double fraction)
{
    (void)stage;
    *(double *)user = fraction;
    return fraction < 0.5;
}

static void progress_callback_cancels(void **state)
{
    struct fixture *f = *state;
    double seen = -1;
    trl_context_desc desc = fixture_desc(f);
    desc.progress = stop_half_way;
    desc.progress_user = &seen;
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    assert_int_equal(trl_progress(ctx, "solving", 0.25), TRL_OK);
    assert_int_equal(f->messages, 0);
    assert_int_equal(trl_progress(ctx, "solving", 0.75), TRL_ERROR_CANCELLED);
    assert_true(seen == 0.75);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_CANCELLED);
    trl_context_destroy(&ctx);
}

static void every_result_has_a_name_of_its_own(void **state)
{
    (void)state;
    for (int a = TRL_OK; a >= TRL_ERROR_CANCELLED; a--) {
        assert_string_not_equal(trl_result_name((trl_result)a), "unknown result");
        for (int b = TRL_OK; b > a; b--) {
            assert_string_not_equal(trl_result_name((trl_result)a), trl_result_name((trl_result)b));
        }
    }
    assert_string_equal(trl_result_name((trl_result)1), "unknown result");
}

static void version_is_the_headers(void **state)
{
    (void)state;
    char expected[32];
    snprintf(expected, sizeof expected, "%d.%d.%d", TRL_VERSION_MAJOR, TRL_VERSION_MINOR,
             TRL_VERSION_PATCH);
    assert_string_equal(trl_version(), expected);
}

int main(void)
{
#define WITH_FIXTURE(test) cmocka_unit_test_setup_teardown(test, fixture_set_up, fixture_tear_down)
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(default_desc_makes_a_silent_context),
        cmocka_unit_test(desc_without_canary_is_refused),
        WITH_FIXTURE(part_of_an_allocator_is_refused),
        cmocka_unit_test(folders_follow_the_environment),
        cmocka_unit_test(empty_variables_mean_default_data_and_no_cache),
        WITH_FIXTURE(folders_of_the_desc_go_before_the_environment),
        WITH_FIXTURE(context_survives_every_failed_allocation),
        WITH_FIXTURE(memory_is_zeroed_and_aligned),
        WITH_FIXTURE(sizes_that_overflow_are_refused),
        WITH_FIXTURE(strings_that_find_no_memory_are_null),
        WITH_FIXTURE(messages_longer_than_the_buffer_are_cut),
        WITH_FIXTURE(progress_callback_cancels),
        cmocka_unit_test(every_result_has_a_name_of_its_own),
        cmocka_unit_test(version_is_the_headers),
    };
#undef WITH_FIXTURE
    return cmocka_run_group_tests(tests, NULL, NULL);
}
