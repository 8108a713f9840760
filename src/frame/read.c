// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Frames on their way back to the CPU.
#include "frame/frame.h"

#include <math.h>
#include <string.h>

// Turns a picture over in place, by pieces of rows through a small buffer.
static void swap_rows(void *pixels, size_t row_bytes, size_t rows)
{
    char piece[1024];
    char *low = pixels, *high = low + row_bytes * (rows - 1);
    for (; low < high; low += row_bytes, high -= row_bytes) {
        for (size_t at = 0; at < row_bytes; at += sizeof piece) {
            const size_t left = row_bytes - at;
            const size_t bytes = left < sizeof piece ? left : sizeof piece;
            memcpy(piece, low + at, bytes);
            memcpy(low + at, high + at, bytes);
            memcpy(high + at, piece, bytes);
        }
    }
}

trl_result frame_read_picture(struct frame *frame, uint8_t *rgba)
{
    const struct gpu_rect all = {0, 0, frame->picture.width, frame->picture.height};
    trl_result result = gpu_make_current(frame->gpu);
    if (result == TRL_OK) {
        result = gpu_target_read_rgba8(&frame->picture_target, all, rgba);
    }
    if (result == TRL_OK) {
        swap_rows(rgba, (size_t)4 * all.width, all.height);
    }
    return result;
}

// Writes opaque alpha; a component that is not finite is a defect of a pass and must not pass for a
// measurement.
static trl_result check_radiance(const struct frame *frame, float *rgba)
{
    const size_t count = (size_t)frame->radiance.width * frame->radiance.height;
    size_t broken = 0;
    for (size_t i = 0; i < count; i++) {
        float *pixel = rgba + 4 * i;
        broken += !(isfinite(pixel[0]) && isfinite(pixel[1]) && isfinite(pixel[2]));
        pixel[3] = 1;
    }
    return broken == 0 ? TRL_OK
                       : trl_fail(frame->ctx, TRL_ERROR_GPU, TRL_LOG_ITEM_GENERAL,
                                  "%zu of %zu pixels have no finite radiance", broken, count);
}

trl_result frame_read_radiance(struct frame *frame, float *rgba)
{
    trl_result result = gpu_make_current(frame->gpu);
    if (result == TRL_OK) {
        const struct gpu_region all = gpu_texture_region(&frame->radiance, 0);
        result = gpu_texture_read(&frame->radiance, &all, rgba);
    }
    if (result == TRL_OK) {
        swap_rows(rgba, 4 * sizeof *rgba * frame->radiance.width, frame->radiance.height);
        result = check_radiance(frame, rgba);
    }
    return result;
}
