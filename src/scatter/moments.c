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
    if (!out->radiance || !out->irradiance) {
        moments_finish(ctx, out);
        return TRL_ERROR_MEMORY;
    }
    return TRL_OK;
}

void moments_finish(const trl_context *ctx, struct moments *moments)
{
    mem_free(ctx, moments->radiance);
    mem_free(ctx, moments->irradiance);
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
