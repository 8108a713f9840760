// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "shrink.h"

#include <math.h>
#include <stddef.h>

// IEC 61966-2-1.
static double srgb_decode(double code)
{
    return code <= 0.04045 ? code / 12.92 : pow((code + 0.055) / 1.055, 2.4);
}

static double srgb_encode(double light)
{
    return light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
}

// First component of the block's pixel (x, y); a block never starts before its result.
static size_t pixel_at(uint32_t block_x, uint32_t block_y, uint32_t width, uint32_t samples,
                       uint32_t index)
{
    const size_t x = (size_t)block_x * samples + index % samples;
    const size_t y = (size_t)block_y * samples + index / samples;
    return 4 * (y * width * samples + x);
}

void shrink_radiance(float *rgba, uint32_t width, uint32_t height, uint32_t samples)
{
    float *out = rgba;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++, out += 4) {
            double sum[4] = {0};
            for (uint32_t k = 0; k < samples * samples; k++) {
                for (int c = 0; c < 4; c++) {
                    sum[c] += (double)rgba[pixel_at(x, y, width, samples, k) + (size_t)c];
                }
            }
            for (int c = 0; c < 4; c++) {
                out[c] = (float)(sum[c] / (samples * samples));
            }
        }
    }
}

void shrink_srgb(uint8_t *rgba, uint32_t width, uint32_t height, uint32_t samples)
{
    double light[256];
    for (int code = 0; code < 256; code++) {
        light[code] = srgb_decode(code / 255.0);
    }
    uint8_t *out = rgba;
    for (uint32_t y = 0; y < height; y++) {
        for (uint32_t x = 0; x < width; x++, out += 4) {
            double sum[4] = {0};
            for (uint32_t k = 0; k < samples * samples; k++) {
                for (int c = 0; c < 4; c++) {
                    sum[c] += light[rgba[pixel_at(x, y, width, samples, k) + (size_t)c]];
                }
            }
            for (int c = 0; c < 4; c++) {
                out[c] = (uint8_t)lround(255 * srgb_encode(sum[c] / (samples * samples)));
            }
        }
    }
}
