// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_PHYSICS_CONTEXT_H
#define TESTS_PHYSICS_CONTEXT_H
// A context without a cache as the state of a group of tests.

#include "base/context.h"

static inline int make_context(void **state)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.cache_dir = "";
    return trl_context_create(&desc, (trl_context **)state) == TRL_OK ? 0 : -1;
}

static inline int drop_context(void **state)
{
    trl_context_destroy((trl_context **)state);
    return 0;
}

#endif // TESTS_PHYSICS_CONTEXT_H
