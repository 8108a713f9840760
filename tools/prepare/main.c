// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// prepare-data SOURCE_DIR OUT_DIR: makes the rasters of Earth from unpacked packages.
// tools/fetch-data.sh calls it; docs/data.md says what it reads and writes.
#include "prepare.h"

#include "base/file.h"

#include <stdio.h>

static trl_result prepare_all(const struct places *places)
{
    trl_result result = file_make_dirs(places->ctx, places->out_dir);
    if (result == TRL_OK) {
        result = earth_prepare_pictures(places);
    }
    if (result == TRL_OK) {
        result = earth_prepare_colorado(places);
    }
    return result == TRL_OK ? earth_prepare_globe(places) : result;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: prepare-data SOURCE_DIR OUT_DIR\n");
        return 2;
    }
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx = NULL;
    trl_result result = trl_context_create(&desc, &ctx);
    if (result == TRL_OK) {
        const struct places places = {ctx, argv[1], argv[2]};
        result = prepare_all(&places);
    }
    trl_context_destroy(&ctx);
    return result == TRL_OK ? 0 : 1;
}
