// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_RESOLVER_H
#define SCATTER_RESOLVER_H
// Solves an atmosphere on a thread of its own while pictures go on: a draft at once, the fine one
// after it, or only that where the cache has it.

#include "scatter/atmosphere.h"

struct resolver;

// Copies the medium; its numbers have been checked. `desc` is of the fine one. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result resolver_start(const trl_context *ctx, const struct medium *medium,
                                       const struct atmosphere_desc *desc, struct resolver **out);

// What has been solved since it was last asked, or NULL. The caller owns it.
struct atmosphere *resolver_take(struct resolver *resolver);

// Nothing more will come: solved, or failed with the reason in the log.
bool resolver_is_done(struct resolver *resolver);

// Stops the work, which takes some milliseconds, and frees all that nobody took. *resolver may be
// NULL.
void resolver_destroy(struct resolver **resolver);

#endif // SCATTER_RESOLVER_H
