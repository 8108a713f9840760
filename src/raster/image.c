// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Pictures to files: PNG through libpng, OpenEXR through its C core. Both write beside the final
// path and are renamed over it when complete.
#include <terrella/image.h>

#include "base/file.h"

#include <errno.h>
#include <openexr.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <string.h>

// Levels of zlib above this cost several times the time for a few per cent of size.
enum { PNG_LEVEL = 4, EXR_ZIP_LEVEL = 4, REASON_MAX = 256, EXR_CHANNELS = 3 };

struct picture {
    const trl_context *ctx;
    const char *path;
    uint32_t width, height;
};

static trl_result check_picture(const struct picture *picture, const void *rgba)
{
    if (!picture->ctx || !picture->path || !rgba) {
        return trl_fail(picture->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "an image needs a context, a path and pixels");
    }
    if (picture->width == 0 || picture->height == 0 || picture->width > PNG_USER_WIDTH_MAX ||
        picture->height > PNG_USER_HEIGHT_MAX) {
        return trl_fail(picture->ctx, TRL_ERROR_INVALID, TRL_LOG_ITEM_ARGUMENT,
                        "%s: an image of %u x %u pixels", picture->path, picture->width,
                        picture->height);
    }
    return TRL_OK;
}

static trl_result fail_write(const struct picture *picture, const char *why)
{
    return trl_fail(picture->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_WRITE, "cannot write %s: %s",
                    picture->path, why);
}

// libpng leaves by longjmp, so that what its caller needs afterwards lives here and not in
// registers.
struct png_job {
    png_structp png;
    png_infop info;
    FILE *file;
    char reason[REASON_MAX];
};

static void note_png_error(png_structp png, png_const_charp message)
{
    struct png_job *job = png_get_error_ptr(png);
    snprintf(job->reason, sizeof job->reason, "%s", errno ? strerror(errno) : message);
    png_longjmp(png, 1);
}

static void ignore_png_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

// False with job->reason set when libpng gave up.
static bool encode_png(struct png_job *job, const struct picture *picture, const uint8_t *rgba)
{
    if (setjmp(png_jmpbuf(job->png))) {
        return false;
    }
    png_init_io(job->png, job->file);
    png_set_compression_level(job->png, PNG_LEVEL);
    png_set_IHDR(job->png, job->info, picture->width, picture->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(job->png, job->info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_write_info(job->png, job->info);
    png_set_filler(job->png, 0, PNG_FILLER_AFTER); // drops alpha
    for (uint32_t y = 0; y < picture->height; y++) {
        png_write_row(job->png, rgba + (size_t)y * picture->width * 4);
    }
    png_write_end(job->png, job->info);
    return true;
}

static trl_result write_png_file(const struct picture *picture, const char *temp_path,
                                 const uint8_t *rgba)
{
    struct png_job job = {0};
    trl_result result = TRL_OK;
    job.png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &job, note_png_error, ignore_png_warning);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    errno = 0;
    if (!job.info) {
        result = trl_fail(picture->ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_MEMORY, "out of memory");
    } else if (!(job.file = fopen(temp_path, "wb"))) {
        result = fail_write(picture, strerror(errno));
    } else if (!encode_png(&job, picture, rgba)) {
        result = fail_write(picture, job.reason);
    }
    // A full disk may show only when the last buffer is flushed.
    if (job.file && fclose(job.file) != 0 && result == TRL_OK) {
        result = fail_write(picture, strerror(errno));
    }
    png_destroy_write_struct(&job.png, &job.info);
    return result;
}

trl_result trl_image_write_png(trl_context *ctx, const char *path, uint32_t width, uint32_t height,
                               const uint8_t *rgba)
{
    const struct picture picture = {ctx, path, width, height};
    trl_result result = check_picture(&picture, rgba);
    struct file_replacement file = {0};
    if (result != TRL_OK || (result = file_replacement_begin(ctx, path, &file)) != TRL_OK) {
        return result;
    }
    result = write_png_file(&picture, file.temp_path, rgba);
    if (result != TRL_OK) {
        file_replacement_abort(ctx, &file);
        return result;
    }
    return file_replacement_commit(ctx, &file);
}

// Messages of the library are dropped: its result codes say as much, and it would print to standard
// error.
static void ignore_exr_message(exr_const_context_t exr, exr_result_t code, const char *message)
{
    (void)exr;
    (void)code;
    (void)message;
}

static exr_result_t write_exr_header(exr_context_t exr, const struct picture *picture)
{
    // Rec. ITU-R BT.709 primaries and D65, which are sRGB's.
    const exr_attr_chromaticities_t srgb = {0.64f, 0.33f, 0.30f,   0.60f,
                                            0.15f, 0.06f, 0.3127f, 0.3290f};
    int part = 0;
    exr_result_t code = exr_add_part(exr, NULL, EXR_STORAGE_SCANLINE, &part);
    if (code == EXR_ERR_SUCCESS) {
        code = exr_initialize_required_attr_simple(exr, part, (int32_t)picture->width,
                                                   (int32_t)picture->height, EXR_COMPRESSION_ZIP);
    }
    static const char *const names[EXR_CHANNELS] = {"B", "G", "R"};
    for (int i = 0; code == EXR_ERR_SUCCESS && i < EXR_CHANNELS; i++) {
        code = exr_add_channel(exr, part, names[i], EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR, 1, 1);
    }
    if (code == EXR_ERR_SUCCESS) {
        code = exr_attr_set_chromaticities(exr, part, "chromaticities", &srgb);
    }
    if (code == EXR_ERR_SUCCESS) {
        code = exr_attr_set_float(exr, part, "whiteLuminance", 1); // cd m^-2 of (1, 1, 1)
    }
    if (code == EXR_ERR_SUCCESS) {
        code = exr_set_zip_compression_level(exr, part, EXR_ZIP_LEVEL);
    }
    return code == EXR_ERR_SUCCESS ? exr_write_header(exr) : code;
}

// Points the encoder's channels, which stand in the file's order B, G, R, at the rows from `y` on.
static void aim_encoder(exr_encode_pipeline_t *encoder, const struct picture *picture,
                        const float *rgba, int32_t y)
{
    for (int i = 0; i < EXR_CHANNELS; i++) {
        exr_coding_channel_info_t *channel = &encoder->channels[i];
        const float *first = rgba + (size_t)y * picture->width * 4 + (EXR_CHANNELS - 1 - i);
        channel->encode_from_ptr = (const uint8_t *)first;
        channel->user_bytes_per_element = sizeof(float);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = 4 * sizeof(float);
        channel->user_line_stride = (int32_t)(picture->width * 4 * sizeof(float));
    }
}

static exr_result_t write_exr_chunks(exr_context_t exr, const struct picture *picture,
                                     const float *rgba)
{
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    int32_t rows = 0;
    exr_result_t code = exr_get_scanlines_per_chunk(exr, 0, &rows);
    for (int32_t y = 0; code == EXR_ERR_SUCCESS && y < (int32_t)picture->height; y += rows) {
        exr_chunk_info_t chunk;
        code = exr_write_scanline_chunk_info(exr, 0, y, &chunk);
        if (code == EXR_ERR_SUCCESS) {
            code = y == 0 ? exr_encoding_initialize(exr, 0, &chunk, &encoder)
                          : exr_encoding_update(exr, 0, &chunk, &encoder);
        }
        if (code == EXR_ERR_SUCCESS) {
            aim_encoder(&encoder, picture, rgba, y);
            code = y == 0 ? exr_encoding_choose_default_routines(exr, 0, &encoder) : code;
        }
        if (code == EXR_ERR_SUCCESS) {
            code = exr_encoding_run(exr, 0, &encoder);
        }
    }
    if (encoder.channels) {
        exr_encoding_destroy(exr, &encoder);
    }
    return code;
}

static trl_result write_exr_file(const struct picture *picture, const char *temp_path,
                                 const float *rgba)
{
    exr_context_initializer_t init = EXR_DEFAULT_CONTEXT_INITIALIZER;
    init.error_handler_fn = ignore_exr_message;
    exr_context_t exr = NULL;
    exr_result_t code = exr_start_write(&exr, temp_path, EXR_WRITE_FILE_DIRECTLY, &init);
    if (code == EXR_ERR_SUCCESS) {
        code = write_exr_header(exr, picture);
    }
    if (code == EXR_ERR_SUCCESS) {
        code = write_exr_chunks(exr, picture, rgba);
    }
    const exr_result_t end = exr ? exr_finish(&exr) : EXR_ERR_SUCCESS;
    code = code == EXR_ERR_SUCCESS ? end : code;
    if (code == EXR_ERR_OUT_OF_MEMORY) {
        return trl_fail(picture->ctx, TRL_ERROR_MEMORY, TRL_LOG_ITEM_MEMORY, "out of memory");
    }
    return code == EXR_ERR_SUCCESS ? TRL_OK
                                   : fail_write(picture, exr_get_default_error_message(code));
}

trl_result trl_image_write_exr(trl_context *ctx, const char *path, uint32_t width, uint32_t height,
                               const float *rgba)
{
    const struct picture picture = {ctx, path, width, height};
    trl_result result = check_picture(&picture, rgba);
    struct file_replacement file = {0};
    if (result != TRL_OK || (result = file_replacement_begin(ctx, path, &file)) != TRL_OK) {
        return result;
    }
    result = write_exr_file(&picture, file.temp_path, rgba);
    if (result != TRL_OK) {
        file_replacement_abort(ctx, &file);
        return result;
    }
    return file_replacement_commit(ctx, &file);
}
