// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A scene when the n-th allocation fails, for every n: an error each time, nothing lost, then
// success.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#include "sample.h"

struct meter {
    long live;
    long left; // allocations that still succeed; < 0: all
};

static void *meter_allocate(void *user, size_t bytes)
{
    struct meter *meter = user;
    if (meter->left == 0) {
        return NULL;
    }
    meter->left -= meter->left > 0;
    meter->live++;
    return malloc(bytes);
}

static void *meter_reallocate(void *user, void *block, size_t bytes)
{
    if (!block) {
        return meter_allocate(user, bytes);
    }
    return ((struct meter *)user)->left == 0 ? NULL : realloc(block, bytes);
}

static void meter_release(void *user, void *block)
{
    ((struct meter *)user)->live -= block != NULL;
    free(block);
}

static void assert_survives(const char *from, const char *to)
{
    struct meter meter = {.left = -1};
    trl_context_desc desc = trl_context_desc_default();
    desc.allocator = (trl_allocator){meter_allocate, meter_reallocate, meter_release, &meter};
    trl_context *ctx = NULL;
    assert_int_equal(trl_context_create(&desc, &ctx), TRL_OK);
    const long before = meter.live;
    char *text = sample_replace(from, to);
    assert_non_null(text);
    trl_result result = TRL_ERROR_MEMORY;
    long n = 0;
    for (; result != TRL_OK && n < 1000; n++) {
        trl_scene *scene = NULL;
        meter.left = n;
        result = trl_scene_parse(ctx, text, strlen(text), "t", ".", &scene);
        meter.left = -1;
        assert_true(result == TRL_OK || (result == TRL_ERROR_MEMORY && !scene));
        trl_scene_destroy(&scene);
        assert_int_equal(meter.live, before);
    }
    assert_int_equal(result, TRL_OK);
    assert_true(n > 8); // scene, names, tables, paths: there was something to fail
    free(text);
    trl_context_destroy(&ctx);
    assert_int_equal(meter.live, 0);
}

static void scene_survives_every_failed_allocation(void **state)
{
    (void)state;
    assert_survives("1e-5, \"absorption_per_m\": 0",
                    "[[500, 1e-5], [600, 2e-5]], \"absorption_per_m\": [[500, 0]]");
}

static void spheres_survive_every_failed_allocation(void **state)
{
    (void)state;
    assert_survives(SAMPLE_AIR, SAMPLE_SPHERES);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scene_survives_every_failed_allocation),
        cmocka_unit_test(spheres_survive_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
