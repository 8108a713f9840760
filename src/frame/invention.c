// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/invention.h"

#include "frame/daylight.h"

#include <math.h>

// The map holds waves longer than four of its texels.
static const double FIRST_TEXELS = 4;

static void describe_noise(const struct trl_scene *scene, struct surface_desc *out)
{
    const struct scene_noise *n = &scene->noise;
    const double radius_m = scene->medium.ground_radius_m;
    const double texel_m = M_PI * radius_m / CONTINENTS_HEIGHT;
    // Octaves are counted from the continents on.
    const double in_map = log(n->continents_m / (FIRST_TEXELS * texel_m)) / log(n->lacunarity);
    out->noise = (struct noise_desc){
        .seed = (uint32_t)n->seed,
        .form = (enum noise_form)n->form,
        .octaves = (int)fmax(1, fmin(NOISE_MAX_OCTAVES, floor(n->octaves - fmax(in_map, 0)))),
        .wavelength_m = fmin(FIRST_TEXELS * texel_m, n->continents_m),
        .mountain_m = n->mountains_m,
        .gully_m = n->mountains_m / 2,
        .lacunarity = n->lacunarity,
        .hurst = n->hurst,
        .smallest_m = n->smallest_m,
        .level_roughness = n->level_roughness,
        .has_sea = n->ocean_share > 0};
    out->continents = (struct continents_desc){.seed = (uint32_t)n->seed,
                                               .radius_m = radius_m,
                                               .wavelength_m = n->continents_m,
                                               .height_m = n->height_m * scene->exaggeration,
                                               .amplitude_m = n->amplitude_m * scene->exaggeration,
                                               .ocean_share = n->ocean_share,
                                               .form = (enum noise_form)n->form};
}

static struct biome_range convert(const struct scene_biome_range *range)
{
    return (struct biome_range){range->low, range->high, range->feather};
}

// Angles as tangents; the feather as it is in the middle of the range's border.
static struct biome_range convert_slope(const struct scene_biome_range *range)
{
    const double degree = M_PI / 180;
    const double middle = range->low > 0 ? range->low : fmin(range->high, 45);
    const double half = range->feather / 2;
    const double feather = tan(fmin(middle + half, 89) * degree) - tan((middle - half) * degree);
    return (struct biome_range){range->low > 0 ? tan(range->low * degree) : -1e9,
                                range->high < 89 ? tan(range->high * degree) : 1e9, feather};
}

static void describe_biomes(const struct trl_scene *scene, struct biomes *out)
{
    out->count = scene->biome_count;
    out->climate = (struct biome_climate){scene->climate.equator_C, scene->climate.pole_C,
                                          scene->climate.lapse_C_per_km / 1000};
    for (size_t i = 0; i < scene->biome_count; i++) {
        const struct scene_biome *from = &scene->biomes[i];
        struct biome *to = &out->list[i];
        daylight_albedo(&scene->medium, &from->albedo, to->albedo);
        to->variation = from->variation;
        to->altitude_m = convert(&from->ranges[0]);
        to->slope = convert_slope(&from->ranges[1]);
        to->latitude_deg = convert(&from->ranges[2]);
        to->temperature_C = convert(&from->ranges[3]);
        to->moisture = convert(&from->ranges[4]);
    }
}

static void describe_detail(const struct trl_scene *scene, struct surface_detail *out)
{
    const struct scene_rock *rock = &scene->detail.rock;
    const double degree = M_PI / 180, half = rock->feather_deg / 2;
    *out = (struct surface_detail){scene->detail.roughness,
                                   scene->detail.albedo_variation,
                                   scene->detail.smallest_m,
                                   {.tint = rock->tint}};
    if (rock->is_there) {
        daylight_albedo(&scene->medium, &rock->albedo, out->rock.albedo);
        out->rock.slopes[0] = tan(fmax(rock->slope_deg - half, 0) * degree);
        out->rock.slopes[1] = tan(fmin(rock->slope_deg + half, 89) * degree);
    }
}

void invention_describe(const struct trl_scene *scene, struct surface_desc *out)
{
    describe_detail(scene, &out->detail);
    if (scene->noise.is_there) {
        describe_noise(scene, out);
        describe_biomes(scene, &out->biomes);
    }
}
