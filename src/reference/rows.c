// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/rows.h"

#include <omp.h>

trl_result reference_rows(const trl_context *ctx, const char *stage, uint32_t rows,
                          void (*work)(void *user, uint32_t row), void *user)
{
    trl_result result = TRL_OK; // written by the calling thread, and read at the end
    bool is_stopped = false;
    uint32_t rows_done = 0;
#pragma omp parallel for schedule(dynamic)
    for (uint32_t row = 0; row < rows; row++) {
        bool skips;
#pragma omp atomic read
        skips = is_stopped;
        if (!skips) {
            work(user, row);
        }
        uint32_t done;
#pragma omp atomic capture
        done = ++rows_done;
        if (omp_get_thread_num() == 0 && !skips) {
            result = trl_progress(ctx, stage, (double)done / rows);
#pragma omp atomic write
            is_stopped = result != TRL_OK;
        }
    }
    return result;
}
