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
