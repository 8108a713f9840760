// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/sea_volume.h"

#include "scatter/table.h"
#include "shared/sea.glsl"

#include <math.h>

_Static_assert((int)SKY_SEA_ANGLES == SEA_ANGLES && (int)SKY_SEA_ORDERS == SEA_ORDERS,
               "what shaders look up");

// Bands below that are no light: logarithms are kept.
static const float LEAST = 1e-7F;

static void find_bands(const struct bands *bands, const float rgb[3], float out[BAND_COUNT])
{
    for (int b = 0; b < BAND_COUNT; b++) {
        out[b] = !bands && b < 3 ? rgb[b] : 0;
        for (int k = 0; bands && k < 3; k++) {
            out[b] += bands->bands_from_rgb[b][k] * rgb[k];
        }
    }
}

// Light without azimuth as logarithms, which depth makes nearly straight lines; the other orders as
// shares of it.
static void fill(const struct sky_sea_volume *volume, const struct bands *bands, int view, int row,
                 float *texels)
{
    const bool is_share = row >= SKY_SEA_ANGLES && row < SKY_SEA_ROWS - 1;
    for (int i = 0; i < SKY_SEA_DEPTHS; i++) {
        float mean[BAND_COUNT], value[BAND_COUNT];
        find_bands(bands, volume->rgb[view][row][i], value);
        find_bands(bands, volume->rgb[view][row % SKY_SEA_ANGLES][i], mean);
        for (int b = 0; b < BAND_COUNT; b++) {
            texels[i * BAND_COUNT + b] = is_share ? (mean[b] > LEAST ? value[b] / mean[b] : 0)
                                                  : logf(fmaxf(value[b], LEAST));
        }
    }
}

trl_result sea_volume_make(struct gpu *gpu, const struct sky_sea_volume *volume,
                           const struct bands *bands, struct gpu_texture *out)
{
    const trl_context *ctx = gpu->ctx;
    const size_t stride = (size_t)SKY_SEA_DEPTHS * BAND_COUNT;
    float *texels = mem_alloc(ctx, (size_t)SKY_SEA_ANGLES * SKY_SEA_ROWS * stride, sizeof *texels);
    if (!texels) {
        return TRL_ERROR_MEMORY;
    }
    for (int line = 0; line < SKY_SEA_ANGLES * SKY_SEA_ROWS; line++) {
        fill(volume, bands, line / SKY_SEA_ROWS, line % SKY_SEA_ROWS,
             texels + (size_t)line * stride);
    }
    const uint32_t size[3] = {SKY_SEA_DEPTHS, SKY_SEA_ROWS, SKY_SEA_ANGLES};
    const trl_result result = sky_make_map(gpu, "water", size, texels, out);
    mem_free(ctx, texels);
    return result;
}

static double refract(const struct sky_sea_volume *volume, double mu)
{
    return sqrt(1 - (1 - mu * mu) * (1 - volume->critical * volume->critical));
}

// Between two depths, as the texture has it: logarithms where there is light.
static double between(double low, double high, double part)
{
    return low > (double)LEAST && high > (double)LEAST ? low * pow(high / low, part)
                                                       : low + (high - low) * part;
}

void sea_volume_at(const struct sky_sea_volume *volume, double depth_code,
                   const struct sea_volume_rays *rays, struct sea_volume_colour *out)
{
    const double sun = refract(volume, rays->sun_mu), view = refract(volume, rays->view_mu);
    const double range = 1 - volume->critical;
    const struct table_cell v = table_cell_at((view - volume->critical) / range, SKY_SEA_ANGLES);
    const struct table_cell s = table_cell_at((sun - volume->critical) / range, SKY_SEA_ANGLES);
    const struct table_cell d = table_cell_at(depth_code, SKY_SEA_DEPTHS);
    const double sines = sqrt((1 - sun * sun) * (1 - view * view));
    const double along = sines * rays->azimuth_cosine;
    const double factor[SKY_SEA_ORDERS] = {1, along, 2 * along * along - sines * sines};
    *out = (struct sea_volume_colour){0};
    for (int k = 0; k < 3 * 4; k++) {
        const int c = k / 4, corner_v = k & 1, corner_s = k >> 1 & 1;
        const float(*rows)[SKY_SEA_DEPTHS][3] = volume->rgb[v.below + corner_v];
        const double share_v = (double)(corner_v ? v.part : 1 - v.part);
        const double share_s = (double)(corner_s ? s.part : 1 - s.part);
        double light[2] = {0, 0};
        for (int m = 0; m < SKY_SEA_ORDERS; m++) {
            const float(*row)[3] = rows[m * SKY_SEA_ANGLES + s.below + corner_s] + d.below;
            light[0] += factor[m] * (double)row[0][c];
            light[1] += factor[m] * (double)row[1][c];
        }
        out->star[c] += share_v * share_s * between(light[0], light[1], (double)d.part);
        if (!corner_s) {
            const float(*row)[3] = rows[SKY_SEA_ROWS - 1] + d.below;
            out->sky[c] += share_v * between((double)row[0][c], (double)row[1][c], (double)d.part);
        }
    }
}
