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

double sea_volume_value(const struct sky_sea_volume *volume, const double *spectrum, double nm)
{
    const double first = volume->nm[0], last = volume->nm[SKY_SEA_WAVELENGTHS - 1];
    const struct table_cell at = table_cell_at((nm - first) / (last - first), SKY_SEA_WAVELENGTHS);
    return spectrum[at.below] + (spectrum[at.below + 1] - spectrum[at.below]) * (double)at.part;
}

void sea_volume_rgb(const struct sky_sea_volume *volume, const double *spectrum, double rgb[3])
{
    for (int c = 0; c < 3; c++) {
        rgb[c] = 0;
        for (int k = 0; k < SKY_SEA_WAVELENGTHS; k++) {
            rgb[c] += volume->rgb_from_spectrum[c][k] * spectrum[k];
        }
    }
}

static double determinant(const double m[3][3])
{
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

// Cramer's rule; false when the matrix is singular.
static bool solve(const double m[3][3], const double right[3], double out[3])
{
    const double all = determinant(m);
    for (int c = 0; c < 3; c++) {
        double changed[3][3];
        for (int i = 0; i < 9; i++) {
            changed[i / 3][i % 3] = i % 3 == c ? right[i / 3] : m[i / 3][i % 3];
        }
        out[c] = determinant((const double(*)[3])changed) / all;
    }
    return isfinite(out[0]) && isfinite(out[1]) && isfinite(out[2]);
}

// Least sum of squares of (b - s) / s under the three conditions that b has the colour: by
// Lagrange's multipliers x, b = s + s^2 M^T x with M s^2 M^T x = rgb - M s.
void sea_volume_bands(const struct sky_sea_volume *volume, const struct bands *bands,
                      const double *spectrum, double out[BAND_COUNT])
{
    double m[3][BAND_COUNT], left[3], square[3][3] = {{0}}, x[3];
    sea_volume_rgb(volume, spectrum, left);
    for (int b = 0; b < BAND_COUNT; b++) {
        out[b] = fmax(sea_volume_value(volume, spectrum, bands->nm[b]), (double)LEAST);
    }
    for (int c = 0; c < 3; c++) {
        double white = 0;
        for (int b = 0; b < BAND_COUNT; b++) {
            white += (double)bands->rgb_from_bands[c][b];
        }
        for (int b = 0; b < BAND_COUNT; b++) {
            m[c][b] = (double)bands->rgb_from_bands[c][b] / white;
            left[c] -= m[c][b] * out[b];
        }
    }
    for (int i = 0; i < 9 * BAND_COUNT; i++) {
        const int r = i / 3 % 3, c = i % 3, b = i / 9;
        square[r][c] += m[r][b] * m[c][b] * out[b] * out[b];
    }
    const bool is_solved = solve((const double(*)[3])square, left, x);
    for (int b = 0; b < BAND_COUNT && is_solved; b++) {
        const double more = out[b] * out[b] * (m[0][b] * x[0] + m[1][b] * x[1] + m[2][b] * x[2]);
        out[b] = fmax(out[b] + more, (double)LEAST);
    }
}

static void read_spectrum(const struct sky_sea_volume *volume, int view, int row, int depth,
                          double out[SKY_SEA_WAVELENGTHS])
{
    for (int k = 0; k < SKY_SEA_WAVELENGTHS; k++) {
        out[k] = (double)volume->spectrum[view][row][depth][k];
    }
}

static double channel(const struct sky_sea_volume *volume, const struct bands *bands,
                      const double *spectrum, int b)
{
    double rgb[3];
    sea_volume_rgb(volume, spectrum, rgb);
    return bands ? sea_volume_value(volume, spectrum, bands->nm[b]) : b < 3 ? rgb[b] : 0;
}

// Light without azimuth as logarithms, which depth makes nearly straight lines; the other orders as
// shares of it.
static void fill(const struct sky_sea_volume *volume, const struct bands *bands, int view, int row,
                 float *texels)
{
    const bool is_share = row >= SKY_SEA_ANGLES && row < SKY_SEA_ROWS - 1;
    for (int i = 0; i < SKY_SEA_DEPTHS; i++) {
        double mean[SKY_SEA_WAVELENGTHS], spectrum[SKY_SEA_WAVELENGTHS], value[BAND_COUNT];
        read_spectrum(volume, view, row, i, spectrum);
        read_spectrum(volume, view, row % SKY_SEA_ANGLES, i, mean);
        for (int b = 0; b < BAND_COUNT; b++) {
            value[b] = channel(volume, bands, spectrum, b);
        }
        if (bands && !is_share) {
            sea_volume_bands(volume, bands, spectrum, value);
        }
        for (int b = 0; b < BAND_COUNT; b++) {
            const double even = is_share ? channel(volume, bands, mean, b) : 0;
            texels[i * BAND_COUNT + b] =
                (float)(is_share ? (even > (double)LEAST ? value[b] / even : 0)
                                 : log(fmax(value[b], (double)LEAST)));
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
                   const struct sea_volume_rays *rays, struct sea_volume_light *out)
{
    const double sun = refract(volume, rays->sun_mu), view = refract(volume, rays->view_mu);
    const double range = 1 - volume->critical;
    const struct table_cell v = table_cell_at((view - volume->critical) / range, SKY_SEA_ANGLES);
    const struct table_cell s = table_cell_at((sun - volume->critical) / range, SKY_SEA_ANGLES);
    const struct table_cell d = table_cell_at(depth_code, SKY_SEA_DEPTHS);
    const double sines = sqrt((1 - sun * sun) * (1 - view * view));
    const double along = sines * rays->azimuth_cosine;
    const double factor[SKY_SEA_ORDERS] = {1, along, 2 * along * along - sines * sines};
    *out = (struct sea_volume_light){0};
    for (int n = 0; n < SKY_SEA_WAVELENGTHS * 4; n++) {
        const int k = n / 4, corner_v = n & 1, corner_s = n >> 1 & 1;
        const float(*rows)[SKY_SEA_DEPTHS][SKY_SEA_WAVELENGTHS] =
            volume->spectrum[v.below + corner_v];
        const double share_v = (double)(corner_v ? v.part : 1 - v.part);
        const double share_s = (double)(corner_s ? s.part : 1 - s.part);
        double light[2] = {0, 0};
        for (int m = 0; m < SKY_SEA_ORDERS; m++) {
            const float(*row)[SKY_SEA_WAVELENGTHS] =
                rows[m * SKY_SEA_ANGLES + s.below + corner_s] + d.below;
            light[0] += factor[m] * (double)row[0][k];
            light[1] += factor[m] * (double)row[1][k];
        }
        out->star[k] += share_v * share_s * between(light[0], light[1], (double)d.part);
        if (!corner_s) {
            const float(*row)[SKY_SEA_WAVELENGTHS] = rows[SKY_SEA_ROWS - 1] + d.below;
            out->sky[k] += share_v * between((double)row[0][k], (double)row[1][k], (double)d.part);
        }
    }
}
