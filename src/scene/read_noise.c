// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

// In the order of enum noise_form.
static const char *const form_names[] = {"plain", "ridged", "eroded", NULL};

static trl_result read_form(const struct scene_node *node, int *out)
{
    const struct scene_node form = scene_node_member(node, "form");
    size_t index = (size_t)*out;
    const trl_result result = form.value ? scene_node_word(&form, form_names, &index) : TRL_OK;
    *out = (int)index;
    return result;
}

trl_result scene_read_noise(const struct scene_node *node, struct scene_noise *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    *out = (struct scene_noise){.is_there = true,
                                .form = 2,
                                .octaves = 40,
                                .lacunarity = 2,
                                .hurst = 1,
                                .continents_m = 6e6,
                                .height_m = 4000,
                                .mountains_m = 20000,
                                .amplitude_m = 2500,
                                .smallest_m = 0.03,
                                .level_roughness = 0.25};
    const struct scene_number numbers[] = {
        {"seed", {.min = 0, .max = 4294967295.0, .is_whole = true}, &out->seed},
        {"octaves", {.min = 1, .max = 40, .is_whole = true}, &out->octaves},
        {"lacunarity", {.min = 1.5, .max = 4}, &out->lacunarity},
        {"hurst", {.min = 0.1, .max = 1.5}, &out->hurst},
        {"continents_m", {.min = 1, .max = 1e9}, &out->continents_m},
        {"height_m", {.min = 0, .max = 1e6, .is_min_open = true}, &out->height_m},
        {"mountains_m", {.min = 1, .max = 1e9}, &out->mountains_m},
        {"amplitude_m", {.min = 0, .max = 1e6}, &out->amplitude_m},
        {"smallest_m", {.min = 0.01, .max = 1e6}, &out->smallest_m},
        {"level_roughness", {.min = 0, .max = 1}, &out->level_roughness},
        {"ocean_share", {.min = 0, .max = 1}, &out->ocean_share}};
    trl_result result = scene_node_check_keys(
        node, (const char *const[]){"seed", "form", "octaves", "lacunarity", "hurst",
                                    "continents_m", "height_m", "mountains_m", "amplitude_m",
                                    "smallest_m", "level_roughness", "ocean_share", NULL});
    if (result == TRL_OK) {
        result = read_form(node, &out->form);
    }
    if (result == TRL_OK) {
        result = scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers);
    }
    return result;
}

// {"from": a, "to": b, "feather": c}; what is missing is open.
static trl_result read_range(const struct scene_node *node, const struct scene_range *limits,
                             struct scene_biome_range *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    const struct scene_range feathers = {.min = 0, .max = limits->max, .is_min_open = true};
    const struct scene_number numbers[] = {{"from", *limits, &out->low},
                                           {"to", *limits, &out->high},
                                           {"feather", feathers, &out->feather}};
    const trl_result result =
        scene_node_check_keys(node, (const char *const[]){"from", "to", "feather", NULL});
    return result == TRL_OK ? scene_read_numbers(node, numbers, 3) : result;
}

static trl_result read_biome(const struct scene_node *node, struct scene_biome *out)
{
    static const char *const KEYS[SCENE_BIOME_RANGES] = {"altitude_m", "slope_deg", "latitude_deg",
                                                         "temperature_C", "moisture"};
    static const double FEATHERS[SCENE_BIOME_RANGES] = {200, 8, 6, 4, 0.4};
    static const struct scene_range LIMITS[SCENE_BIOME_RANGES] = {{.min = -1e6, .max = 1e6},
                                                                  {.min = 0, .max = 89},
                                                                  {.min = 0, .max = 90},
                                                                  {.min = -300, .max = 1000},
                                                                  {.min = -1, .max = 1}};
    *out = (struct scene_biome){.variation = 0.15};
    const struct scene_node name = scene_node_member(node, "name");
    const struct scene_node albedo = scene_node_member(node, "albedo");
    const struct scene_node variation = scene_node_member(node, "variation");
    trl_result result = scene_node_check_keys(
        node, (const char *const[]){"name", "albedo", "variation", KEYS[0], KEYS[1], KEYS[2],
                                    KEYS[3], KEYS[4], NULL});
    if (result == TRL_OK && name.value) {
        const char *text;
        result = scene_node_string(&name, &text);
    }
    if (result == TRL_OK) {
        result =
            scene_read_spectrum(&albedo, &(struct scene_range){.min = 0, .max = 1}, &out->albedo);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&variation, &(struct scene_range){.min = 0, .max = 1},
                                      &out->variation);
    }
    for (int i = 0; i < SCENE_BIOME_RANGES && result == TRL_OK; i++) {
        const struct scene_node range = scene_node_member(node, KEYS[i]);
        out->ranges[i] = (struct scene_biome_range){-1e9, 1e9, FEATHERS[i]};
        result = read_range(&range, &LIMITS[i], &out->ranges[i]);
    }
    return result;
}

static trl_result read_climate(const struct scene_node *node, struct scene_climate *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    const struct scene_range degrees = {.min = -273.15, .max = 3000};
    const struct scene_number numbers[] = {
        {"equator_C", degrees, &out->equator_C},
        {"pole_C", degrees, &out->pole_C},
        {"lapse_C_per_km", {.min = 0, .max = 100}, &out->lapse_C_per_km}};
    const trl_result result = scene_node_check_keys(
        node, (const char *const[]){"equator_C", "pole_C", "lapse_C_per_km", NULL});
    return result == TRL_OK ? scene_read_numbers(node, numbers, 3) : result;
}

trl_result scene_read_biomes(const struct scene_node *surface, struct trl_scene *out)
{
    const struct scene_node climate = scene_node_member(surface, "climate");
    const struct scene_node biomes = scene_node_member(surface, "biomes");
    out->climate = (struct scene_climate){27, -25, 6.5};
    trl_result result = read_climate(&climate, &out->climate);
    if (result != TRL_OK || !biomes.value) {
        return result;
    }
    result = scene_node_check_array(&biomes, SCENE_MAX_BIOMES, "a list of biomes");
    for (size_t i = 0; result == TRL_OK && i < json_array_size(biomes.value); i++) {
        const struct scene_node element = scene_node_element(&biomes, i);
        out->biome_count = i + 1;
        result = read_biome(&element, &out->biomes[i]);
    }
    return result;
}
