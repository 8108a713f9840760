// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Elevation of other bodies than Earth: grids of 16 bits as archives have them, and pictures whose
// greys are heights.
#include "prepare.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

// Distances of the neighbours that are averaged, one after the other: wide ones reach across broad
// terraces, narrow ones round what is left.
static const int STRIDES[] = {32, 32, 16, 16, 8, 8, 8, 4, 4, 4, 4, 2, 2, 2, 2, 1, 1, 1, 1, 1, 1};
enum { STRIDE_COUNT = sizeof STRIDES / sizeof STRIDES[0] };

// How far from its grey a height may be, in steps of grey: half of one is what rounding hides.
static const float FREEDOM = 0.55f;

trl_result heights_reserve(const struct places *places, uint32_t width, uint32_t height,
                           struct heights *out)
{
    *out = (struct heights){width, height, NULL};
    out->metres = mem_alloc(places->ctx, (size_t)width * height, sizeof *out->metres);
    return out->metres ? TRL_OK : TRL_ERROR_MEMORY;
}

void heights_finish(const struct places *places, struct heights *heights)
{
    mem_free(places->ctx, heights->metres);
    *heights = (struct heights){0};
}

static trl_result read_bytes(const struct places *places, const char *relative, size_t size,
                             uint8_t *out)
{
    char *path = source_path(places, relative);
    if (!path) {
        return TRL_ERROR_MEMORY;
    }
    FILE *file = fopen(path, "rb");
    const bool is_read = file && fread(out, 1, size, file) == size;
    if (file) {
        fclose(file);
    }
    const trl_result result = is_read ? TRL_OK
                                      : trl_fail(places->ctx, TRL_ERROR_IO, TRL_LOG_ITEM_FILE_READ,
                                                 "cannot read %s: missing or ends early", path);
    mem_free(places->ctx, path);
    return result;
}

// The archives' grids begin at the prime meridian, ours opposite.
trl_result heights_read_grid(const struct places *places, const struct grid16 *grid,
                             struct heights *out)
{
    const size_t cells = (size_t)grid->width * grid->height;
    trl_result result = heights_reserve(places, grid->width, grid->height, out);
    uint8_t *bytes = mem_alloc(places->ctx, cells, 2);
    if (result == TRL_OK) {
        result = bytes ? read_bytes(places, grid->file, 2 * cells, bytes) : TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < cells && result == TRL_OK; i++) {
        const uint8_t low = bytes[2 * i + (grid->is_big_endian ? 1 : 0)];
        const uint8_t high = bytes[2 * i + (grid->is_big_endian ? 0 : 1)];
        const int16_t value = (int16_t)(uint16_t)(low | high << 8);
        const size_t row = i / grid->width;
        const size_t column = (i % grid->width + grid->width / 2) % grid->width;
        out->metres[row * grid->width + column] = (float)(value * grid->metres_per_unit);
    }
    mem_free(places->ctx, bytes);
    return result;
}

trl_result heights_read_greys(const struct places *places, const struct greys *greys,
                              struct heights *out)
{
    struct picture picture;
    *out = (struct heights){0};
    trl_result result = picture_read_globe(places, greys->file, &picture);
    if (result == TRL_OK) {
        result = heights_reserve(places, picture.width, picture.height, out);
    }
    for (size_t i = 0; i < (size_t)picture.width * picture.height && result == TRL_OK; i++) {
        const uint8_t grey = picture.pixels[i * picture.bands];
        out->metres[i] = (float)(greys->offset_m + greys->step_m * grey);
    }
    picture_finish(places, &picture);
    return result;
}

static float height_at(const struct heights *h, const float *metres, int64_t column, int64_t row)
{
    const int64_t width = h->width, height = h->height;
    const int64_t wrapped = (column % width + width) % width;
    const int64_t clamped = row < 0 ? 0 : row >= height ? height - 1 : row;
    return metres[clamped * width + wrapped];
}

// Every height halfway to the mean of its neighbours at a distance, not farther from its grey than
// rounding explains.
static void smooth_once(struct heights *h, const float *greys, float *scratch, int stride,
                        float freedom_m)
{
    const size_t cells = (size_t)h->width * h->height;
    memcpy(scratch, h->metres, cells * sizeof *scratch);
#pragma omp parallel for schedule(static)
    for (int64_t row = 0; row < (int64_t)h->height; row++) {
        for (int64_t column = 0; column < (int64_t)h->width; column++) {
            const int64_t i = row * h->width + column;
            const float mean = 0.25f * (height_at(h, scratch, column - stride, row) +
                                        height_at(h, scratch, column + stride, row) +
                                        height_at(h, scratch, column, row - stride) +
                                        height_at(h, scratch, column, row + stride));
            const float wanted = 0.5f * (scratch[i] + mean);
            h->metres[i] = fminf(fmaxf(wanted, greys[i] - freedom_m), greys[i] + freedom_m);
        }
    }
}

// Gives each block of 2 x 2 cells the mean that a grid half as fine has.
static void hold_means(struct heights *h, const struct heights *coarse)
{
    for (size_t row = 0; row < coarse->height; row++) {
        for (size_t column = 0; column < coarse->width; column++) {
            float *north = h->metres + 2 * row * h->width + 2 * column;
            float *south = north + h->width;
            const float mean = 0.25f * (north[0] + north[1] + south[0] + south[1]);
            const float missing = coarse->metres[row * coarse->width + column] - mean;
            north[0] += missing;
            north[1] += missing;
            south[0] += missing;
            south[1] += missing;
        }
    }
}

trl_result heights_undo_steps(const struct places *places, struct heights *heights, double step_m,
                              const struct heights *coarse)
{
    const size_t cells = (size_t)heights->width * heights->height;
    float *greys = mem_alloc(places->ctx, cells, sizeof *greys);
    float *scratch = mem_alloc(places->ctx, cells, sizeof *scratch);
    const bool has_memory = greys && scratch;
    if (has_memory) {
        memcpy(greys, heights->metres, cells * sizeof *greys);
    }
    for (int i = 0; i < STRIDE_COUNT && has_memory; i++) {
        smooth_once(heights, greys, scratch, STRIDES[i], FREEDOM * (float)step_m);
        if (coarse) {
            hold_means(heights, coarse);
        }
    }
    mem_free(places->ctx, greys);
    mem_free(places->ctx, scratch);
    return has_memory ? TRL_OK : TRL_ERROR_MEMORY;
}

trl_result heights_write(const struct places *places, const struct heights *heights,
                         const char *name, const char *polar_body)
{
    const size_t cells = (size_t)heights->width * heights->height;
    int16_t *metres = mem_alloc(places->ctx, cells, sizeof *metres);
    if (!metres) {
        return TRL_ERROR_MEMORY;
    }
    for (size_t i = 0; i < cells; i++) {
        metres[i] = (int16_t)lrintf(fminf(fmaxf(heights->metres[i], -32767), 32767));
    }
    const struct geotiff geotiff = {.name = name,
                                    .width = heights->width,
                                    .height = heights->height,
                                    .bands = 1,
                                    .kind = PIXEL_INT16,
                                    .west_deg = -180,
                                    .north_deg = 90,
                                    .pixel_width_deg = 360.0 / heights->width,
                                    .pixel_height_deg = 180.0 / heights->height,
                                    .pixels = metres,
                                    .unit = "m"};
    trl_result result = geotiff_write(places, &geotiff);
    if (result == TRL_OK && polar_body) {
        const struct globe_values globe = {heights->width, heights->height, 1, metres, NULL};
        result = polar_prepare(places, polar_body, "elevation", &globe);
    }
    mem_free(places->ctx, metres);
    return result;
}
