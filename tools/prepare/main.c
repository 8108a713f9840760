// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// prepare-data SOURCE_DIR OUT_DIR [BODY]: makes the rasters of Earth from unpacked packages, or
// those of another body from files as its archive has them. tools/fetch-data.sh calls it;
// docs/data.md says what it reads and writes.
#include "prepare.h"

#include "base/file.h"

#include <stdio.h>
#include <string.h>

static trl_result prepare_earth(const struct places *places)
{
    struct picture snow = {0};
    trl_result result = earth_prepare_pictures(places, &snow);
    if (result == TRL_OK) {
        result = earth_prepare_colorado(places);
    }
    if (result == TRL_OK) {
        result = earth_prepare_globe(places, &snow);
    }
    picture_finish(places, &snow);
    return result;
}

static const struct body {
    const char *name;
    trl_result (*prepare)(const struct places *places);
} BODIES[] = {{"earth", prepare_earth}, {"earth-insets", earth_prepare_insets},
              {"mars", mars_prepare},   {"moon", moon_prepare},
              {"titan", titan_prepare}, {"venus", venus_prepare}};

static const struct body *find_body(const char *name)
{
    for (size_t i = 0; i < sizeof BODIES / sizeof BODIES[0]; i++) {
        if (strcmp(BODIES[i].name, name) == 0) {
            return &BODIES[i];
        }
    }
    return NULL;
}

int main(int argc, char **argv)
{
    const struct body *body = find_body(argc == 4 ? argv[3] : "earth");
    if (argc < 3 || argc > 4 || !body) {
        fprintf(stderr, "usage: prepare-data SOURCE_DIR OUT_DIR "
                        "[earth|earth-insets|mars|moon|titan|venus]\n");
        return 2;
    }
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx = NULL;
    trl_result result = trl_context_create(&desc, &ctx);
    if (result == TRL_OK) {
        const struct places places = {ctx, argv[1], argv[2]};
        result = file_make_dirs(ctx, places.out_dir);
        if (result == TRL_OK) {
            result = body->prepare(&places);
        }
    }
    trl_context_destroy(&ctx);
    return result == TRL_OK ? 0 : 1;
}
