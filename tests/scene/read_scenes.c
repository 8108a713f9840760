// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Prints one line for each scene file of the command line: "ok", or what is wrong with it. Rasters
// may be behind a network, as far as a scene's words go; nothing is fetched here.

#include <stdio.h>
#include <terrella/scene.h>

static void print_error(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    (void)user;
    (void)item;
    if (level == TRL_LOG_ERROR) {
        printf("%s\n", message);
    }
}

int main(int argc, char **argv)
{
    trl_context_desc desc = trl_context_desc_default();
    desc.log = print_error;
    desc.allows_remote = true;
    trl_context *ctx = NULL;
    if (trl_context_create(&desc, &ctx) != TRL_OK) {
        return 1;
    }
    for (int i = 1; i < argc; i++) {
        trl_scene *scene = NULL;
        if (trl_scene_load(ctx, argv[i], &scene) == TRL_OK) {
            printf("ok\n");
        }
        trl_scene_destroy(&scene);
    }
    trl_context_destroy(&ctx);
    return 0;
}
