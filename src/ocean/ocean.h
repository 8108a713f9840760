// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_OCEAN_H
#define OCEAN_OCEAN_H
// The sea as a scene describes it: plain data of waves, water and bed, from which everything else
// about it follows. docs/scenes.md has the meaning and the defaults of each number.

#include <stdint.h>

#include "spectrum/spectrum.h"

enum ocean_spectrum { OCEAN_JONSWAP, OCEAN_PIERSON_MOSKOWITZ };

enum { OCEAN_MAX_WAVES = 1000 };

struct ocean_waves {
    double wind_m_s;      // 10 m above the water
    double wind_from_rad; // clockwise from north: where it blows from
    double fetch_m;       // over which it has blown
    enum ocean_spectrum spectrum;
    uint32_t count; // 1 to OCEAN_MAX_WAVES
    uint32_t seed;
    double mean_square_slope; // of all waves; below 0: by the wind
    double whitecaps;         // relative to those of sea water in such wind
};

enum ocean_water_kind { OCEAN_SEA, OCEAN_FRESH };

// What the liquid is, and what is in it.
struct ocean_water {
    enum ocean_water_kind kind;
    // In place of those of the kind, of the clear liquid; owned.
    bool has_absorption, has_scattering, has_refractive_index;
    struct spectrum absorption_per_m, scattering_per_m, refractive_index;
    double chlorophyll_mg_m3;
    double mud_g_m3;
    double dissolved_per_m_440; // absorption by dissolved matter at 440 nm
};

struct ocean_bed {
    double depth_m;         // everywhere; below 0: from the heights below the water
    struct spectrum albedo; // Lambertian, below the water; owned
};

struct ocean_desc {
    bool is_there;
    double gravity_m_s2;
    struct ocean_waves waves;
    struct ocean_water water;
    struct ocean_bed bed;
};

// Frees the spectra.
void ocean_desc_finish(const trl_context *ctx, struct ocean_desc *desc);

#endif // OCEAN_OCEAN_H
