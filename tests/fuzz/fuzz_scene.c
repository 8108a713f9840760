// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The scene reader on any bytes: it reads a scene or says what is wrong, once.

#include <math.h>
#include <stdlib.h>
#include <terrella/scene.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void count_errors(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    (void)item;
    (void)message;
    *(size_t *)user += level == TRL_LOG_ERROR;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    size_t errors = 0;
    trl_context_desc desc = trl_context_desc_default();
    desc.log = count_errors;
    desc.log_user = &errors;
    desc.data_dir = "/nonexistent";
    desc.cache_dir = "";
    trl_context *ctx = NULL;
    trl_scene *scene = NULL;
    if (trl_context_create(&desc, &ctx) != TRL_OK) {
        abort();
    }
    const trl_result result =
        trl_scene_parse(ctx, (const char *)data, size, "fuzz.json", "/nonexistent", &scene);
    if ((result == TRL_OK) != (scene != NULL) || errors != (result != TRL_OK)) {
        abort();
    }
    if (scene && !(trl_scene_top_radius_m(scene) > trl_scene_ground_radius_m(scene) &&
                   isfinite(trl_scene_top_radius_m(scene)))) {
        abort();
    }
    trl_scene_destroy(&scene);
    trl_context_destroy(&ctx);
    return 0;
}
