// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Snow of a picture of the Earth becomes a mask of its own, finer than the picture: it lies where
// the ground is higher than around. The picture keeps the ground without it.
#include "prepare.h"

#include "shared/albedo.glsl"

#include <math.h>
#include <string.h>

// Snow is as bright in blue as in red, unlike deserts and water (codes), and brighter than ground.
static const double GREY_LOW = 0.75, GREY_HIGH = 0.92;
static const double BARE_LIGHT = 0.06, SNOW_LIGHT = 0.9;
// Nearer the equator than 35 degrees and lower than this nothing is snow: coasts of deserts, whose
// pixels are grey of sand and sea.
static const double WARM_PART = 35.0 / 180, WARM_M = 2000;
// Water, by its red against its blue, tells nothing about the ground beside it.
static const double WATER_RED = 0.75, WATER_WEIGHT = 1e-3;
// Heights are compared with those so many cells around, 18 km.
enum { REACH = 5, MOST_REACH = 60 };

static double clamp(double x)
{
    return fmin(1, fmax(0, x));
}

static double find_share(const uint8_t *rgb)
{
    const double grey =
        clamp(((double)rgb[2] / fmax(rgb[0], 1) - GREY_LOW) / (GREY_HIGH - GREY_LOW));
    const double light =
        (light_of_code(fmin(rgb[0], rgb[2])) - BARE_LIGHT) / (SNOW_LIGHT - BARE_LIGHT);
    return clamp(light) * grey * grey * (3 - 2 * grey);
}

// Means of four, with their weights in the fourth number; a level after another.
struct bare {
    uint32_t width, height;
    float *rgbw; // owned
};

static trl_result reserve(const struct places *places, uint32_t width, uint32_t height,
                          struct bare *out)
{
    *out = (struct bare){width, height, mem_alloc(places->ctx, (size_t)width * height, 16)};
    return out->rgbw ? TRL_OK : TRL_ERROR_MEMORY;
}

static void halve(const struct bare *from, struct bare *to)
{
    for (size_t y = 0; y < to->height; y++) {
        for (size_t x = 0; x < to->width; x++) {
            for (size_t c = 0; c < 4; c++) {
                float sum = 0;
                for (size_t k = 0; k < 4; k++) {
                    const size_t row = 2 * y + k / 2, column = 2 * x + k % 2;
                    sum += from->rgbw[4 * (row * from->width + column) + c];
                }
                to->rgbw[4 * (y * to->width + x) + c] = sum / 4;
            }
        }
    }
}

// Where little is known, what the coarser level knows.
static void fill(const struct bare *coarse, struct bare *fine)
{
    for (size_t y = 0; y < fine->height; y++) {
        for (size_t x = 0; x < fine->width; x++) {
            const size_t row = y / 2 < coarse->height ? y / 2 : coarse->height - 1;
            const size_t column = x / 2 < coarse->width ? x / 2 : coarse->width - 1;
            const float *below = &coarse->rgbw[4 * (row * coarse->width + column)];
            float *texel = &fine->rgbw[4 * (y * fine->width + x)];
            const float lack = fmaxf(1 - texel[3], 0) / fmaxf(below[3], 1e-6f);
            for (size_t c = 0; c < 4; c++) {
                texel[c] += lack * below[c];
            }
        }
    }
}

enum { LEVELS = 10 };

// Premultiplied by their weights, levels become as sure as they can.
static trl_result fill_levels(const struct places *places, struct bare levels[LEVELS])
{
    trl_result result = TRL_OK;
    int count = 1;
    for (; count < LEVELS && result == TRL_OK; count++) {
        const struct bare *from = &levels[count - 1];
        result = reserve(places, from->width / 2, from->height / 2, &levels[count]);
        if (result == TRL_OK) {
            halve(from, &levels[count]);
        }
    }
    for (int i = count - 2; i >= 0 && result == TRL_OK; i--) {
        fill(&levels[i + 1], &levels[i]);
    }
    return result;
}

// The picture less its snow, as sure as the ground is seen.
static void unmix(const struct picture *colour, const struct picture *share, struct bare *out)
{
    for (size_t i = 0; i < (size_t)colour->width * colour->height; i++) {
        const uint8_t *rgb = colour->pixels + i * colour->bands;
        const double s = share->pixels[i] / 255.0;
        const double weight = rgb[0] < WATER_RED * rgb[2] ? WATER_WEIGHT : pow(1 - s, 4);
        for (size_t c = 0; c < 3; c++) {
            const double light = light_of_code(rgb[c]);
            const double bare = clamp((light - s * SNOW_LIGHT) / fmax(1 - s, 0.1));
            out->rgbw[4 * i + c] = (float)(weight * bare);
        }
        out->rgbw[4 * i + 3] = (float)weight;
    }
}

static void put_back(const struct bare *bare, const struct picture *share, struct picture *colour)
{
    for (size_t i = 0; i < (size_t)colour->width * colour->height; i++) {
        const float *texel = &bare->rgbw[4 * i];
        for (size_t c = 0; c < 3 && share->pixels[i] > 0; c++) {
            const double light = (double)texel[c] / fmax((double)texel[3], 1e-6);
            colour->pixels[i * colour->bands + c] = (uint8_t)lrint(code_of_light(light));
        }
    }
}

trl_result snow_take_out(const struct places *places, struct picture *colour, struct picture *share)
{
    const size_t count = (size_t)colour->width * colour->height;
    struct bare levels[LEVELS] = {{0}};
    *share = (struct picture){colour->width, colour->height, 1, mem_alloc(places->ctx, count, 1)};
    trl_result result = share->pixels ? TRL_OK : TRL_ERROR_MEMORY;
    for (size_t i = 0; i < count && result == TRL_OK; i++) {
        share->pixels[i] = (uint8_t)lrint(255 * find_share(colour->pixels + i * colour->bands));
    }
    if (result == TRL_OK) {
        result = reserve(places, colour->width, colour->height, &levels[0]);
    }
    if (result == TRL_OK) {
        unmix(colour, share, &levels[0]);
        result = fill_levels(places, levels);
    }
    if (result == TRL_OK) {
        put_back(&levels[0], share, colour);
    }
    for (int i = 0; i < LEVELS; i++) {
        mem_free(places->ctx, levels[i].rgbw);
    }
    return result;
}

// Of the heights around each cell of a row: sums over REACH rows up and down, of each column.
static void sum_columns(const int16_t *elevation, int row, double (*sums)[2])
{
    memset(sums, 0, GLOBE_WIDTH * sizeof *sums);
    for (int y = row - REACH; y <= row + REACH; y++) {
        const int held = y < 0 ? 0 : y >= GLOBE_HEIGHT ? GLOBE_HEIGHT - 1 : y;
        const int16_t *heights = elevation + (size_t)held * GLOBE_WIDTH;
        for (int x = 0; x < GLOBE_WIDTH; x++) {
            sums[x][0] += heights[x];
            sums[x][1] += (double)heights[x] * heights[x];
        }
    }
}

// A row of the mask, 0 to 1, in the cells of the heights.
static void spread_row(const struct picture *share, const int16_t *elevation, int row,
                       double (*sums)[2], float *out)
{
    const double v = (row + 0.5) / GLOBE_HEIGHT;
    const int reach = (int)fmin(REACH / fmax(sin(M_PI * v), 1e-3), MOST_REACH);
    const double count = (2 * REACH + 1.0) * (2 * reach + 1);
    double sum = 0, squares = 0;
    sum_columns(elevation, row, sums);
    for (int x = -reach; x < GLOBE_WIDTH + reach; x++) {
        const int enters = (x + GLOBE_WIDTH) % GLOBE_WIDTH;
        sum += sums[enters][0];
        squares += sums[enters][1];
        const int at = x - reach;
        if (at < 0) {
            continue;
        }
        const double mean = sum / count, deviation = sqrt(fmax(squares / count - mean * mean, 1));
        const double height = elevation[(size_t)row * GLOBE_WIDTH + at];
        const double strength = albedo_cover_strength(deviation);
        const bool is_warm = fabs(v - 0.5) < WARM_PART && height < WARM_M;
        const double s = picture_sample(share, 0, (at + 0.5) / GLOBE_WIDTH, v) / 255;
        out[at] = is_warm ? 0 : (float)albedo_cover(s, (height - mean) / deviation, strength, 0);
        const int leaves = (at - reach + GLOBE_WIDTH) % GLOBE_WIDTH;
        sum -= sums[leaves][0];
        squares -= sums[leaves][1];
    }
}

static void spread(const struct picture *share, const int16_t *elevation, double (*sums)[2],
                   float *rows, struct picture *mask)
{
    for (uint32_t y = 0; y < mask->height; y++) {
        spread_row(share, elevation, (int)(2 * y), sums, rows);
        spread_row(share, elevation, (int)(2 * y + 1), sums, rows + GLOBE_WIDTH);
        for (uint32_t x = 0; x < mask->width; x++) {
            const float *a = rows + 2 * (size_t)x, *b = a + GLOBE_WIDTH;
            mask->pixels[(size_t)y * mask->width + x] =
                (uint8_t)lrintf(255 * (a[0] + a[1] + b[0] + b[1]) / 4);
        }
    }
}

trl_result snow_write(const struct places *places, const struct picture *share,
                      const int16_t *elevation)
{
    const trl_context *ctx = places->ctx;
    struct picture mask = {GLOBE_WIDTH / 2, GLOBE_HEIGHT / 2, 1, NULL};
    mask.pixels = mem_alloc(ctx, (size_t)mask.width * mask.height, 1);
    double(*sums)[2] = mem_alloc(ctx, GLOBE_WIDTH, sizeof *sums);
    float *rows = mem_alloc(ctx, GLOBE_WIDTH, 2 * sizeof *rows);
    trl_result result = mask.pixels && sums && rows ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        spread(share, elevation, sums, rows, &mask);
        result = picture_write(places, "snow.tif", &mask);
    }
    mem_free(ctx, sums);
    mem_free(ctx, rows);
    picture_finish(places, &mask);
    return result;
}
