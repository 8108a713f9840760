// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Tone curves and the picture made with them: range, monotony, hue, gamut, dither.
#include "fixture.h"
#include "frame/tone.h"
#include "shared/tone.glsl"

#include <stdlib.h>

enum { SIDE = 64 };

static void curves_map_the_metered_mean_to_a_grey_card(void **state)
{
    (void)state;
    const double mean = 0.125 / 1.2; // constants of the curves have five digits
    assert_true(fabs(tone_filmic(mean) - 0.18) < 1e-5);
    assert_true(fabs(tone_exponential(mean) - 0.18) < 1e-5);
}

static void curves_rise_from_0_and_stay_below_1(void **state)
{
    (void)state;
    assert_true(tone_filmic(0) == 0 && tone_exponential(0) == 0 && tone_bleach(0) == 0);
    double filmic = 0, exponential = 0, bleach = 0;
    for (double stop = -20; stop < 4; stop += 0.05) {
        const double x = exp2(stop);
        assert_true(tone_filmic(x) > filmic && tone_filmic(x) < 1);
        assert_true(tone_exponential(x) > exponential && tone_exponential(x) < 1);
        assert_true(tone_bleach(x) > bleach && tone_bleach(x) < 1);
        filmic = tone_filmic(x);
        exponential = tone_exponential(x);
        bleach = tone_bleach(x);
    }
    assert_true(tone_filmic(1e9) <= 1 && tone_exponential(1e9) <= 1 && tone_bleach(1e9) <= 1);
}

static void codes_are_those_of_srgb(void **state)
{
    (void)state;
    assert_true(tone_srgb_encode(0) == 0);
    assert_true(fabs(tone_srgb_encode(1) - 1) < 1e-12);
    // IEC 61966-2-1: code 188 stands for 50.3 % of the light, code 118 for 18.1 %.
    assert_true(fabs(tone_srgb_encode(0.50289) * 255 - 188) < 0.01);
    assert_true(fabs(tone_srgb_encode(0.18116) * 255 - 118) < 0.01);
    // The two pieces meet within the rounding of the standard's constants.
    assert_true(fabs(tone_srgb_encode(0.0031308) - tone_srgb_encode(0.0031309)) < 2e-6);
}

// The picture (RGBA8, bottom row first) of a radiance with exposure factor 1. Free it.
static uint8_t *draw(struct fixture *f, const struct gpu_texture *radiance, trl_tone_curve curve)
{
    static const float factor[2] = {0, 1};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = GPU_FORMAT_RG32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.data = factor;
    struct gpu_texture exposure, picture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &exposure), TRL_OK);
    desc = gpu_texture_desc_default();
    desc.width = radiance->width;
    desc.height = radiance->height;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &picture), TRL_OK);
    const struct gpu_target_desc target_desc = {.color_count = 1, .colors[0].texture = &picture};
    struct gpu_target target;
    assert_int_equal(gpu_target_init(f->gpu, &target_desc, &target), TRL_OK);
    struct tone tone;
    assert_int_equal(tone_init(f->gpu, &tone), TRL_OK);
    const struct tone_source source = {radiance, &exposure, curve};
    assert_int_equal(tone_draw(&tone, &source, &target), TRL_OK);
    uint8_t *rgba = malloc((size_t)4 * desc.width * desc.height);
    assert_non_null(rgba);
    const struct gpu_rect all = {0, 0, desc.width, desc.height};
    assert_int_equal(gpu_target_read_rgba8(&target, all, rgba), TRL_OK);
    tone_finish(&tone);
    gpu_target_finish(&target);
    gpu_texture_finish(&picture);
    gpu_texture_finish(&exposure);
    return rgba;
}

struct mean {
    double r, g, b;
    int lowest, highest; // of any component
};

static struct mean find_mean(const uint8_t *rgba, size_t count)
{
    struct mean mean = {.lowest = 255};
    for (size_t i = 0; i < count; i++) {
        mean.r += rgba[4 * i] / (double)count;
        mean.g += rgba[4 * i + 1] / (double)count;
        mean.b += rgba[4 * i + 2] / (double)count;
        assert_int_equal(rgba[4 * i + 3], 255);
        for (size_t c = 0; c < 3; c++) {
            const int code = rgba[4 * i + c];
            mean.lowest = code < mean.lowest ? code : mean.lowest;
            mean.highest = code > mean.highest ? code : mean.highest;
        }
    }
    return mean;
}

static struct color paint_even(uint32_t x, uint32_t y, const void *user)
{
    (void)x;
    (void)y;
    return *(const struct color *)user;
}

static struct mean draw_even(struct fixture *f, struct color color, trl_tone_curve curve)
{
    struct gpu_texture radiance = fixture_paint(f, SIDE, SIDE, paint_even, &color);
    uint8_t *rgba = draw(f, &radiance, curve);
    const struct mean mean = find_mean(rgba, (size_t)SIDE * SIDE);
    free(rgba);
    gpu_texture_finish(&radiance);
    return mean;
}

static void dither_keeps_the_mean_of_what_c_calculates(void **state)
{
    // 4096 evenly spread thresholds; float against double in the curve.
    const double tolerance = 0.02;
    for (double stop = -9; stop < 3; stop += 0.77) {
        const float x = (float)exp2(stop);
        const struct color color = {x, x, x};
        const double norm = (double)x;
        const double filmic = 255 * tone_srgb_encode(tone_filmic(norm));
        const double exponential = 255 * tone_srgb_encode(tone_exponential(norm));
        assert_true(fabs(draw_even(*state, color, TRL_TONE_FILMIC).g - filmic) < tolerance);
        const struct mean mean = draw_even(*state, color, TRL_TONE_EXPONENTIAL);
        assert_true(fabs(mean.b - exponential) < tolerance);
        assert_true(mean.highest - mean.lowest <= 1); // never more than one step of noise
    }
}

static void black_stays_black_and_glare_white(void **state)
{
    const struct mean black = draw_even(*state, (struct color){0, 0, 0}, TRL_TONE_FILMIC);
    assert_int_equal(black.highest, 0);
    const struct mean glare = draw_even(*state, (struct color){1e8f, 6e7f, 1e7f}, TRL_TONE_FILMIC);
    assert_true(glare.b >
                254.98); // the curve stays below 1, so one threshold in thousands is missed
}

static void highlights_keep_their_hue_and_then_bleach(void **state)
{
    double last_blue_share = 0;
    for (double stop = -3; stop < 8; stop += 1) {
        const float x = (float)exp2(stop);
        const struct mean mean =
            draw_even(*state, (struct color){x, 0.5f * x, 0.1f * x}, TRL_TONE_FILMIC);
        assert_true(mean.r > mean.g && mean.g > mean.b);
        const double share = mean.b / mean.r;
        assert_true(stop < -2 || share > last_blue_share - 0.01); // dither's mean, see above
        last_blue_share = share;
    }
    // Below saturation light has the ratios of the scene: 0.1 of 0.18 is code 38.6.
    const float mean = 0.125f / 1.2f;
    const struct color middle = {mean, 0.5f * mean, 0.1f * mean};
    const double expected = 255 * tone_srgb_encode(0.18 * (0.1 + 0.9 * tone_bleach((double)mean)));
    assert_true(fabs(draw_even(*state, middle, TRL_TONE_FILMIC).b - expected) < 0.05);
}

static void colours_out_of_gamut_are_not_black(void **state)
{
    const struct mean cyan = draw_even(*state, (struct color){-0.1f, 0.5f, 0.4f}, TRL_TONE_FILMIC);
    assert_true(cyan.g > 100 && cyan.b > 80);
    const double bleached = tone_filmic(0.471) * tone_bleach(0.471); // 0.471: green mixed with grey
    assert_true(fabs(cyan.r - 255 * tone_srgb_encode(bleached)) < 0.2); // three digits of it
    const struct mean exponential =
        draw_even(*state, (struct color){-0.1f, 0.5f, 0.4f}, TRL_TONE_EXPONENTIAL);
    assert_true(exponential.r < 1 && exponential.g > 100 && exponential.b > 80);
    const struct mean nothing =
        draw_even(*state, (struct color){-1e-4f, -1e-4f, 1e-4f}, TRL_TONE_FILMIC);
    assert_int_equal(nothing.highest, 0);
}

static const uint32_t GRADIENT_WIDTH = 1024;

// Exposed light of a dark gradient over three codes, from 2 to 5: a night sky.
static double gradient_code(uint32_t x)
{
    return 2 + 3.0 * x / GRADIENT_WIDTH;
}

static struct color paint_gradient(uint32_t x, uint32_t y, const void *user)
{
    (void)y;
    (void)user;
    const double light = gradient_code(x) / 255 / 12.92; // the straight piece of sRGB
    const float exposed = (float)(-log(1 - light) / TONE_EXPONENTIAL_E);
    return (struct color){exposed, exposed, exposed};
}

static void dark_gradients_have_no_bands(void **state)
{
    struct gpu_texture radiance = fixture_paint(*state, GRADIENT_WIDTH, SIDE, paint_gradient, NULL);
    uint8_t *rgba = draw(*state, &radiance, TRL_TONE_EXPONENTIAL);
    for (uint32_t x = 0; x < GRADIENT_WIDTH; x += 16) {
        double mean = 0, wanted = 0;
        for (uint32_t i = 0; i < 16 * SIDE; i++) {
            const uint32_t at = x + i % 16;
            mean += rgba[4 * (at + i / 16 * GRADIENT_WIDTH)] / (16.0 * SIDE);
            wanted += gradient_code(at) / (16.0 * SIDE);
        }
        // Without dither the error reaches 0.5; 1024 evenly spread thresholds leave a tenth of
        // that.
        assert_true(fabs(mean - wanted) < 0.05);
    }
    free(rgba);
    gpu_texture_finish(&radiance);
}

static void the_same_radiance_gives_the_same_bytes(void **state)
{
    struct gpu_texture radiance = fixture_paint(*state, GRADIENT_WIDTH, SIDE, paint_gradient, NULL);
    uint8_t *first = draw(*state, &radiance, TRL_TONE_FILMIC);
    uint8_t *second = draw(*state, &radiance, TRL_TONE_FILMIC);
    assert_memory_equal(first, second, (size_t)4 * GRADIENT_WIDTH * SIDE);
    free(first);
    free(second);
    gpu_texture_finish(&radiance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_map_the_metered_mean_to_a_grey_card),
        cmocka_unit_test(curves_rise_from_0_and_stay_below_1),
        cmocka_unit_test(codes_are_those_of_srgb),
        cmocka_unit_test(dither_keeps_the_mean_of_what_c_calculates),
        cmocka_unit_test(black_stays_black_and_glare_white),
        cmocka_unit_test(highlights_keep_their_hue_and_then_bleach),
        cmocka_unit_test(colours_out_of_gamut_are_not_black),
        cmocka_unit_test(dark_gradients_have_no_bands),
        cmocka_unit_test(the_same_radiance_gives_the_same_bytes),
    };
    return cmocka_run_group_tests_name("tone", tests, fixture_set_up_gpu, fixture_tear_down);
}
