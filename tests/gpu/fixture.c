// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fixture.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void receive(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    if (level == TRL_LOG_ERROR) {
        f->errors++;
        f->last_item = item;
        snprintf(f->last_error, sizeof f->last_error, "%s", message);
    }
    f->warnings += level == TRL_LOG_WARN;
}

static void skip_without_gl(trl_result result, const char *why)
{
    const char *required = getenv("TRL_REQUIRE_GPU");
    if (result == TRL_ERROR_UNSUPPORTED && !(required && strcmp(required, "1") == 0)) {
        printf("skipped: %s\n", why);
        exit(77);
    }
}

static trl_result make_target(struct fixture *f)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.width = desc.height = 4;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    trl_result result = gpu_texture_init(f->gpu, &desc, &f->color);
    desc.format = GPU_FORMAT_DEPTH32F;
    if (result == TRL_OK) {
        result = gpu_texture_init(f->gpu, &desc, &f->depth);
    }
    const struct gpu_target_desc target = {
        .color_count = 1, .colors[0].texture = &f->color, .depth.texture = &f->depth};
    return result == TRL_OK ? gpu_target_init(f->gpu, &target, &f->target) : result;
}

int fixture_set_up(void **state)
{
    setenv("TRL_SHADER_DIR", TEST_SHADER_DIR, 1);
    struct fixture *f = calloc(1, sizeof *f);
    *state = f;
    trl_context_desc desc = trl_context_desc_default();
    desc.log = receive;
    desc.log_user = f;
    if (!f || trl_context_create(&desc, &f->ctx) != TRL_OK) {
        return 1;
    }
    const trl_result result = gpu_create_headless(f->ctx, &f->gpu);
    skip_without_gl(result, f->last_error);
    if (result != TRL_OK || make_target(f) != TRL_OK) {
        printf("%s\n", f->last_error);
        return 1;
    }
    return 0;
}

int fixture_tear_down(void **state)
{
    struct fixture *f = *state;
    gpu_target_finish(&f->target);
    gpu_texture_finish(&f->color);
    gpu_texture_finish(&f->depth);
    const bool is_clean = !f->gpu || (f->gpu->live_objects == 0 && f->errors == 0);
    if (!is_clean) {
        printf("%zu objects left, %d errors, the last: %s\n", f->gpu->live_objects, f->errors,
               f->last_error);
    }
    gpu_destroy(&f->gpu);
    trl_context_destroy(&f->ctx);
    free(f);
    return is_clean ? 0 : 1;
}

struct texel fixture_read(const struct gpu_texture *texture, uint32_t x, uint32_t y)
{
    struct texel texel = {{0}};
    const struct gpu_region region = {0, x, y, 0, 1, 1, 1};
    assert_int_equal(gpu_texture_read(texture, &region, texel.rgba), TRL_OK);
    return texel;
}

void fixture_expect_error(struct fixture *f, trl_result got, trl_result wanted, trl_log_item item)
{
    assert_int_equal(got, wanted);
    assert_int_equal(f->errors, 1);
    assert_int_equal(f->last_item, item);
    f->errors = 0;
}
