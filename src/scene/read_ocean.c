// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

static const struct scene_range per_m = {.min = 0, .max = MEDIUM_MAX_PER_M};

static trl_result read_word_or(const struct scene_node *object, const char *key,
                               const char *const *words, size_t *out)
{
    const struct scene_node node = scene_node_member(object, key);
    return node.value ? scene_node_word(&node, words, out) : TRL_OK;
}

static trl_result read_waves(const struct scene_node *node, struct ocean_waves *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    // In the order of enum ocean_spectrum.
    static const char *const words[] = {"jonswap", "pierson_moskowitz", NULL};
    double from_deg = 240, fetch_km = out->fetch_m / 1000, count = out->count, seed = out->seed;
    size_t spectrum = OCEAN_JONSWAP;
    const struct scene_number numbers[] = {
        {"wind_m_s", {.min = 0, .max = 60}, &out->wind_m_s},
        {"wind_from_deg", {.min = -360, .max = 360}, &from_deg},
        {"fetch_km", {.min = 0, .max = 1e5, .is_min_open = true}, &fetch_km},
        {"mean_square_slope", {.min = 0, .max = 0.5}, &out->mean_square_slope},
        {"whitecaps", {.min = 0, .max = 100}, &out->whitecaps},
        {"count", {.min = 1, .max = OCEAN_MAX_WAVES, .is_whole = true}, &count},
        {"seed", {.min = 0, .max = 4294967295.0, .is_whole = true}, &seed}};
    trl_result result = scene_node_check_keys(
        node, (const char *const[]){"wind_m_s", "wind_from_deg", "fetch_km", "spectrum", "count",
                                    "seed", "mean_square_slope", "whitecaps", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers);
    }
    if (result == TRL_OK) {
        result = read_word_or(node, "spectrum", words, &spectrum);
    }
    if (result == TRL_OK) {
        out->count = (uint32_t)count;
        out->seed = (uint32_t)seed;
    }
    out->wind_from_rad = from_deg * SCENE_RADIANS_PER_DEGREE;
    out->fetch_m = fetch_km * 1000;
    out->spectrum = (enum ocean_spectrum)spectrum;
    return result;
}

// A spectrum in place of the one of the kind of water.
static trl_result read_spectrum_or(const struct scene_node *node, const struct scene_range *range,
                                   struct spectrum *out, bool *is_there)
{
    *is_there = node->value != NULL;
    return node->value ? scene_read_spectrum(node, range, out) : TRL_OK;
}

static trl_result read_liquid(const struct scene_node *node, struct ocean_water *out)
{
    const struct scene_range indices = {.min = 1, .max = 4, .is_min_open = true};
    const struct scene_node absorption = scene_node_member(node, "absorption_per_m");
    const struct scene_node scattering = scene_node_member(node, "scattering_per_m");
    const struct scene_node index = scene_node_member(node, "refractive_index");
    trl_result result =
        read_spectrum_or(&absorption, &per_m, &out->absorption_per_m, &out->has_absorption);
    if (result == TRL_OK) {
        result =
            read_spectrum_or(&scattering, &per_m, &out->scattering_per_m, &out->has_scattering);
    }
    return result == TRL_OK ? read_spectrum_or(&index, &indices, &out->refractive_index,
                                               &out->has_refractive_index)
                            : result;
}

static trl_result read_water(const struct scene_node *node, struct ocean_water *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    // In the order of enum ocean_water_kind.
    static const char *const words[] = {"sea", "fresh", NULL};
    size_t kind = OCEAN_SEA;
    const struct scene_number numbers[] = {
        {"chlorophyll_mg_m3", {.min = 0, .max = 1000}, &out->chlorophyll_mg_m3},
        {"mud_g_m3", {.min = 0, .max = 1e5}, &out->mud_g_m3},
        {"dissolved_per_m_440", {.min = 0, .max = 100}, &out->dissolved_per_m_440}};
    trl_result result = scene_node_check_keys(
        node,
        (const char *const[]){"kind", "absorption_per_m", "scattering_per_m", "refractive_index",
                              "chlorophyll_mg_m3", "mud_g_m3", "dissolved_per_m_440", NULL});
    if (result == TRL_OK) {
        result = read_word_or(node, "kind", words, &kind);
    }
    out->kind = (enum ocean_water_kind)kind;
    if (result == TRL_OK) {
        result = read_liquid(node, out);
    }
    return result == TRL_OK ? scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers)
                            : result;
}

static trl_result read_bed(const struct scene_node *node, struct ocean_bed *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    const struct scene_number depth = {"depth_m", {.min = 0, .max = 1e5}, &out->depth_m};
    const struct scene_range albedos = {.min = 0, .max = 1};
    const struct scene_node albedo = scene_node_member(node, "albedo");
    trl_result result =
        scene_node_check_keys(node, (const char *const[]){"depth_m", "albedo", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(node, &depth, 1);
    }
    return result == TRL_OK && albedo.value ? scene_read_spectrum(&albedo, &albedos, &out->albedo)
                                            : result;
}

static trl_result read_gravity(const struct scene_node *root, double *out)
{
    const struct scene_node planet = scene_node_member(root, "planet");
    const struct scene_number gravity = {
        "gravity_m_s2", {.min = 0, .max = 1e4, .is_min_open = true}, out};
    return scene_read_numbers(&planet, &gravity, 1);
}

// Open sea in a fresh breeze.
static const struct ocean_desc ocean_default = {
    .gravity_m_s2 = 9.81,
    .waves = {.wind_m_s = 8,
              .wind_from_rad = 240 * SCENE_RADIANS_PER_DEGREE,
              .fetch_m = 3e5,
              .spectrum = OCEAN_JONSWAP,
              .count = 60,
              .seed = 1,
              .mean_square_slope = -1,
              .whitecaps = 1},
    .water = {.kind = OCEAN_SEA, .chlorophyll_mg_m3 = 0.1, .dissolved_per_m_440 = 0.01},
    .bed = {.depth_m = -1, .albedo = {.constant = 0.3}}};

trl_result scene_read_ocean(const struct scene_node *root, struct ocean_desc *out)
{
    const struct scene_node ocean = scene_node_member(root, "ocean");
    *out = ocean_default;
    trl_result result = read_gravity(root, &out->gravity_m_s2);
    if (result != TRL_OK || !ocean.value) {
        return result;
    }
    const struct scene_node waves = scene_node_member(&ocean, "waves");
    const struct scene_node water = scene_node_member(&ocean, "water");
    const struct scene_node bed = scene_node_member(&ocean, "bed");
    out->is_there = true;
    result = scene_node_check_keys(&ocean, (const char *const[]){"waves", "water", "bed", NULL});
    if (result == TRL_OK) {
        result = read_waves(&waves, &out->waves);
    }
    if (result == TRL_OK) {
        result = read_water(&water, &out->water);
    }
    return result == TRL_OK ? read_bed(&bed, &out->bed) : result;
}
