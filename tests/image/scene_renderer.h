// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_IMAGE_SCENE_RENDERER_H
#define TESTS_IMAGE_SCENE_RENDERER_H
// A scene with a renderer of it, without a cache, as the state of a group of tests.

#include <terrella/terrella.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
    trl_renderer *renderer;
};

static inline void scene_renderer_make(const char *path, struct fixture *f)
{
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, path, &f->scene), TRL_OK);
    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = f->scene;
    assert_int_equal(trl_renderer_create(f->ctx, &desc, &f->renderer), TRL_OK);
}

static inline int scene_renderer_tear_down(void **state)
{
    struct fixture *f = *state;
    trl_renderer_destroy(&f->renderer);
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    return 0;
}

#endif // TESTS_IMAGE_SCENE_RENDERER_H
