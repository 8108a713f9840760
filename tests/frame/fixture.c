// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

// For all tests of the process: the air of a scene that several of them draw is solved once.
static char cache[] = "/tmp/terrella-frame-XXXXXX";

static void remove_cache(void)
{
    char command[sizeof cache + 16];
    snprintf(command, sizeof command, "rm -rf '%s'", cache);
    if (system(command)) {
        printf("%s is left\n", cache);
    }
}

static const char *find_cache(void)
{
    static bool is_there;
    if (!is_there && mkdtemp(cache) && atexit(remove_cache) == 0) {
        is_there = true;
    }
    return is_there ? cache : NULL;
}

static void receive(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    if (level == TRL_LOG_ERROR) {
        f->errors++;
        f->last_item = item;
        snprintf(f->last_error, sizeof f->last_error, "%s", message);
    }
}

int fixture_set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    *state = f;
    trl_context_desc desc = trl_context_desc_default();
    desc.log = receive;
    desc.log_user = f;
    desc.data_dir = "/nonexistent/terrella-data";
    desc.cache_dir = find_cache();
    return f && desc.cache_dir && trl_context_create(&desc, &f->ctx) == TRL_OK ? 0 : 1;
}

void fixture_skip_without_gl(const struct fixture *f, trl_result result)
{
    const char *required = getenv("TRL_REQUIRE_GPU");
    if (result == TRL_ERROR_UNSUPPORTED && !(required && strcmp(required, "1") == 0)) {
        printf("skipped: %s\n", f->last_error);
        exit(77);
    }
}

int fixture_set_up_gpu(void **state)
{
    if (fixture_set_up(state)) {
        return 1;
    }
    struct fixture *f = *state;
    const trl_result result = gpu_create_headless(f->ctx, &f->gpu);
    fixture_skip_without_gl(f, result);
    if (result != TRL_OK) {
        printf("%s\n", f->last_error);
    }
    return result == TRL_OK ? 0 : 1;
}

int fixture_tear_down(void **state)
{
    struct fixture *f = *state;
    const size_t left = f->gpu ? f->gpu->live_objects : 0;
    if (left || f->errors) {
        printf("%zu objects left, %d errors, the last: %s\n", left, f->errors, f->last_error);
    }
    const int status = left || f->errors ? 1 : 0;
    gpu_destroy(&f->gpu);
    trl_context_destroy(&f->ctx);
    free(f);
    return status;
}

void fixture_expect_error(struct fixture *f, trl_result got, trl_result wanted, trl_log_item item)
{
    assert_int_equal(got, wanted);
    assert_int_equal(f->errors, 1);
    assert_int_equal(f->last_item, item);
    f->errors = 0;
}

struct gpu_texture fixture_paint(struct fixture *f, uint32_t width, uint32_t height,
                                 picture_fn paint, const void *user)
{
    float *rgba = calloc((size_t)width * height, 4 * sizeof *rgba);
    assert_non_null(rgba);
    for (size_t i = 0; i < (size_t)width * height; i++) {
        const struct color color = paint((uint32_t)(i % width), (uint32_t)(i / width), user);
        memcpy(rgba + 4 * i, &color, sizeof color);
    }
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = width;
    desc.height = height;
    desc.data = rgba;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    free(rgba);
    return texture;
}
