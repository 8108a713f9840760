// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pictures written to files are read back by the formats' own libraries.
#include <terrella/image.h>

#include <dirent.h>
#include <openexr.h>
#include <png.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmocka.h>

// Odd sizes; more than two ZIP chunks of 16 rows, the last one not full.
enum { WIDTH = 37, HEIGHT = 41, PATH_BYTES = 256 };

struct fixture {
    trl_context *ctx;
    char dir[64];
    int errors;
    trl_log_item last_item;
};

static void count_errors(void *user, trl_log_level level, trl_log_item item, const char *message)
{
    struct fixture *f = user;
    (void)message;
    f->errors += level == TRL_LOG_ERROR;
    f->last_item = item;
}

static int set_up(void **state)
{
    struct fixture *f = calloc(1, sizeof *f);
    strcpy(f->dir, "/tmp/terrella-image-XXXXXX");
    trl_context_desc desc = trl_context_desc_default();
    desc.log = count_errors;
    desc.log_user = f;
    *state = f;
    return mkdtemp(f->dir) && trl_context_create(&desc, &f->ctx) == TRL_OK ? 0 : 1;
}

// Files in the test's folder; removes them.
static int sweep(const struct fixture *f)
{
    int count = 0;
    DIR *dir = opendir(f->dir);
    for (struct dirent *entry; (entry = readdir(dir)) != NULL;) {
        if (entry->d_name[0] != '.') {
            char path[2 * PATH_BYTES];
            snprintf(path, sizeof path, "%s/%s", f->dir, entry->d_name);
            unlink(path);
            count++;
        }
    }
    closedir(dir);
    return count;
}

static int tear_down(void **state)
{
    struct fixture *f = *state;
    sweep(f);
    rmdir(f->dir);
    trl_context_destroy(&f->ctx);
    free(f);
    return 0;
}

static const char *place(const struct fixture *f, const char *name, char path[PATH_BYTES])
{
    snprintf(path, PATH_BYTES, "%s/%s", f->dir, name);
    return path;
}

// Noise, which does not get smaller by compression.
static uint8_t *make_bytes(void)
{
    uint8_t *rgba = malloc(WIDTH * HEIGHT * 4);
    uint32_t noise = 1;
    for (size_t i = 0; i < WIDTH * HEIGHT * 4; i++) {
        noise ^= noise << 13;
        noise ^= noise >> 17;
        noise ^= noise << 5;
        rgba[i] = (uint8_t)(noise >> 11);
    }
    return rgba;
}

// Values over the range of a day's and a night's luminance, and some that only a float holds
// exactly.
static float *make_floats(void)
{
    float *rgba = malloc(WIDTH * HEIGHT * 4 * sizeof *rgba);
    for (size_t i = 0; i < WIDTH * HEIGHT * 4; i++) {
        rgba[i] = 1e-6f * (float)(i + 1) * (float)(1 << i % 31);
    }
    return rgba;
}

static void png_has_the_colours_and_no_alpha(void **state)
{
    struct fixture *f = *state;
    char path[PATH_BYTES];
    uint8_t *rgba = make_bytes();
    assert_int_equal(trl_image_write_png(f->ctx, place(f, "a.png", path), WIDTH, HEIGHT, rgba),
                     TRL_OK);
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, path));
    assert_int_equal(image.width, WIDTH);
    assert_int_equal(image.height, HEIGHT);
    assert_int_equal(image.format & PNG_FORMAT_FLAG_ALPHA, 0);
    image.format = PNG_FORMAT_RGB;
    uint8_t *rgb = malloc(PNG_IMAGE_SIZE(image));
    assert_true(png_image_finish_read(&image, NULL, rgb, 0, NULL));
    for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
        assert_memory_equal(rgb + 3 * i, rgba + 4 * i, 3);
    }
    free(rgb);
    free(rgba);
    assert_int_equal(sweep(f), 1);
}

// One channel of the whole file, by the C core's decoder.
static void read_exr_channel(exr_context_t exr, int channel, float *values)
{
    exr_decode_pipeline_t decoder = EXR_DECODE_PIPELINE_INITIALIZER;
    int32_t rows = 0;
    assert_int_equal(exr_get_scanlines_per_chunk(exr, 0, &rows), EXR_ERR_SUCCESS);
    assert_int_equal(rows, 16); // ZIP
    for (int32_t y = 0; y < HEIGHT; y += rows) {
        exr_chunk_info_t chunk;
        assert_int_equal(exr_read_scanline_chunk_info(exr, 0, y, &chunk), EXR_ERR_SUCCESS);
        assert_int_equal(y == 0 ? exr_decoding_initialize(exr, 0, &chunk, &decoder)
                                : exr_decoding_update(exr, 0, &chunk, &decoder),
                         EXR_ERR_SUCCESS);
        assert_int_equal(decoder.channel_count, 3);
        for (int i = 0; i < 3; i++) {
            assert_int_equal(decoder.channels[i].data_type, EXR_PIXEL_FLOAT);
            decoder.channels[i].decode_to_ptr =
                i == channel ? (uint8_t *)(values + (size_t)y * WIDTH) : NULL;
            decoder.channels[i].user_bytes_per_element = sizeof(float);
            decoder.channels[i].user_data_type = EXR_PIXEL_FLOAT;
            decoder.channels[i].user_pixel_stride = sizeof(float);
            decoder.channels[i].user_line_stride = WIDTH * sizeof(float);
        }
        if (y == 0) {
            assert_int_equal(exr_decoding_choose_default_routines(exr, 0, &decoder),
                             EXR_ERR_SUCCESS);
        }
        assert_int_equal(exr_decoding_run(exr, 0, &decoder), EXR_ERR_SUCCESS);
    }
    exr_decoding_destroy(exr, &decoder);
}

static void exr_has_the_floats_bit_for_bit(void **state)
{
    struct fixture *f = *state;
    char path[PATH_BYTES];
    float *rgba = make_floats();
    assert_int_equal(trl_image_write_exr(f->ctx, place(f, "a.exr", path), WIDTH, HEIGHT, rgba),
                     TRL_OK);
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t exr = NULL;
    assert_int_equal(exr_start_read(&exr, path, &init), EXR_ERR_SUCCESS);
    exr_attr_box2i_t window;
    assert_int_equal(exr_get_data_window(exr, 0, &window), EXR_ERR_SUCCESS);
    assert_int_equal(window.max.x - window.min.x + 1, WIDTH);
    assert_int_equal(window.max.y - window.min.y + 1, HEIGHT);
    const exr_attr_chlist_t *list = NULL;
    assert_int_equal(exr_get_channels(exr, 0, &list), EXR_ERR_SUCCESS);
    assert_int_equal(list->num_channels, 3);
    float white = 0;
    assert_int_equal(exr_attr_get_float(exr, 0, "whiteLuminance", &white), EXR_ERR_SUCCESS);
    assert_true(white == 1);
    float *values = malloc(WIDTH * HEIGHT * sizeof *values);
    for (int c = 0; c < 3; c++) {
        assert_string_equal(list->entries[c].name.str, c == 0 ? "B" : c == 1 ? "G" : "R");
        read_exr_channel(exr, c, values);
        for (size_t i = 0; i < WIDTH * HEIGHT; i++) {
            assert_memory_equal(&values[i], &rgba[4 * i + (size_t)(2 - c)], sizeof *values);
        }
    }
    exr_finish(&exr);
    free(values);
    free(rgba);
    assert_int_equal(sweep(f), 1);
}

static void one_pixel_is_a_picture(void **state)
{
    struct fixture *f = *state;
    char path[PATH_BYTES];
    const uint8_t bytes[4] = {1, 2, 3, 4};
    const float floats[4] = {1, 2, 3, 4};
    assert_int_equal(trl_image_write_png(f->ctx, place(f, "b.png", path), 1, 1, bytes), TRL_OK);
    assert_int_equal(trl_image_write_exr(f->ctx, place(f, "b.exr", path), 1, 1, floats), TRL_OK);
    assert_int_equal(sweep(f), 2);
}

static void a_size_of_zero_is_invalid(void **state)
{
    struct fixture *f = *state;
    char path[PATH_BYTES];
    const float pixel[4] = {0};
    place(f, "c", path);
    assert_int_equal(trl_image_write_png(f->ctx, path, 0, 1, (const uint8_t *)pixel),
                     TRL_ERROR_INVALID);
    assert_int_equal(trl_image_write_exr(f->ctx, path, 1, 0, pixel), TRL_ERROR_INVALID);
    assert_int_equal(trl_image_write_exr(f->ctx, NULL, 1, 1, pixel), TRL_ERROR_INVALID);
    assert_int_equal(trl_image_write_png(f->ctx, path, 1, 1, NULL), TRL_ERROR_INVALID);
    assert_int_equal(f->last_item, TRL_LOG_ITEM_ARGUMENT);
    assert_int_equal(f->errors, 4);
    f->errors = 0;
    assert_int_equal(sweep(f), 0);
}

static void an_unwritable_place_is_one_io_error(void **state)
{
    struct fixture *f = *state;
    const float pixel[4] = {0};
    static const char *const paths[] = {"/nonexistent/a.png", "/dev/full", "/tmp", ""};
    for (size_t i = 0; i < sizeof paths / sizeof *paths; i++) {
        f->errors = 0;
        assert_int_equal(trl_image_write_png(f->ctx, paths[i], 1, 1, (const uint8_t *)pixel),
                         TRL_ERROR_IO);
        assert_int_equal(f->errors, 1);
        assert_int_equal(trl_image_write_exr(f->ctx, paths[i], 1, 1, pixel), TRL_ERROR_IO);
        assert_int_equal(f->errors, 2);
        assert_int_equal(f->last_item, TRL_LOG_ITEM_FILE_WRITE);
    }
    f->errors = 0;
}

// A limit on the size of files stands for a disk that fills up in the middle.
static void a_full_disk_leaves_the_old_file_and_no_other(void **state)
{
    struct fixture *f = *state;
    char png_path[PATH_BYTES], exr_path[PATH_BYTES];
    place(f, "d.png", png_path);
    place(f, "d.exr", exr_path);
    uint8_t *bytes = make_bytes();
    float *floats = make_floats();
    assert_int_equal(trl_image_write_png(f->ctx, png_path, 1, 1, bytes), TRL_OK);
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &(struct rlimit){1000, before.rlim_max}), 0);
    const trl_result png_result = trl_image_write_png(f->ctx, png_path, WIDTH, HEIGHT, bytes);
    const trl_result exr_result = trl_image_write_exr(f->ctx, exr_path, WIDTH, HEIGHT, floats);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    free(bytes);
    free(floats);
    assert_int_equal(png_result, TRL_ERROR_IO);
    assert_int_equal(exr_result, TRL_ERROR_IO);
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, png_path));
    assert_int_equal(image.width, 1);
    png_image_free(&image);
    assert_int_equal(sweep(f), 1);
    f->errors = 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(png_has_the_colours_and_no_alpha),
        cmocka_unit_test(exr_has_the_floats_bit_for_bit),
        cmocka_unit_test(one_pixel_is_a_picture),
        cmocka_unit_test(a_size_of_zero_is_invalid),
        cmocka_unit_test(an_unwritable_place_is_one_io_error),
        cmocka_unit_test(a_full_disk_leaves_the_old_file_and_no_other),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
