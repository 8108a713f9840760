// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

enum { RAYLEIGH_CANARY = 0x54524131 };

trl_rayleigh_desc trl_rayleigh_desc_default(void)
{
    return (trl_rayleigh_desc){.canary = RAYLEIGH_CANARY,
                               .samples = 5,
                               .wavelengths = 10,
                               .optical_depth = TRL_RAYLEIGH_TEXTURE,
                               .fit_heights = 10,
                               .fit_degree = 5,
                               .has_out_scattering = true,
                               .height_scale = 1};
}

static trl_result read_count(const struct scene_node *object, const char *key,
                             const struct scene_range *range, uint32_t *out)
{
    const struct scene_node node = scene_node_member(object, key);
    double number = *out;
    const trl_result result = scene_node_number_or(&node, range, &number);
    *out = result == TRL_OK ? (uint32_t)number : *out;
    return result;
}

static trl_result read_counts(const struct scene_node *node, trl_rayleigh_desc *out)
{
    const struct scene_range samples = {
        .min = 3, .max = TRL_RAYLEIGH_MAX_SAMPLES, .is_whole = true};
    const struct scene_range wavelengths = {
        .min = 3, .max = TRL_RAYLEIGH_MAX_WAVELENGTHS, .is_whole = true};
    const struct scene_range heights = {
        .min = 2, .max = TRL_RAYLEIGH_MAX_HEIGHTS, .is_whole = true};
    const struct scene_range degree = {.min = 1, .max = TRL_RAYLEIGH_MAX_DEGREE, .is_whole = true};
    trl_result result = read_count(node, "samples", &samples, &out->samples);
    if (result == TRL_OK && out->samples % 2 == 0) {
        const struct scene_node even = scene_node_member(node, "samples");
        result = scene_node_fail(&even, "%u must be odd", (unsigned)out->samples);
    }
    if (result == TRL_OK) {
        result = read_count(node, "wavelengths", &wavelengths, &out->wavelengths);
    }
    if (result == TRL_OK) {
        result = read_count(node, "fit_heights", &heights, &out->fit_heights);
    }
    return result == TRL_OK ? read_count(node, "fit_degree", &degree, &out->fit_degree) : result;
}

static trl_result read_rest(const struct scene_node *node, trl_rayleigh_desc *out)
{
    static const char *const depths[] = {"texture", "fit", NULL}; // as trl_rayleigh_depth
    const struct scene_range scale = {.min = 0, .max = 1000, .is_min_open = true};
    const struct scene_range temperature = {.min = 500, .max = 1e6};
    const struct scene_node depth = scene_node_member(node, "optical_depth");
    const struct scene_node loses = scene_node_member(node, "out_scattering");
    const struct scene_node height = scene_node_member(node, "height_scale");
    const struct scene_node star = scene_node_member(node, "star_temperature_K");
    size_t word = 0;
    trl_result result = depth.value ? scene_node_word(&depth, depths, &word) : TRL_OK;
    out->optical_depth = (trl_rayleigh_depth)word;
    if (result == TRL_OK) {
        result = scene_node_bool_or(&loses, &out->has_out_scattering);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&height, &scale, &out->height_scale);
    }
    return result == TRL_OK ? scene_node_number_or(&star, &temperature, &out->star_temperature_K)
                            : result;
}

trl_result scene_read_rayleigh(const struct scene_node *root, trl_rayleigh_desc *out)
{
    const char *const keys[] = {"samples",      "wavelengths",        "optical_depth",
                                "fit_heights",  "fit_degree",         "out_scattering",
                                "height_scale", "star_temperature_K", NULL};
    const struct scene_node node = scene_node_member(root, "rayleigh");
    *out = trl_rayleigh_desc_default();
    if (!node.value) {
        return TRL_OK;
    }
    trl_result result = scene_node_check_keys(&node, keys);
    if (result == TRL_OK) {
        result = read_counts(&node, out);
    }
    return result == TRL_OK ? read_rest(&node, out) : result;
}
