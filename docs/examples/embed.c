// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A program of one's own: draws the first view of a scene, with the sun low in the west.
//
//     embed SCENE.json PICTURE.png
#include <terrella/terrella.h>

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 180 };

static trl_result draw(trl_context *ctx, const trl_scene *scene, const char *picture)
{
    trl_view view;
    trl_result result = trl_scene_view(scene, NULL, &view);
    if (result != TRL_OK) {
        return result;
    }
    view.sun_mode = TRL_SUN_LOCAL;
    view.sun_latitude_or_elevation_rad = 0.1;
    view.sun_longitude_or_azimuth_rad = 4.7;

    trl_renderer_desc desc = trl_renderer_desc_default();
    desc.scene = scene;
    trl_renderer *renderer = NULL;
    uint8_t *pixels = malloc((size_t)WIDTH * HEIGHT * 4);
    result = pixels ? trl_renderer_create(ctx, &desc, &renderer) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = trl_renderer_draw(renderer, &view, WIDTH, HEIGHT, 0.0);
    }
    if (result == TRL_OK) {
        result = trl_renderer_read_rgba8(renderer, pixels);
    }
    if (result == TRL_OK) {
        result = trl_image_write_png(ctx, picture, WIDTH, HEIGHT, pixels);
    }
    trl_renderer_destroy(&renderer);
    free(pixels);
    return result;
}

int main(int argc, char **argv)
{
    if (argc != 3) {
        fprintf(stderr, "usage: embed SCENE.json PICTURE.png\n");
        return 2;
    }
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    trl_context *ctx = NULL;
    trl_scene *scene = NULL;
    trl_result result = trl_context_create(&desc, &ctx);
    if (result == TRL_OK) {
        result = trl_scene_load(ctx, argv[1], &scene);
    }
    if (result == TRL_OK) {
        result = draw(ctx, scene, argv[2]);
    }
    trl_scene_destroy(&scene);
    trl_context_destroy(&ctx);
    return result == TRL_OK ? 0 : 1;
}
