// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_ROWS_H
#define REFERENCE_ROWS_H
// Long work on a picture, row by row on all cores.

#include "base/context.h"

#include <stdint.h>

// Calls `work` for each row, from many threads, and reports how far it is as `stage`.
// TRL_ERROR_CANCELLED: some rows were left out.
TRL_MUST_USE trl_result reference_rows(const trl_context *ctx, const char *stage, uint32_t rows,
                                       void (*work)(void *user, uint32_t row), void *user);

#endif // REFERENCE_ROWS_H
