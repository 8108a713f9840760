// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TESTS_IMAGE_SEA_SCENE_H
#define TESTS_IMAGE_SEA_SCENE_H
// A globe of water under clear air, with a context, in a folder of its own.

#include <terrella/terrella.h>

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

struct sea_scene {
    trl_context *ctx;
    char folder[64];
};

static const char sea_scene_format[] =
    "{\"terrella\": 1, \"name\": \"sea\","
    " \"star\": {\"spectral_irradiance\": [[360, 1.1], [450, 1.9], [550, 1.85], [700, 1.4]]},"
    " \"planet\": {\"radius_m\": 6371000, \"ground_albedo\": 0.1},"
    " \"atmosphere\": {\"height_m\": 60000, \"constituents\": [{\"name\": \"air\","
    "  \"scattering_per_m\": [[360, 6.6e-5], [400, 4.3e-5], [450, 2.6e-5], [500, 1.7e-5],"
    "   [550, 1.15e-5], [600, 8.1e-6], [700, 4.3e-6], [830, 2.2e-6]],"
    "  \"profile\": {\"exponential\": {\"scale_height_m\": 8000}}, \"phase\": \"rayleigh\"}]},"
    " \"surface\": {\"layers\": [{\"elevation\": \"black.png\"}, {\"water\": \"white.png\"}]},"
    " \"ocean\": {\"waves\": {%s, \"whitecaps\": 0},"
    "  \"water\": {%s}, \"bed\": {\"albedo\": 0.4, \"depth_m\": %g}}}";

static inline void sea_scene_write(const struct sea_scene *s, const char *name, uint8_t value)
{
    uint8_t rgba[4 * 8 * 4];
    char path[128];
    memset(rgba, value, sizeof rgba);
    snprintf(path, sizeof path, "%s/%s", s->folder, name);
    assert_int_equal(trl_image_write_png(s->ctx, path, 8, 4, rgba), TRL_OK);
}

static inline void sea_scene_begin(struct sea_scene *s)
{
    snprintf(s->folder, sizeof s->folder, "/tmp/terrella-sea-XXXXXX");
    assert_non_null(mkdtemp(s->folder));
    trl_context_desc desc = trl_context_desc_default();
    desc.log = trl_log_stderr;
    desc.cache_dir = "";
    assert_int_equal(trl_context_create(&desc, &s->ctx), TRL_OK);
    sea_scene_write(s, "black.png", 0);
    sea_scene_write(s, "white.png", 255);
}

static inline void sea_scene_end(struct sea_scene *s)
{
    char path[128];
    snprintf(path, sizeof path, "%s/black.png", s->folder);
    unlink(path);
    snprintf(path, sizeof path, "%s/white.png", s->folder);
    unlink(path);
    rmdir(s->folder);
    trl_context_destroy(&s->ctx);
}

static inline trl_scene *sea_scene_make(const struct sea_scene *s, const char *waves,
                                        const char *water, double depth_m)
{
    char text[2048];
    const int length = snprintf(text, sizeof text, sea_scene_format, waves, water, depth_m);
    trl_scene *scene = NULL;
    assert_int_equal(trl_scene_parse(s->ctx, text, (size_t)length, "sea", s->folder, &scene),
                     TRL_OK);
    return scene;
}

#endif // TESTS_IMAGE_SEA_SCENE_H
