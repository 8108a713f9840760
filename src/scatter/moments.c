// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// The grids on which the multiply scattered light is kept.
#include "scatter/transport.h"

#include <math.h>

// Twilight ends, for the grid, this many dips of the horizon (seen from the top) below the horizon:
// direct light ends at one dip; light scattered twice or more falls by orders of magnitude on the
// way to the end.
static const double DARKNESS_DIPS = 1.7;
// The sun grid is densest in the middle of twilight and widens over this part of the dip.
static const double TWILIGHT_CENTRE_DIPS = 0.4;
static const double TWILIGHT_WIDTH_DIPS = 0.4;

trl_result moments_init(const trl_context *ctx, const struct optics *optics, int lmax, int levels,
                        int suns, struct moments *out)
{
    *out = (struct moments){.optics = optics, .lmax = lmax, .levels = levels, .suns = suns};
    const double dip_rad = acos(optics->ground_radius_m / optics->top_radius_m) +
                           optics->medium->star_angular_radius_rad;
    out->sun_centre = -sin(fmin(TWILIGHT_CENTRE_DIPS * dip_rad, M_PI_2));
    out->sun_width = fmax(sin(fmin(TWILIGHT_WIDTH_DIPS * dip_rad, M_PI_2)), 1e-3);
    const double darkest = -sin(fmin(DARKNESS_DIPS * dip_rad, M_PI_2));
    out->sun_first = asinh((darkest - out->sun_centre) / out->sun_width);
    const double last = asinh((1 - out->sun_centre) / out->sun_width);
    out->sun_scale = (suns - 1) / (last - out->sun_first);
    const size_t points = (size_t)levels * (size_t)suns;
    out->radiance = mem_alloc(ctx, points * (size_t)harmonic_count(lmax), sizeof(lanes));
    out->irradiance = mem_alloc(ctx, (size_t)suns, sizeof(lanes));
    out->inverse_sun_sine = mem_alloc(ctx, (size_t)suns, sizeof(float));
    if (!out->radiance || !out->irradiance || !out->inverse_sun_sine) {
        moments_finish(ctx, out);
        return TRL_ERROR_MEMORY;
    }
    for (int i = 0; i < suns; i++) {
        const double mu = moments_sun_mu(out, i);
        const double sine = sqrt(fmax(0, 1 - mu * mu));
        out->inverse_sun_sine[i] = sine > 1e-3 ? (float)(1 / sine) : 0;
    }
    return TRL_OK;
}

void moments_finish(const trl_context *ctx, struct moments *moments)
{
    mem_free(ctx, moments->radiance);
    mem_free(ctx, moments->irradiance);
    mem_free(ctx, moments->inverse_sun_sine);
    *moments = (struct moments){0};
}

double moments_sun_mu(const struct moments *moments, int sun)
{
    const double mu = moments->sun_centre +
                      moments->sun_width * sinh(moments->sun_first + sun / moments->sun_scale);
    return fmin(1, mu);
}

double moments_level_radius(const struct moments *moments, int level)
{
    const double shell = (double)level / (moments->levels - 1);
    return moments->optics->ground_radius_m + optics_altitude(moments->optics, shell);
}

// Lagrange's cubic through the four levels around the place, one-sided at the ends: a straight line
// between levels lets light leak along the vertical of dense matter.
struct moments_levels moments_levels_at(const struct moments *m, double shell)
{
    const double position = shell * (m->levels - 1);
    const int below = (int)position - 1;
    const int last = m->levels - MOMENTS_TAPS;
    struct moments_levels at = {.first = below < 0 ? 0 : below < last ? below : last};
    const double x = position - at.first;
    at.weight[0] = (float)(-(x - 1) * (x - 2) * (x - 3) / 6);
    at.weight[1] = (float)(x * (x - 2) * (x - 3) / 2);
    at.weight[2] = (float)(-x * (x - 1) * (x - 3) / 2);
    at.weight[3] = (float)(x * (x - 1) * (x - 2) / 6);
    return at;
}

void moments_add(struct moments *y, const struct moments *x, lanes factor)
{
    const size_t row = (size_t)x->suns * (size_t)harmonic_count(x->lmax);
#pragma omp parallel for schedule(static)
    for (int j = 0; j < x->levels; j++) {
        lanes *out = y->radiance + (size_t)j * row;
        const lanes *in = x->radiance + (size_t)j * row;
        for (size_t k = 0; k < row; k++) {
            out[k] += in[k] * factor;
        }
    }
    for (int i = 0; i < x->suns; i++) {
        y->irradiance[i] += x->irradiance[i] * factor;
    }
}
