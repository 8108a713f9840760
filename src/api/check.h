// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef API_CHECK_H
#define API_CHECK_H
// Callers' mistakes: found before anything is done, told in one line, returned as
// TRL_ERROR_INVALID.

#include "base/context.h"
#include <terrella/scene.h>

// Returns from the public function that it stands in unless `condition` holds.
#define TRL_REQUIRE(ctx, condition)                                                                \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            return trl_fail(ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT, "%s: needs %s",         \
                            __func__, #condition);                                                 \
        }                                                                                          \
    } while (false)

// Of the path tracers, for each number.
#define CHECK_MAX_PATHS UINT64_C(1000000000000)

// That every number of a view is finite and in range for the scene's planet and bodies, and every
// choice known.
TRL_MUST_USE trl_result check_view(const trl_context *ctx, const trl_view *view,
                                   const trl_scene *scene);

// That a picture of this size can be drawn.
TRL_MUST_USE trl_result check_size(const trl_context *ctx, uint32_t width, uint32_t height);

#endif // API_CHECK_H
