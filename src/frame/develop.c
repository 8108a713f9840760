// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/develop.h"

#include "shared/meter.glsl"

#include <math.h>

// A pixel counted from the lower left corner, as the GPU does.
static const float *pixel_at(const struct develop_source *source, uint32_t x, uint32_t y)
{
    return source->radiance + 4 * ((size_t)(source->height - 1 - y) * source->width + x);
}

static double luminance_of(const float *rgb)
{
    return meter_luminance((double)rgb[0], (double)rgb[1], (double)rgb[2]);
}

// The sample's pixel in one direction.
static uint32_t sample_pixel(int sample, int cells, uint32_t pixels)
{
    return (uint32_t)((sample + 0.5) / (METER_SAMPLES * cells) * pixels);
}

double develop_meter(const struct develop_source *source)
{
    double weights = 0, weighted = 0;
    for (int j = 0; j < METER_CELLS_Y * METER_SAMPLES; j++) {
        const uint32_t y = sample_pixel(j, METER_CELLS_Y, source->height);
        for (int i = 0; i < METER_CELLS_X * METER_SAMPLES; i++) {
            const uint32_t x = sample_pixel(i, METER_CELLS_X, source->width);
            const double luminance =
                meter_counted(luminance_of(pixel_at(source, x, y)), source->wall_cd_m2);
            weights += sqrt(luminance);
            weighted += sqrt(luminance) * log2(fmax(luminance, 1e-30));
        }
    }
    return weights > 0 ? meter_exposure(weights, weighted) : METER_EV_UNLIT;
}

// As shaders/frame/tone.frag does it.
static void fit_gamut(double rgb[3])
{
    const double luminance = fmax(meter_luminance(rgb[0], rgb[1], rgb[2]), 0);
    const double lowest = fmin(fmin(rgb[0], rgb[1]), rgb[2]);
    const double keep = lowest < 0 ? luminance / (luminance - lowest) : 1;
    for (int c = 0; c < 3; c++) {
        rgb[c] = fmax(luminance + (rgb[c] - luminance) * keep, 0);
    }
}

static void map_tone(trl_tone_curve curve, double rgb[3])
{
    const double norm = fmax(fmax(fmax(rgb[0], rgb[1]), rgb[2]), 1e-12);
    for (int c = 0; c < 3; c++) {
        const double bleach = tone_bleach(norm);
        rgb[c] = curve == TRL_TONE_EXPONENTIAL
                     ? tone_exponential(rgb[c])
                     : tone_filmic(norm) * (rgb[c] / norm * (1 - bleach) + bleach);
    }
}

static double spread_noise(uint32_t x, uint32_t y)
{
    return ((x * TONE_NOISE_X + y * TONE_NOISE_Y) >> 8) / 16777216.0;
}

void develop_picture(const struct develop_source *source, const trl_view *view, uint8_t *rgba)
{
    const double ev100 = view->has_fixed_exposure ? view->exposure_ev100 : develop_meter(source);
    const double scale = exp2(view->exposure_bias_ev - ev100) / TONE_SATURATION_PER_EV0;
    for (uint32_t y = 0; y < source->height; y++) {
        for (uint32_t x = 0; x < source->width; x++) {
            const float *from = pixel_at(source, x, y);
            uint8_t *to = rgba + 4 * ((size_t)(source->height - 1 - y) * source->width + x);
            double rgb[3] = {(double)from[0] * scale, (double)from[1] * scale,
                             (double)from[2] * scale};
            fit_gamut(rgb);
            map_tone(view->tone_curve, rgb);
            for (int c = 0; c < 3; c++) {
                const double code = tone_srgb_encode(rgb[c]) + (spread_noise(x, y) - 0.5) / 255;
                to[c] = (uint8_t)lrint(fmin(fmax(code, 0), 1) * 255);
            }
            to[3] = 255;
        }
    }
}
