// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/roughness.h"

#include "shared/shared.glsl"

#include <math.h>

enum { WIDTH = 512, HEIGHT = 256, SAMPLES = 4 };
// What the ground shows of the quantity that is measured, for noise of amplitude 1 that goes on
// below it. Chosen so that the globe's map of 3.7 km with noise is as rough, from 200 m to 4 km, as
// models of 30 to 90 m of four mountains are: 0.57 to 1.43 times, 0.92 in the mean
// (docs/physics.md, section 26).
static const double OF_NOISE = 0.5;
// The least amplitude relative to the wavelength: what whole metres hide on plains.
static const double LEAST = 0.006;

// Second differences over ROUGHNESS_TEXELS texels' height, along both directions: slopes of the
// ground do not count. Nearer texels of most maps are smoother than the ground.
double roughness_square_bend(const struct terrain_layer *layer, double latitude, double longitude)
{
    const struct layer_frame *f = &layer->frame;
    const struct layer_place p = layer_locate(f, latitude, longitude);
    const int64_t x = (int64_t)floor(p.x + 0.5), y = (int64_t)floor(p.y + 0.5);
    const double columns = f->texel_height / (f->texel_width * fmax(cos(latitude), 1e-3));
    const int64_t up = ROUGHNESS_TEXELS;
    const int64_t step =
        (int64_t)fmax(1, fmin(floor(ROUGHNESS_TEXELS * columns + 0.5), f->width / 4.0));
    const double middle = 2 * layer_texel(layer, x, y);
    const double along = layer_texel(layer, x, y - up) + layer_texel(layer, x, y + up) - middle;
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
