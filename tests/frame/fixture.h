// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_FRAME_FIXTURE_H
#define TESTS_FRAME_FIXTURE_H
// A headless GPU, synthetic radiance and the log, for the tests of the frame.

#include "gpu/target.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

struct fixture {
    trl_context *ctx;
    struct gpu *gpu; // NULL until fixture_set_up_gpu
    int errors;
    trl_log_item last_item;
    char last_error[1024];
};

// Context and log only; for tests that bring their own GL.
int fixture_set_up(void **state);
// And a GPU. The test ends with 77 (skipped) where there is no GL, unless TRL_REQUIRE_GPU=1.
int fixture_set_up_gpu(void **state);
// Fails when errors were logged that no test expected, or GPU objects are left.
int fixture_tear_down(void **state);

// Ends the test with 77 if `result` says that there is no GL, see above.
void fixture_skip_without_gl(const struct fixture *f, trl_result result);

// That the call failed so, with one error logged, and forgets it.
void fixture_expect_error(struct fixture *f, trl_result got, trl_result wanted, trl_log_item item);

// What a synthetic picture shows at a pixel, from the lower left: linear sRGB in cd m^-2.
struct color {
    float r, g, b;
};
typedef struct color (*picture_fn)(uint32_t x, uint32_t y, const void *user);

// A radiance texture (RGBA32F) painted by the function.
struct gpu_texture fixture_paint(struct fixture *f, uint32_t width, uint32_t height,
                                 picture_fn paint, const void *user);

#endif // TESTS_FRAME_FIXTURE_H
