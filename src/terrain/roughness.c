// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/roughness.h"

#include "shared/shared.glsl"

#include <math.h>

enum { WIDTH = 512, HEIGHT = 256, SAMPLES = 4 };
// What noise of amplitude 1 and a wavelength of 4 texels, with all octaves below and above in
// proportion, shows of the quantity that is measured: found by evaluating it, 0.49 to 0.69 for
// Hurst exponents of 0.6 to 1, folded by half or not.
static const double OF_NOISE = 0.58;
// The least amplitude relative to the wavelength: what whole metres hide on plains.
static const double LEAST = 0.006;

// Second differences over a texel's height, along both directions: slopes of the ground do not
// count, what bends within three texels does.
double roughness_square_bend(const struct terrain_layer *layer, double latitude, double longitude)
{
    const struct layer_frame *f = &layer->frame;
    const struct layer_place p = layer_locate(f, latitude, longitude);
    const int64_t x = (int64_t)floor(p.x + 0.5), y = (int64_t)floor(p.y + 0.5);
    const double columns = f->texel_height / (f->texel_width * fmax(cos(latitude), 1e-3));
    const int64_t step = (int64_t)fmax(1, fmin(floor(columns + 0.5), f->width / 4.0));
    const double middle = 2 * layer_texel(layer, x, y);
    const double along = layer_texel(layer, x, y - 1) + layer_texel(layer, x, y + 1) - middle;
    const double across =
        layer_texel(layer, x - step, y) + layer_texel(layer, x + step, y) - middle;
    // Heights in whole units bend by chance: a twelfth for each of six.
    const double rounding = layer->heights.shorts ? 0.5 * pow(layer->heights.scale, 2) : 0;
    return p.weight > 0 ? fmax(0.5 * (along * along + across * across) - rounding, 0) : 0;
}

static struct noise_texel measure(const struct roughness_desc *desc, uint32_t column, uint32_t row)
{
    const struct layer_frame *f = &desc->layer->frame;
    const double least = LEAST * ROUGHNESS_TEXELS * f->texel_height * desc->radius_m;
    double sum = 0;
    for (uint32_t k = 0; k < SAMPLES * SAMPLES; k++) {
        const double x = column + (k % SAMPLES + 0.5) / SAMPLES;
        const double y = row + (k / SAMPLES + 0.5) / SAMPLES;
        sum += roughness_square_bend(desc->layer, SHARED_PI * (0.5 - y / HEIGHT),
                                     SHARED_PI * (2 * x / WIDTH - 1));
    }
    const double bend = sqrt(sum / (SAMPLES * SAMPLES));
    return (struct noise_texel){.amplitude_m = (float)(desc->factor * fmax(bend / OF_NOISE, least)),
                                .ridged = (float)desc->ridged};
}

trl_result roughness_make(const trl_context *ctx, const struct roughness_desc *desc,
                          struct noise_map *out)
{
    *out = (struct noise_map){WIDTH, HEIGHT,
                              mem_alloc(ctx, (size_t)WIDTH * HEIGHT, sizeof(struct noise_texel))};
    if (!out->texels) {
        return TRL_ERROR_MEMORY;
    }
#pragma omp parallel for schedule(dynamic, 4)
    for (uint32_t row = 0; row < HEIGHT; row++) {
        for (uint32_t column = 0; column < WIDTH; column++) {
            out->texels[row * WIDTH + column] = measure(desc, column, row);
        }
    }
    return TRL_OK;
}
