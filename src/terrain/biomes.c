// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/biomes.h"

#include "shared/biome.glsl"

// In the order of the shader's vectors.
static void list_ranges(const struct biome *b, struct biome_range ranges[5])
{
    ranges[0] = b->altitude_m;
    ranges[1] = b->slope;
    ranges[2] = b->latitude_deg;
    ranges[3] = b->temperature_C;
    ranges[4] = b->moisture;
}

void biomes_bind(const struct biomes *biomes, struct gpu_program *program)
{
    float albedo[BIOMES_MAX][4] = {0}, low[BIOMES_MAX][4] = {0}, high[BIOMES_MAX][4] = {0};
    float feather[BIOMES_MAX][4] = {0}, moisture[BIOMES_MAX][4] = {0};
    for (size_t i = 0; i < biomes->count; i++) {
        const struct biome *b = &biomes->list[i];
        struct biome_range ranges[5];
        list_ranges(b, ranges);
        for (int c = 0; c < 4; c++) {
            albedo[i][c] = c < 3 ? b->albedo[c] : (float)b->variation;
            low[i][c] = (float)ranges[c].low;
            high[i][c] = (float)ranges[c].high;
            feather[i][c] = (float)ranges[c].feather;
        }
        moisture[i][0] = (float)ranges[4].low;
        moisture[i][1] = (float)ranges[4].high;
        moisture[i][2] = (float)ranges[4].feather;
    }
    const struct biome_climate *c = &biomes->climate;
    const float climate[4] = {(float)c->equator_C, (float)c->pole_C, (float)c->lapse_C_per_m, 0};
    gpu_program_set_int(program, "u_biome_count", (int32_t)biomes->count);
    gpu_program_set_vec4s(program, "u_biome_albedo", albedo[0], BIOMES_MAX);
    gpu_program_set_vec4s(program, "u_biome_low", low[0], BIOMES_MAX);
    gpu_program_set_vec4s(program, "u_biome_high", high[0], BIOMES_MAX);
    gpu_program_set_vec4s(program, "u_biome_feather", feather[0], BIOMES_MAX);
    gpu_program_set_vec4s(program, "u_biome_moisture", moisture[0], BIOMES_MAX);
    gpu_program_set_vec4(program, "u_biome_climate", climate);
}

void biomes_colour(const struct biomes *biomes, const struct biome_place *place, double rgb[3])
{
    const struct biome_climate *climate = &biomes->climate;
    const double temperature =
        biome_temperature(climate->equator_C, climate->pole_C, sin(place->latitude_rad)) -
        climate->lapse_C_per_m * fmax(place->altitude_m, 0);
    const double values[5] = {place->altitude_m, place->slope,
                              fabs(place->latitude_rad) * (180 / SHARED_PI), temperature,
                              place->moisture};
    for (size_t i = 0; i < biomes->count; i++) {
        const struct biome *b = &biomes->list[i];
        struct biome_range ranges[5];
        list_ranges(b, ranges);
        double part = 1;
        for (int k = 0; k < 5; k++) {
            const struct biome_range *r = &ranges[k];
            const double x = biome_fray(values[k], r->feather, place->tone);
            part *= biome_within(x, r->low, r->high, r->feather);
        }
        const double tone = fmax(1 + b->variation * place->tone, 0.3);
        for (int c = 0; c < 3; c++) {
            rgb[c] += part * ((double)b->albedo[c] * tone - rgb[c]);
        }
    }
}
