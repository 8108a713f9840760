// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_BIOMES_H
#define TERRAIN_BIOMES_H
// Colours of made-up ground by altitude, slope, latitude, temperature and moisture.

#include "gpu/program.h"

enum { BIOMES_MAX = 16 };

// From `low` to `high`, with a smooth border of the width `feather` (> 0) around both ends.
struct biome_range {
    double low, high, feather;
};

struct biome {
    float albedo[3];  // linear sRGB
    double variation; // of the albedo, with the relief
    struct biome_range altitude_m;
    struct biome_range slope;        // tangents
    struct biome_range latitude_deg; // of both hemispheres
    struct biome_range temperature_C;
    struct biome_range moisture; // -1 dry to 1 wet
};

// Mean temperature over the year at altitude 0.
struct biome_climate {
    double equator_C, pole_C;
    double lapse_C_per_m;
};

struct biomes {
    size_t count;                  // 0: none
    struct biome list[BIOMES_MAX]; // later ones lie over earlier ones
    struct biome_climate climate;
};

// Hands them to a program that includes terrain/biomes.glsl.
void biomes_bind(const struct biomes *biomes, struct gpu_program *program);

struct biome_place {
    double altitude_m, slope, latitude_rad, moisture, tone;
};

// Linear sRGB, over what stands in it before.
void biomes_colour(const struct biomes *biomes, const struct biome_place *place, double rgb[3]);

#endif // TERRAIN_BIOMES_H
