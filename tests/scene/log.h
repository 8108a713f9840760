// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TEST_SCENE_LOG_H
#define TEST_SCENE_LOG_H
// A context whose errors a test can look at, and the fixture that has one.

#include <stdio.h>
#include <terrella/context.h>

struct test_log {
    char error[2048]; // the last one
    size_t errors;
};

static inline void test_log_take(void *user, trl_log_level level, trl_log_item item,
                                 const char *message)
{
    struct test_log *log = user;
    (void)item;
    if (level == TRL_LOG_ERROR) {
        snprintf(log->error, sizeof log->error, "%s", message);
        log->errors++;
    }
}

static inline trl_context *test_context(struct test_log *log)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.log = test_log_take;
    desc.log_user = log;
    desc.data_dir = "/nonexistent/terrella-data";
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    return trl_context_create(&desc, &ctx) == TRL_OK ? ctx : NULL;
}

struct fixture {
    trl_context *ctx;
    struct test_log log;
};

static inline int make_fixture(void **state)
{
    static struct fixture f;
    f = (struct fixture){0};
    f.ctx = test_context(&f.log);
    *state = &f;
    return f.ctx == NULL;
}

static inline int free_fixture(void **state)
{
    struct fixture *f = *state;
    trl_context_destroy(&f->ctx);
    return 0;
}

#endif // TEST_SCENE_LOG_H
