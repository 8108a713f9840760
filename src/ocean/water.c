// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/water.h"

#include <math.h>

// Relative to air, at 20 deg C, with 35 g of salt a kg and without: Quan and Fry 1995, Appl. Opt.
// 34, Eq. 3; from 200 to 1100 nm by Huibers 1997, Appl. Opt. 36.
static double clear_water_index(enum ocean_water_kind kind, double nm)
{
    const double celsius = 20, salt = kind == OCEAN_SEA ? 35 : 0;
    const double l = fmax(200, fmin(nm, 1100));
    const double of_salt = 1.779e-4 - 1.05e-6 * celsius + 1.6e-8 * celsius * celsius;
    return 1.31405 + of_salt * salt - 2.02e-6 * celsius * celsius +
           (15.868 + 0.01155 * salt - 0.00423 * celsius) / l - 4382 / (l * l) +
           1.1455e6 / (l * l * l);
}

double water_refractive_index(const struct ocean_water *water, double nm)
{
    return water->has_refractive_index ? spectrum_at(&water->refractive_index, nm)
                                       : clear_water_index(water->kind, nm);
}

enum { TABLE_FIRST_NM = 380, TABLE_STEP_NM = 10, TABLE_COUNT = 43 };

// Pure water, per m: Pope and Fry 1997, Appl. Opt. 36, to 720 nm; beyond, Smith and Baker 1981,
// Appl. Opt. 20, which end at 800 nm.
static const double pure_absorption[TABLE_COUNT] = {
    0.01137, 0.00851, 0.00663, 0.00473, 0.00454, 0.00495, 0.00635, 0.00922, 0.00979, 0.0106, 0.0127,
    0.0150,  0.0204,  0.0325,  0.0409,  0.0434,  0.0474,  0.0565,  0.0619,  0.0695,  0.0896, 0.1351,
    0.2224,  0.2644,  0.2755,  0.2916,  0.3108,  0.340,   0.410,   0.439,   0.465,   0.516,  0.624,
    0.827,   1.231,   1.799,   2.38,    2.47,    2.55,    2.51,    2.36,    2.16,    2.07};

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

static struct water_optics clear_water(const struct ocean_water *water, double nm)
{
    // Morel 1974, in Optical Aspects of Oceanography: with salt and without.
    const double at_550 = water->kind == OCEAN_SEA ? 19.3e-4 : 14.9e-4;
    return (struct water_optics){
        .absorption_per_m = water->has_absorption ? spectrum_at(&water->absorption_per_m, nm)
                                                  : table_at(pure_absorption, nm),
        .clear_per_m = water->has_scattering ? spectrum_at(&water->scattering_per_m, nm)
                                             : at_550 * pow(550 / nm, 4.32)};
}

struct water_optics water_optics_at(const struct ocean_water *water, double nm)
{
    struct water_optics sum = clear_water(water, nm);
    double back = 0;
    const double algae = water->chlorophyll_mg_m3;
    if (algae > 0) {
        // Morel 1988, J. Geophys. Res. 93, Eq. 16-17, Morel 1991.
        const double scattering = 0.30 * pow(algae, 0.62) * 550 / nm;
        const double share = 0.002 + 0.02 * (0.5 - 0.25 * log10(algae)) * 550 / nm;
        sum.absorption_per_m += 0.06 * table_at(algae_absorption, nm) * pow(algae, 0.65);
        sum.particles_per_m += scattering;
        back += scattering * fmax(share, 0.002);
    }
    // Bricaud, Morel and Prieur 1981, Limnol. Oceanogr. 26.
    sum.absorption_per_m += water->dissolved_per_m_440 * exp(-0.014 * (nm - 440));
    // Babin et al. 2003, J. Geophys. Res. 108 and Limnol. Oceanogr. 48: per g of dry matter; a
    // fiftieth of what minerals scatter goes back.
    const double scattering = 0.51 * water->mud_g_m3;
    sum.absorption_per_m += 0.041 * exp(-0.0123 * (nm - 443)) * water->mud_g_m3;
    sum.particles_per_m += scattering;
    back += 0.02 * scattering;
    sum.backscatter = sum.particles_per_m > 0 ? back / sum.particles_per_m : 0;
    return sum;
}
