// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/sea.h"

#include "shared/fresnel.glsl"

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

double sea_refractive_index(const struct ocean_water *water, double nm)
{
    if (water->has_refractive_index) {
        return spectrum_at(&water->refractive_index, nm);
    }
    return water->kind == OCEAN_SEA ? 1.340 : 1.334; // at 20 deg C and 35 g/kg, 589 nm, and without
}

enum { TABLE_FIRST_NM = 380, TABLE_STEP_NM = 10, TABLE_COUNT = 45 };

// Pure water, per m: Pope and Fry 1997, Appl. Opt. 36, to 720 nm; beyond, Smith and Baker 1981,
// Appl. Opt. 20.
static const double pure_absorption[TABLE_COUNT] = {
    0.01137, 0.00851, 0.00663, 0.00473, 0.00454, 0.00495, 0.00635, 0.00922, 0.00979,
    0.0106,  0.0127,  0.0150,  0.0204,  0.0325,  0.0409,  0.0434,  0.0474,  0.0565,
    0.0619,  0.0695,  0.0896,  0.1351,  0.2224,  0.2644,  0.2755,  0.2916,  0.3108,
    0.340,   0.410,   0.439,   0.465,   0.516,   0.624,   0.827,   1.231,   1.799,
    2.38,    2.47,    2.55,    2.51,    2.36,    2.16,    2.07,    2.2,     2.5};

// Absorption of algae relative to that at 440 nm: Prieur and Sathyendranath 1981, Limnol. Oceanogr.
// 26, as 400 to 700 nm of Morel 1991, Prog. Oceanogr. 26.
static const double algae_absorption[TABLE_COUNT] = {
    0.538, 0.612, 0.687, 0.828, 0.913, 0.973, 1.0,   0.944, 0.917, 0.870, 0.798,
    0.750, 0.668, 0.618, 0.528, 0.474, 0.416, 0.357, 0.294, 0.276, 0.291, 0.282,
    0.236, 0.252, 0.276, 0.317, 0.334, 0.356, 0.441, 0.595, 0.502, 0.329, 0.215};

static double table_at(const double table[TABLE_COUNT], double nm)
{
    const double x = fmax(0, fmin((nm - TABLE_FIRST_NM) / TABLE_STEP_NM, TABLE_COUNT - 1.001));
    const int i = (int)x;
    return table[i] + (table[i + 1] - table[i]) * (x - i);
}

static struct sea_optics clear_water(const struct ocean_water *water, double nm)
{
    // Morel 1974, in Optical Aspects of Oceanography: with salt and without.
    const double at_550 = water->kind == OCEAN_SEA ? 19.3e-4 : 14.9e-4;
    struct sea_optics clear = {.absorption = table_at(pure_absorption, nm),
                               .scattering = at_550 * pow(550 / nm, 4.32)};
    if (water->has_absorption) {
        clear.absorption = spectrum_at(&water->absorption_per_m, nm);
    }
    if (water->has_scattering) {
        clear.scattering = spectrum_at(&water->scattering_per_m, nm);
    }
    clear.backscattering = clear.scattering / 2;
    return clear;
}

struct sea_optics sea_optics_at(const struct ocean_water *water, double nm)
{
    struct sea_optics sum = clear_water(water, nm);
    const double algae = water->chlorophyll_mg_m3;
    if (algae > 0) {
        // Morel 1988, J. Geophys. Res. 93, Eq. 16-17, Morel 1991.
        const double scattering = 0.30 * pow(algae, 0.62) * 550 / nm;
        const double back = 0.002 + 0.02 * (0.5 - 0.25 * log10(algae)) * 550 / nm;
        sum.absorption += 0.06 * table_at(algae_absorption, nm) * pow(algae, 0.65);
        sum.scattering += scattering;
        sum.backscattering += scattering * fmax(back, 0.002);
    }
    sum.absorption += water->dissolved_per_m_440 * exp(-0.014 * (nm - 440)); // Bricaud et al. 1981
    // Babin et al. 2003, J. Geophys. Res. 108 and Limnol. Oceanogr. 48: per g of dry matter; a
    // fiftieth of what minerals scatter goes back.
    const double scattering = 0.51 * water->mud_g_m3;
    sum.absorption += 0.041 * exp(-0.0123 * (nm - 443)) * water->mud_g_m3;
    sum.scattering += scattering;
    sum.backscattering += 0.02 * scattering;
    return sum;
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
    const struct sea_optics o = sea_optics_at(&ocean->water, nm);
    const double sum = fmax(o.absorption + o.backscattering, 1e-12);
    const double deep = 0.33 * o.backscattering / sum;
    const double left = exp(-2 * sum / DOWNWARD_COSINE * depth_m);
    const double below = deep + (spectrum_at(&ocean->bed.albedo, nm) - deep) * left;
    // Light goes back and forth below the surface, whose inner reflectance follows from the outer
    // one by reciprocity.
    const double index = sea_refractive_index(&ocean->water, nm);
    const double inner = 1 - (1 - sea_diffuse_reflectance(index)) / (index * index);
    return below / (1 - inner * below) / (index * index);
}
