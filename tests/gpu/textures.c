// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// What goes into a texture comes out of it.
#include "fixture.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 5, HEIGHT = 3, DEPTH = 4, TEXELS = WIDTH * HEIGHT * DEPTH };

// Values that every format of its kind holds exactly: bytes, small integers, dyadic fractions in
// [0, 1].
static void fill(enum gpu_format format, size_t texels, void *data)
{
    const size_t count = texels * gpu_format_channels(format);
    const size_t size = gpu_format_texel_bytes(format) / gpu_format_channels(format);
    for (size_t i = 0; i < count; i++) {
        if (size == 1) {
            ((uint8_t *)data)[i] = (uint8_t)(i * 37 + 11);
        } else if (size == 2) {
            ((int16_t *)data)[i] = (int16_t)(i * 1000 - 30000);
        } else {
            ((float *)data)[i] = (float)(i % 64) / 64;
        }
    }
}

static struct gpu_texture_desc describe(enum gpu_format format, enum gpu_shape shape)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = gpu_format_name(format);
    desc.shape = shape;
    desc.format = format;
    desc.width = WIDTH;
    desc.height = HEIGHT;
    desc.depth = shape == GPU_SHAPE_2D ? 1 : DEPTH;
    desc.filter = GPU_FILTER_NEAREST;
    return desc;
}

static void check_round_trip(struct fixture *f, enum gpu_format format, enum gpu_shape shape)
{
    float given[TEXELS * 4] = {0}, got[TEXELS * 4] = {0};
    struct gpu_texture_desc desc = describe(format, shape);
    const size_t texels = (size_t)WIDTH * HEIGHT * desc.depth;
    fill(format, texels, given);
    desc.data = given;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    const struct gpu_region all = gpu_texture_region(&texture, 0);
    const trl_result result = gpu_texture_read(&texture, &all, got);
    if (format == GPU_FORMAT_DEPTH32F && f->gpu->caps.is_es) {
        fixture_expect_error(f, result, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_OBJECT);
    } else {
        assert_int_equal(result, TRL_OK);
        assert_memory_equal(given, got, texels * gpu_format_texel_bytes(format));
    }
    gpu_texture_finish(&texture);
}

static void expect_refused(struct fixture *f, const struct gpu_texture_desc *desc, trl_result why)
{
    struct gpu_texture texture;
    fixture_expect_error(f, gpu_texture_init(f->gpu, desc, &texture), why, TRL_LOG_ITEM_GPU_OBJECT);
    assert_null(texture.gpu);
    gpu_texture_finish(&texture);
}

static void every_format_and_shape_round_trips(void **state)
{
    struct fixture *f = *state;
    for (int format = 0; format < GPU_FORMAT_COUNT; format++) {
        if (format == GPU_FORMAT_R16 && !f->gpu->caps.has_norm16) {
            const struct gpu_texture_desc desc = describe(GPU_FORMAT_R16, GPU_SHAPE_2D);
            expect_refused(f, &desc, TRL_ERROR_UNSUPPORTED);
            continue;
        }
        check_round_trip(f, (enum gpu_format)format, GPU_SHAPE_2D);
        if (format != GPU_FORMAT_DEPTH32F) {
            check_round_trip(f, (enum gpu_format)format, GPU_SHAPE_3D);
            check_round_trip(f, (enum gpu_format)format, GPU_SHAPE_2D_ARRAY);
        }
    }
}

static void part_of_a_volume_is_replaced(void **state)
{
    struct fixture *f = *state;
    float given[TEXELS], got[TEXELS];
    fill(GPU_FORMAT_R32F, TEXELS, given);
    struct gpu_texture_desc desc = describe(GPU_FORMAT_R32F, GPU_SHAPE_3D);
    desc.data = given;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    const float patch[4] = {7, 8, 9, 10};
    const struct gpu_region part = {0, 2, 1, 3, 2, 2, 1};
    assert_int_equal(gpu_texture_upload(&texture, &part, patch), TRL_OK);
    for (uint32_t y = 0; y < 2; y++) {
        memcpy(&given[(3 * HEIGHT + 1 + y) * WIDTH + 2], &patch[2 * y], 2 * sizeof *patch);
    }
    const struct gpu_region all = gpu_texture_region(&texture, 0);
    assert_int_equal(gpu_texture_read(&texture, &all, got), TRL_OK);
    assert_memory_equal(given, got, sizeof got);
    const struct gpu_region outside = {0, 4, 1, 3, 2, 2, 1};
    fixture_expect_error(f, gpu_texture_upload(&texture, &outside, patch), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    const struct gpu_region no_level = {1, 0, 0, 0, 1, 1, 1};
    fixture_expect_error(f, gpu_texture_read(&texture, &no_level, got), TRL_ERROR_INVALID,
                         TRL_LOG_ITEM_GPU_OBJECT);
    gpu_texture_finish(&texture);
}

static void mips_are_means(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = describe(GPU_FORMAT_RGBA16F, GPU_SHAPE_2D);
    float texels[8 * 4 * 4] = {0}, got[4] = {0};
    for (size_t i = 0; i < 8 * 4; i++) {
        texels[4 * i] = i % 2 == 0 ? 1 : 3;
    }
    desc.width = 8;
    desc.height = 4;
    desc.levels = 0;
    desc.filter = GPU_FILTER_TRILINEAR;
    desc.anisotropy = 4;
    desc.data = texels;
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    assert_int_equal(texture.levels, 4);
    assert_int_equal(gpu_texture_make_mips(&texture), TRL_OK);
    const struct gpu_region last = gpu_texture_region(&texture, 3);
    assert_int_equal(last.width * last.height * last.depth, 1);
    assert_int_equal(gpu_texture_read(&texture, &last, got), TRL_OK);
    assert_true(fabsf(got[0] - 2) < 1e-3f); // half floats near 2 are 2^-10 apart
    gpu_texture_finish(&texture);
}

static void wrong_descriptions_are_refused(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = describe(GPU_FORMAT_R8, GPU_SHAPE_2D);
    desc.width = 0;
    expect_refused(f, &desc, TRL_ERROR_INVALID);
    desc.width = f->gpu->caps.max_texture_size + 1;
    expect_refused(f, &desc, TRL_ERROR_INVALID);
    desc.width = WIDTH;
    desc.depth = 2;
    expect_refused(f, &desc, TRL_ERROR_INVALID);
    desc = describe(GPU_FORMAT_R8, GPU_SHAPE_3D);
    desc.depth = f->gpu->caps.max_3d_size + 1;
    expect_refused(f, &desc, TRL_ERROR_INVALID);
    desc = describe(GPU_FORMAT_R16I, GPU_SHAPE_2D);
    desc.filter = GPU_FILTER_LINEAR;
    expect_refused(f, &desc, TRL_ERROR_INVALID);
    desc = describe(GPU_FORMAT_RGBA8, GPU_SHAPE_2D);
    desc.levels = 9;
    expect_refused(f, &desc, TRL_ERROR_INVALID);
    desc = describe(GPU_FORMAT_DEPTH32F, GPU_SHAPE_2D_ARRAY);
    expect_refused(f, &desc, TRL_ERROR_INVALID);
}

static void float_filtering_follows_the_capability(void **state)
{
    struct fixture *f = *state;
    struct gpu_texture_desc desc = describe(GPU_FORMAT_R32F, GPU_SHAPE_2D);
    desc.filter = GPU_FILTER_LINEAR;
    if (!f->gpu->caps.has_float_linear) {
        expect_refused(f, &desc, TRL_ERROR_UNSUPPORTED);
        return;
    }
    struct gpu_texture texture;
    assert_int_equal(gpu_texture_init(f->gpu, &desc, &texture), TRL_OK);
    gpu_texture_finish(&texture);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_format_and_shape_round_trips),
        cmocka_unit_test(part_of_a_volume_is_replaced),
        cmocka_unit_test(mips_are_means),
        cmocka_unit_test(wrong_descriptions_are_refused),
        cmocka_unit_test(float_filtering_follows_the_capability),
    };
    return cmocka_run_group_tests(tests, fixture_set_up, fixture_tear_down);
}
