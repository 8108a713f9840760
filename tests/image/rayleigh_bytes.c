// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The model rayleigh needs no float render target: under a star so dim that radiances lie between
// 0 and 1, it draws the same picture into bytes as into floats, to the step of a byte. Nothing of
// 32-bit floats is filtered, and no 16-bit norm is there, as in WebGL 2 without extensions.
#include "frame/daylight.h"
#include "scene/scene.h"
#include "sky/sky.h"
#include <terrella/context.h>

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 64, HEIGHT = 36, PIXELS = WIDTH * HEIGHT };

struct drawing {
    struct gpu_texture color, kinds;
    struct gpu_target target;
};

struct fixture {
    trl_context *ctx;
    trl_scene *scene;
    struct gpu *gpu;
    struct medium medium;
    struct drawing floats, bytes;
};

static void make_texture(struct fixture *f, enum gpu_format format, struct gpu_texture *out)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = format;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = WIDTH;
    desc.height = HEIGHT;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, out), TRL_OK);
}

static void make_drawing(struct fixture *f, enum gpu_format format, struct drawing *out)
{
    make_texture(f, format, &out->color);
    make_texture(f, GPU_FORMAT_DEPTH32F, &out->kinds);
    const struct gpu_target_desc target = {
        .color_count = 1, .colors[0].texture = &out->color, .depth.texture = &out->kinds};
    assert_int_equal(gpu_target_init(f->gpu, &target, &out->target), TRL_OK);
}

static void finish_drawing(struct drawing *drawing)
{
    gpu_target_finish(&drawing->target);
    gpu_texture_finish(&drawing->color);
    gpu_texture_finish(&drawing->kinds);
}

static int set_up(void **state)
{
    static struct fixture fixture;
    struct fixture *f = &fixture;
    *f = (struct fixture){0};
    trl_context_desc context = trl_context_desc_default();
    context.log = trl_log_stderr;
    context.cache_dir = "";
    assert_int_equal(trl_context_create(&context, &f->ctx), TRL_OK);
    assert_int_equal(trl_scene_load(f->ctx, SINGLE_FRAME_SCENE, &f->scene), TRL_OK);
    struct gpu_desc desc = gpu_desc_default();
    desc.is_es = true;
    desc.hidden_caps |= GPU_CAP_FLOAT_LINEAR | GPU_CAP_NORM16;
    assert_int_equal(gpu_create_headless_with(f->ctx, &desc, &f->gpu), TRL_OK);
    f->medium = f->scene->medium;
    f->medium.star_irradiance = (struct spectrum){
        .kind = SPECTRUM_BLACKBODY, .blackbody = {.temperature_K = 5772, .total_W_m2 = 1361}};
    // Bright air is about a third of a white wall.
    f->medium.star_irradiance.blackbody.total_W_m2 *= 2 / daylight_wall_cd_m2(&f->medium);
    make_drawing(f, GPU_FORMAT_RGBA32F, &f->floats);
    make_drawing(f, GPU_FORMAT_RGBA8, &f->bytes);
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    finish_drawing(&f->floats);
    finish_drawing(&f->bytes);
    gpu_destroy(&f->gpu);
    trl_scene_destroy(&f->scene);
    trl_context_destroy(&f->ctx);
    return 0;
}

// Over the equator, to the east along the star's plane, the horizon in the picture's lower half.
static struct camera make_camera(const struct fixture *f, double altitude_m)
{
    return (struct camera){.position_m = {f->medium.ground_radius_m + altitude_m, 0, 0},
                           .right = {0, 0, -1},
                           .up = {1, 0, 0},
                           .forward = {0, 1, 0},
                           .tan_half_fov_x = 0.8,
                           .tan_half_fov_y = 0.45,
                           .sun_direction = {0.5, 0, sqrt(0.75)}};
}

static void draw(struct sky *sky, const struct camera *camera, const struct drawing *drawing)
{
    const struct sky_view view = {.camera = camera, .target = &drawing->target};
    assert_int_equal(sky_prepare(sky, &view), TRL_OK);
    assert_int_equal(sky_draw(sky, &view), TRL_OK);
}

static void compare(struct fixture *f, const char *name)
{
    static float floats[PIXELS * 4];
    static uint8_t bytes[PIXELS * 4];
    const struct gpu_region all = gpu_texture_region(&f->floats.color, 0);
    assert_int_equal(gpu_texture_read(&f->floats.color, &all, floats), TRL_OK);
    const struct gpu_rect rect = {0, 0, WIDTH, HEIGHT};
    assert_int_equal(gpu_target_read_rgba8(&f->bytes.target, rect, bytes), TRL_OK);
    double worst = 0;
    double brightest = 0;
    for (int i = 0; i < PIXELS * 4; i++) {
        const double wanted = fmin(fmax((double)floats[i], 0), 1);
        worst = fmax(worst, fabs(bytes[i] / 255.0 - wanted));
        brightest = i % 4 < 3 ? fmax(brightest, wanted) : brightest;
    }
    printf("%s: brightest %.2f, farthest %.2f steps\n", name, brightest, worst * 255);
    assert_true(brightest > 0.1);
    assert_true(worst <= 0.51 / 255);
}

static void draws_into_bytes(void **state)
{
    struct fixture *f = *state;
    static const trl_rayleigh_depth KINDS[] = {TRL_RAYLEIGH_TEXTURE, TRL_RAYLEIGH_FIT};
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
        trl_rayleigh_desc options = trl_rayleigh_desc_default();
        options.optical_depth = KINDS[k];
        const struct sky_desc desc = {.gpu = f->gpu, .medium = &f->medium, .rayleigh = &options};
        struct sky sky;
        assert_int_equal(sky_init(&desc, TRL_SKY_RAYLEIGH, &sky), TRL_OK);
        for (int altitude_km = 1; altitude_km < 1000; altitude_km *= 20) {
            const struct camera camera = make_camera(f, 1e3 * altitude_km);
            draw(&sky, &camera, &f->floats);
            draw(&sky, &camera, &f->bytes);
            compare(f, KINDS[k] == TRL_RAYLEIGH_FIT ? "fit" : "texture");
        }
        sky_finish(&sky);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(draws_into_bytes)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
