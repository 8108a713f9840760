// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "validate_map.h"

#include "difference.h"

#include <math.h>

static const double DARK_SHARE = 1.0 / 4096;
static const double CLEAR_SIGMAS = 3;
// Blocks of drawn pixels that differ by more have an edge in them: a horizon, the star's disc.
static const double EDGE_RATIO = 1.25;

const double validate_map_steps[VALIDATE_MAP_STEPS] = {0.02, 0.05, 0.1, 0.2, 0.5};

struct canvas_color validate_map_color(int step, bool is_brighter)
{
    static const struct canvas_color darker[] = {{247, 246, 243}, {206, 224, 238}, {150, 192, 222},
                                                 {92, 148, 200},  {48, 96, 165},   {24, 50, 110}};
    static const struct canvas_color brighter[] = {{247, 246, 243}, {249, 220, 196},
                                                   {243, 180, 140}, {228, 128, 88},
                                                   {193, 68, 52},   {122, 16, 34}};
    return is_brighter ? brighter[step] : darker[step];
}

// Nearly all noise of a pixel is common to its colours (docs/physics.md, section 25), and so their
// errors add up as they stand.
static double luminance_error(const struct validate_sheet *sheet, size_t pixel)
{
    return sheet->error ? difference_luminance(sheet->error + 4 * pixel) : 0;
}

struct block {
    double mean, least, most; // cd m^-2
};

// What `sheet` shows in the pixel of a sheet that is `factor` times as small.
static struct block look_at_block(const struct validate_sheet *sheet, uint32_t factor,
                                  uint32_t column, uint32_t row)
{
    struct block block = {.least = INFINITY, .most = -INFINITY};
    for (uint32_t i = 0; i < factor * factor; i++) {
        const size_t x = column * factor + i % factor;
        const size_t y = row * factor + i / factor;
        const double here = difference_luminance(sheet->radiance + 4 * (y * sheet->width + x));
        block.mean += here / (factor * factor);
        block.least = fmin(block.least, here);
        block.most = fmax(block.most, here);
    }
    return block;
}

static int find_step(double size)
{
    int step = 0;
    while (step < VALIDATE_MAP_STEPS && size > validate_map_steps[step]) {
        step++;
    }
    return step;
}

// Of all pixels' differences, relative to what the base shows there: to divide by what is noisy has
// a bias, and to divide by what a model leaves black says nothing.
struct sum {
    double pixels, share, variance;
};

static bool is_even(const struct block *block)
{
    return block->least > 0 && block->most < EDGE_RATIO * block->least;
}

// Noise of the pixel if what is drawn were true: the spread of paths grows with their mean, and of
// few paths both are often too small together.
static double likely_error(double drawn, double traced, double error)
{
    return drawn > traced && traced > 0 ? error * sqrt(drawn / traced) : error;
}

static struct canvas_color choose_color(double drawn, double traced, double error, double dark)
{
    if (drawn < dark && traced < dark) {
        return (struct canvas_color){178, 178, 178};
    }
    const double size = fabs(drawn - traced);
    const bool is_clear = size > CLEAR_SIGMAS * likely_error(drawn, traced, error);
    return validate_map_color(is_clear ? find_step(size / fmax(traced, dark)) : 0, drawn > traced);
}

void validate_map_draw(const struct validate_map *map, uint8_t *rgba, struct validate_pictures *out)
{
    const uint32_t width = map->traced->width;
    const uint32_t factor = map->drawn->width / width;
    const double dark = DARK_SHARE * map->white_cd_m2;
    struct sum sum = {0};
    for (uint32_t p = 0; p < width * map->traced->height; p++) {
        const struct block drawn = look_at_block(map->drawn, factor, p % width, p / width);
        const struct block base = look_at_block(map->base, factor, p % width, p / width);
        const double traced = difference_luminance(map->traced->radiance + 4 * (size_t)p);
        const double error = luminance_error(map->traced, p);
        const struct canvas_color color = choose_color(drawn.mean, traced, error, dark);
        if (base.mean >= dark && is_even(&base)) {
            sum.pixels++;
            sum.share += (drawn.mean - traced) / base.mean;
            sum.variance += error * error / (base.mean * base.mean);
        }
        rgba[4 * (size_t)p] = color.red;
        rgba[4 * (size_t)p + 1] = color.green;
        rgba[4 * (size_t)p + 2] = color.blue;
        rgba[4 * (size_t)p + 3] = 255;
    }
    out->mean = sum.pixels > 0 ? sum.share / sum.pixels : 0;
    out->mean_noise = sum.pixels > 0 ? sqrt(sum.variance) / sum.pixels : 0;
}

void validate_map_profile(const struct validate_sheet *sheet, struct validate_profile *out)
{
    const uint32_t first = sheet->width / 3;
    const uint32_t last = sheet->width - first;
    out->rows = (int)(sheet->height < VALIDATE_ROWS ? sheet->height : VALIDATE_ROWS);
    for (int row = 0; row < out->rows; row++) {
        double sum = 0;
        double variance = 0;
        for (uint32_t column = first; column < last; column++) {
            const size_t pixel = (size_t)row * sheet->width + column;
            sum += difference_luminance(sheet->radiance + 4 * pixel);
            variance += pow(luminance_error(sheet, pixel), 2);
        }
        out->luminance[row] = sum / (last - first);
        out->error[row] = sqrt(variance) / (last - first);
    }
}
