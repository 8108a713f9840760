// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/sea.h"

#include "shared/fresnel.glsl"
#include "shared/sea.glsl"

#include <math.h>

double sea_mean_square_slope(const struct ocean_waves *waves)
{
    return waves->mean_square_slope >= 0 ? waves->mean_square_slope
                                         : 0.003 + 0.00512 * waves->wind_m_s;
}

double sea_whitecap_share(const struct ocean_waves *waves)
{
    return fmin(waves->whitecaps * 3.84e-6 * pow(waves->wind_m_s, 3.41), 1);
}

// Less foam than that is none.
static const double LEAST_SHARE = 1e-7;

struct sea_foam_ramp sea_foam_find(double share)
{
    enum { ROUNDS = 60 };
    if (share < LEAST_SHARE) {
        return (struct sea_foam_ramp){1e3, 1};
    }
    double low = -6, high = 6; // above `first` lies the share of all crests
    for (int i = 0; i < ROUNDS; i++) {
        const double middle = 0.5 * (low + high);
        const bool is_more = 0.5 * erfc(middle / sqrt(2)) > share;
        low = is_more ? middle : low;
        high = is_more ? high : middle;
    }
    const double first = low;
    low = 0, high = 2; // wider ramps are so soft that they reach more
    for (int i = 0; i < ROUNDS; i++) {
        const double middle = 0.5 * (low + high);
        // From afar a pixel has the mean of it all.
        const double seen = sea_foam(0, 1, first, middle);
        const bool is_more = seen > SEA_FOAM_DENSITY * share;
        low = is_more ? middle : low;
        high = is_more ? high : middle;
    }
    return (struct sea_foam_ramp){first, low};
}

// Root mean square height over the depth of waves that have all broken: Thornton and Guza 1983.
static const double SURF_GAMMA = 0.42;
// Of a broken wave's length what foam covers, in round numbers.
static const double SURF_SHARE = 0.5;

struct sea_surf sea_surf_find(const struct ocean_waves *waves, double height_m)
{
    // Heights are distributed as Rayleigh's law says: the significant is sqrt(2) times the rms.
    struct sea_surf surf = {.broken_m = height_m / sqrt(2) / SURF_GAMMA};
    const double open = sea_whitecap_share(waves);
    const double broken = fmin(waves->whitecaps, 1) * SURF_SHARE;
    for (int i = 0; i <= SEA_SURF_STEPS; i++) {
        const double share = i < SEA_SURF_STEPS ? broken * pow(4, -i) : 0;
        surf.ramps[i] = sea_foam_find(fmax(share, open));
    }
    return surf;
}

double sea_diffuse_reflectance(double index)
{
    enum { STEPS = 256 };
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        // Uniform in the squared cosine, which weighs by the cosine.
        sum += fresnel_reflectance(sqrt((i + 0.5) / STEPS), index);
    }
    return sum / STEPS;
}
