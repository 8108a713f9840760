// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The map of made-up relief: on the GPU with its mips, level at the poles, and what it says of a
// place.
#include "shared/spline.glsl"
#include "terrain/noise_parts.h"

#include <math.h>
#include <string.h>

static size_t texel_index(const struct noise_map *map, int64_t x, int64_t y)
{
    const int64_t width = map->width, height = map->height;
    if (y < 0 || y >= height) {
        y = y < 0 ? -1 - y : 2 * height - 1 - y;
        x += width / 2;
    }
    x = ((x % width) + width) % width;
    return (size_t)(y * width + x);
}

static void halve(const struct noise_map *from, struct noise_map *to)
{
    for (uint32_t i = 0; i < to->width * to->height; i++) {
        const uint32_t x = 2 * (i % to->width), y = 2 * (i / to->width);
        float sum[4] = {0};
        for (uint32_t k = 0; k < 4; k++) {
            const struct noise_texel *t = &from->texels[(y + k / 2) * from->width + x + k % 2];
            sum[0] += t->height_m;
            sum[1] += t->amplitude_m;
            sum[2] += t->ridged;
            sum[3] += t->climate;
        }
        to->texels[i] = (struct noise_texel){sum[0] / 4, sum[1] / 4, sum[2] / 4, sum[3] / 4};
    }
}

// Mean over as many columns as a texel is narrower than high: all of them in the last two rows,
// which are what the spline sees at the pole, so that it has one height and is level.
static void level_row(const struct noise_map *map, uint32_t y, struct noise_texel *copy)
{
    const double latitude = SHARED_PI * (0.5 - (y + 0.5) / map->height);
    const double columns = map->width / (2.0 * map->height * cos(latitude));
    const int64_t width = map->width;
    const int64_t half = columns >= (double)width / 10 ? width / 2 : (int64_t)(columns / 2);
    struct noise_texel *row = map->texels + (size_t)y * map->width;
    memcpy(copy, row, map->width * sizeof *copy);
    for (int64_t x = 0; x < width; x++) {
        double sum[4] = {0};
        for (int64_t i = x - half; i <= x + half; i++) {
            const struct noise_texel *t = &copy[(i + width) % width];
            sum[0] += (double)t->height_m;
            sum[1] += (double)t->amplitude_m;
            sum[2] += (double)t->ridged;
            sum[3] += (double)t->climate;
        }
        const double n = (double)(2 * half + 1);
        row[x] = (struct noise_texel){(float)(sum[0] / n), (float)(sum[1] / n), (float)(sum[2] / n),
                                      (float)(sum[3] / n)};
    }
}

trl_result noise_map_level_poles(const trl_context *ctx, const struct noise_map *map)
{
    struct noise_texel *copy = mem_alloc(ctx, map->width, sizeof *copy);
    const uint32_t rows = map->height / 50;
    for (uint32_t y = 0; copy && y < rows; y++) {
        level_row(map, y, copy);
        level_row(map, map->height - 1 - y, copy);
    }
    mem_free(ctx, copy);
    return copy ? TRL_OK : TRL_ERROR_MEMORY;
}

trl_result noise_map_upload(struct gpu *gpu, struct terrain_noise *noise)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "noise map";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.width = noise->map.width;
    desc.height = noise->map.height;
    desc.filter = GPU_FILTER_NEAREST;
    desc.levels = 0;
    desc.data = noise->map.texels;
    trl_result result = gpu_texture_init(gpu, &desc, &noise->texture);
    struct noise_map levels[2] = {noise->map};
    struct noise_texel *owned[2];
    const size_t quarter = (size_t)noise->map.width * noise->map.height / 4;
    owned[0] = mem_alloc(gpu->ctx, quarter, sizeof **owned);
    owned[1] = mem_alloc(gpu->ctx, quarter, sizeof **owned);
    result = owned[0] && owned[1] ? result : TRL_ERROR_MEMORY;
    for (uint32_t i = 1; i < noise->texture.levels && result == TRL_OK; i++) {
        struct noise_map *to = &levels[i % 2];
        const struct noise_map *from = &levels[(i + 1) % 2];
        *to = (struct noise_map){from->width / 2, from->height / 2, owned[i % 2]};
        if (to->height == 0) {
            *to = (struct noise_map){1, 1, owned[i % 2]};
            to->texels[0] = from->texels[0];
        } else {
            halve(from, to);
        }
        const struct gpu_region all = gpu_texture_region(&noise->texture, i);
        result = gpu_texture_upload(&noise->texture, &all, to->texels);
    }
    mem_free(gpu->ctx, owned[0]);
    mem_free(gpu->ctx, owned[1]);
    return result;
}

// The spline's slope is at most the steepest difference of texels along each direction, and both
// together root 2 of it. Rows near poles are level.
double noise_map_find_steepest(const struct terrain_noise *noise,
                               float (*value)(const struct noise_texel *))
{
    const struct noise_map *map = &noise->map;
    double most = 0;
    for (uint32_t y = 0; y + 1 < map->height; y++) {
        const double cosine = cos(SHARED_PI * (0.5 - (y + 0.5) / map->height));
        const double narrow = fmax(cosine * 2 * map->height / map->width, 0.05);
        for (uint32_t x = 0; x < map->width; x++) {
            const size_t i = (size_t)y * map->width + x;
            const size_t right = x + 1 < map->width ? i + 1 : i + 1 - map->width;
            const double here = (double)value(&map->texels[i]);
            most = fmax(most, fabs((double)value(&map->texels[i + map->width]) - here));
            most = fmax(most, fabs((double)value(&map->texels[right]) - here) / narrow);
        }
    }
    return sqrt(2) * most / (SHARED_PI * noise->radius_m / map->height);
}

static float height_of(const struct noise_texel *t)
{
    return t->height_m;
}

double noise_find_steepest(const struct terrain_noise *noise)
{
    return noise_map_find_steepest(noise, height_of);
}

struct noise_ground noise_ground_at(const struct terrain_noise *noise, struct vec3 up)
{
    const struct noise_map *map = &noise->map;
    const double flat = hypot(up.x, up.y);
    const double per_radian[2] = {map->width / (2 * SHARED_PI), map->height / SHARED_PI};
    const double x = (atan2(up.y, up.x) + SHARED_PI) * per_radian[0] - 0.5;
    const double y = (SHARED_PI / 2 - atan2(up.z, flat)) * per_radian[1] - 0.5;
    const int64_t column = (int64_t)floor(x + 0.5), row = (int64_t)floor(y + 0.5);
    const double fx = x - (double)column, fy = y - (double)row;
    double rows[3][4], slopes[3][2];
    for (int j = 0; j < 3; j++) {
        const struct noise_texel *t[3];
        for (int i = 0; i < 3; i++) {
            t[i] = &map->texels[texel_index(map, column - 1 + i, row - 1 + j)];
        }
#define BLEND(blend, part) blend(fx, (double)t[0]->part, (double)t[1]->part, (double)t[2]->part)
        rows[j][0] = BLEND(spline_blend, height_m);
        rows[j][1] = BLEND(spline_blend, amplitude_m);
        rows[j][2] = BLEND(spline_blend, ridged);
        rows[j][3] = BLEND(spline_blend, climate);
        slopes[j][0] = BLEND(spline_slope, height_m);
        slopes[j][1] = BLEND(spline_slope, amplitude_m);
#undef BLEND
    }
    double blended[4];
    struct vec3 slope[2];
    const struct vec3 east = {-up.y / fmax(flat, 1e-12), up.x / fmax(flat, 1e-12), 0};
    const struct vec3 north = vec3_cross(up, east);
    for (int c = 0; c < 4; c++) {
        blended[c] = spline_blend(fy, rows[0][c], rows[1][c], rows[2][c]);
    }
    for (int c = 0; c < 2; c++) {
        const double along = spline_blend(fy, slopes[0][c], slopes[1][c], slopes[2][c]) *
                             per_radian[0] / (noise->radius_m * fmax(flat, 1e-4));
        const double south =
            spline_slope(fy, rows[0][c], rows[1][c], rows[2][c]) * per_radian[1] / noise->radius_m;
        slope[c] = vec3_sub(vec3_scale(east, along), vec3_scale(north, south));
    }
    return (struct noise_ground){.height_m = blended[0],
                                 .amplitude_m = blended[1],
                                 .ridged = blended[2],
                                 .climate = blended[3],
                                 .slope = slope[0],
                                 .spread = slope[1],
                                 .dry = 1};
}
