// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The reader of spectra on any bytes: what it accepts is finite everywhere.

#include <math.h>
#include <stdlib.h>

#include "spectrum/spectrum_csv.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.data_dir = "/nonexistent";
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    if (trl_context_create(&desc, &ctx) != TRL_OK) {
        abort();
    }
    struct spectrum spectrum;
    if (spectrum_csv_parse(ctx, (const char *)data, size, "fuzz.csv", &spectrum) == TRL_OK) {
        for (double nm = 1; nm < 1e5; nm *= 1.5) {
            if (!isfinite(spectrum_at(&spectrum, nm))) {
                abort();
            }
        }
    }
    spectrum_finish(ctx, &spectrum);
    trl_context_destroy(&ctx);
    return 0;
}
