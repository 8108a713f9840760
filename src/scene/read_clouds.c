// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

// What a layer is when its type is all that is known.
static const struct cloud_layer DEFAULTS[] = {
    [CLOUD_CUMULUS] = {CLOUD_CUMULUS, 900, 2600, 0.4, 0.04, 8000, 0},
    [CLOUD_STRATUS] = {CLOUD_STRATUS, 600, 1400, 0.8, 0.03, 16000, 0},
    [CLOUD_CIRRUS] = {CLOUD_CIRRUS, 8500, 9500, 0.4, 0.0005, 40000, 0}};
static const char *const TYPES[] = {"cumulus", "stratus", "cirrus", NULL};

static trl_result read_layer(const struct scene_node *node, double height_m,
                             struct cloud_layer *out)
{
    const struct scene_range altitudes = {.min = 0, .max = height_m};
    const struct scene_number numbers[] = {
        {"base_m", altitudes, &out->base_m},
        {"top_m", altitudes, &out->top_m},
        {"cover", {.min = 0, .max = 1}, &out->cover},
        {"extinction_per_m", {.min = 0, .max = 1, .is_min_open = true}, &out->extinction_per_m},
        {"scale_m", {.min = 100, .max = 1e7}, &out->scale_m},
        {"wind_m_s", {.min = -500, .max = 500}, &out->wind_m_s}};
    const struct scene_node type = scene_node_member(node, "type");
    size_t index = CLOUD_CUMULUS;
    trl_result result = scene_node_check_keys(
        node, (const char *const[]){"type", "base_m", "top_m", "cover", "extinction_per_m",
                                    "scale_m", "wind_m_s", NULL});
    if (result == TRL_OK && type.value) {
        result = scene_node_word(&type, TYPES, &index);
    }
    *out = DEFAULTS[index];
    if (result == TRL_OK) {
        result = scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers);
    }
    if (result == TRL_OK && out->top_m > height_m) {
        result = scene_node_fail(node, "its top is at %g m; must be in the air, %g m high",
                                 out->top_m, height_m);
    }
    if (result == TRL_OK && out->top_m < out->base_m + 10) {
        result = scene_node_fail(node, "reaches from %g to %g m; must be 10 m thick at least",
                                 out->base_m, out->top_m);
    }
    return result;
}

// A march takes the layers one after another.
static trl_result check_apart(const struct scene_node *layers, const struct cloud_desc *clouds)
{
    for (size_t i = 1; i < clouds->layer_count; i++) {
        if (clouds->layers[i].base_m < clouds->layers[i - 1].top_m) {
            const struct scene_node layer = scene_node_element(layers, i);
            return scene_node_fail(&layer,
                                   "begins at %g m, below the top of the one before; layers "
                                   "must be listed from below and apart",
                                   clouds->layers[i].base_m);
        }
    }
    return TRL_OK;
}

static trl_result read_layers(const struct scene_node *layers, struct trl_scene *out)
{
    const double height_m = out->medium.top_radius_m - out->medium.ground_radius_m;
    trl_result result = scene_node_check_array(layers, CLOUD_MAX_LAYERS, "a list of layers");
    for (size_t i = 0; result == TRL_OK && i < json_array_size(layers->value); i++) {
        const struct scene_node element = scene_node_element(layers, i);
        result = read_layer(&element, height_m, &out->clouds.layers[i]);
        out->clouds.layer_count = i + 1;
    }
    return result == TRL_OK ? check_apart(layers, &out->clouds) : result;
}

trl_result scene_read_clouds(const struct scene_node *root, struct trl_scene *out)
{
    const struct scene_node clouds = scene_node_member(root, "clouds");
    if (!clouds.value) {
        return TRL_OK;
    }
    const struct scene_number seed = {
        "seed", {.min = 0, .max = 4294967295.0, .is_whole = true}, &out->clouds.seed};
    const struct scene_node layers = scene_node_member(&clouds, "layers");
    const struct scene_node map = scene_node_member(&clouds, "map");
    const struct scene_node optional = scene_node_member(&clouds, "optional");
    bool is_optional = false;
    trl_result result = scene_node_check_keys(
        &clouds, (const char *const[]){"layers", "map", "optional", "seed", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(&clouds, &seed, 1);
    }
    if (result == TRL_OK) {
        result = scene_node_bool_or(&optional, &is_optional);
    }
    if (result == TRL_OK && map.value) {
        result = scene_read_path(&map, &out->clouds.map_path);
    }
    if (result == TRL_OK) {
        result = read_layers(&layers, out);
    }
    if (result == TRL_OK && is_optional && out->clouds.map_path &&
        !scene_path_exists(out->clouds.map_path)) {
        out->clouds.layer_count = 0;
    }
    return result;
}
