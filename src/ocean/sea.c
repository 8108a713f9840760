// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/sea.h"

#include "ocean/water.h"
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

// Mean cosine of light going down: Gordon, Brown and Jacobs 1975 have 0.75 to 0.95 in the sea.
static const double DOWNWARD_COSINE = 0.85;

// Irradiance reflectance below the surface: deep water 0.33 b_b / (a + b_b) (Morel and Prieur 1977,
// Limnol. Oceanogr. 22), and above a bed of that albedo by Maritorena, Morel and Gentili 1994,
// Limnol. Oceanogr. 39, Eq. 9a.
double sea_water_albedo(const struct ocean_desc *ocean, double depth_m, double nm)
{
    const struct water_optics o = water_optics_at(&ocean->water, nm);
    const double back = o.clear_per_m / 2 + o.particles_per_m * o.backscatter;
    const double sum = fmax(o.absorption_per_m + back, 1e-12);
    const double deep = 0.33 * back / sum;
    const double left = exp(-2 * sum / DOWNWARD_COSINE * depth_m);
    const double below = deep + (spectrum_at(&ocean->bed.albedo, nm) - deep) * left;
    // Light goes back and forth below the surface, whose inner reflectance follows from the outer
    // one by reciprocity.
    const double index = water_refractive_index(&ocean->water, nm);
    const double inner = 1 - (1 - sea_diffuse_reflectance(index)) / (index * index);
    return below / (1 - inner * below) / (index * index);
}
