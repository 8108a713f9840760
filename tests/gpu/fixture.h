// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_GPU_FIXTURE_H
#define TESTS_GPU_FIXTURE_H
// A headless GPU and the last error of the log, for the tests of the GL layer.

#include "gpu/pass.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

struct fixture {
    trl_context *ctx;
    struct gpu *gpu;
    int errors, warnings;
    trl_log_item last_item;
    char last_error[1024];
    // A target of 4 x 4 RGBA32F texels with depth, for what draws.
    struct gpu_texture color, depth;
    struct gpu_target target;
};

// cmocka's group functions. The test ends with 77 (skipped) where there is no GL, unless the
// environment has TRL_REQUIRE_GPU=1, as CI does.
int fixture_set_up(void **state);
int fixture_tear_down(void **state);

// The texel at (x, y) of a float texture of four channels.
struct texel {
    float rgba[4];
};
struct texel fixture_read(const struct gpu_texture *texture, uint32_t x, uint32_t y);

// That the call failed so, with one error logged, and forgets it.
void fixture_expect_error(struct fixture *f, trl_result got, trl_result wanted, trl_log_item item);

#endif // TESTS_GPU_FIXTURE_H
