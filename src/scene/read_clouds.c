// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

// What a layer is when its type is all that is known.
static const struct cloud_layer DEFAULTS[] = {
    [CLOUD_CUMULUS] = {CLOUD_CUMULUS, 900, 2600, 0.4, 0.04, 8000, 0, 0, 0.9, CLOUD_EVERYWHERE},
    [CLOUD_STRATUS] = {CLOUD_STRATUS, 600, 1400, 0.8, 0.03, 16000, 0, 0, 0.9, CLOUD_EVERYWHERE},
    [CLOUD_CIRRUS] = {CLOUD_CIRRUS, 8500, 9500, 0.4, 0.001, 40000, 0, 6000, 0.7, CLOUD_EVERYWHERE},
    [CLOUD_FOG] = {CLOUD_FOG, 0, 120, 0.9, 0.015, 5000, 0, 0, 0, CLOUD_EVERYWHERE}};
static const char *const TYPES[] = {"cumulus", "stratus", "cirrus", "fog", NULL};

static trl_result read_belt(const struct scene_node *belt, struct cloud_belt *out)
{
    if (!belt->value) {
        return TRL_OK;
    }
    const double degree = SCENE_RADIANS_PER_DEGREE;
    double south_deg = -90;
    double north_deg = 90;
    double feather_deg = 10;
    const struct scene_number numbers[] = {{"south_deg", {.min = -90, .max = 90}, &south_deg},
                                           {"north_deg", {.min = -90, .max = 90}, &north_deg},
                                           {"feather_deg", {.min = 0.01, .max = 90}, &feather_deg}};
    trl_result result = scene_node_check_keys(
        belt, (const char *const[]){"south_deg", "north_deg", "feather_deg", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(belt, numbers, sizeof numbers / sizeof *numbers);
    }
    if (result == TRL_OK && south_deg > north_deg) {
        result = scene_node_fail(belt,
                                 "reaches from %g to %g degrees; south_deg must not be above "
                                 "north_deg",
                                 south_deg, north_deg);
    }
    *out = (struct cloud_belt){south_deg * degree, north_deg * degree, feather_deg * degree};
    return result;
}

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
        {"wind_m_s", {.min = -500, .max = 500}, &out->wind_m_s},
        {"shear_m", {.min = -1e6, .max = 1e6}, &out->shear_m},
        {"cyclone_cover", {.min = 0, .max = 1}, &out->cyclone_cover}};
    const struct scene_node type = scene_node_member(node, "type");
    const struct scene_node belt = scene_node_member(node, "belt");
    size_t index = CLOUD_CUMULUS;
    trl_result result = scene_node_check_keys(
        node,
        (const char *const[]){"type", "base_m", "top_m", "cover", "extinction_per_m", "scale_m",
                              "wind_m_s", "shear_m", "cyclone_cover", "belt", NULL});
    if (result == TRL_OK && type.value) {
        result = scene_node_word(&type, TYPES, &index);
    }
    *out = DEFAULTS[index];
    if (result == TRL_OK) {
        result = scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers);
    }
    if (result == TRL_OK) {
        result = read_belt(&belt, &out->belt);
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

static trl_result read_cyclone(const struct scene_node *node, double ground_radius_m,
                               struct cloud_cyclone *out)
{
    *out = (struct cloud_cyclone){.radius_m = 500000, .eye_radius_m = 20000};
    double latitude_deg = 20;
    double longitude_deg = 0;
    const struct scene_number numbers[] = {
        {"latitude_deg", {.min = -90, .max = 90}, &latitude_deg},
        {"longitude_deg", {.min = -360, .max = 360}, &longitude_deg},
        {"radius_m", {.min = 1000, .max = ground_radius_m}, &out->radius_m},
        {"eye_radius_m", {.min = 100, .max = ground_radius_m}, &out->eye_radius_m}};
    trl_result result =
        scene_node_check_keys(node, (const char *const[]){"latitude_deg", "longitude_deg",
                                                          "radius_m", "eye_radius_m", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers);
    }
    if (result == TRL_OK && out->eye_radius_m > 0.2 * out->radius_m) {
        result = scene_node_fail(node, "an eye of %g m in a cyclone of %g m; at most a fifth of it",
                                 out->eye_radius_m, out->radius_m);
    }
    out->latitude_rad = latitude_deg * SCENE_RADIANS_PER_DEGREE;
    out->longitude_rad = longitude_deg * SCENE_RADIANS_PER_DEGREE;
    return result;
}

static trl_result read_cyclones(const struct scene_node *cyclones, struct trl_scene *out)
{
    if (!cyclones->value) {
        return TRL_OK;
    }
    trl_result result = scene_node_check_array(cyclones, CLOUD_MAX_CYCLONES, "a list of cyclones");
    for (size_t i = 0; result == TRL_OK && i < json_array_size(cyclones->value); i++) {
        const struct scene_node element = scene_node_element(cyclones, i);
        result = read_cyclone(&element, out->medium.ground_radius_m, &out->clouds.cyclones[i]);
        out->clouds.cyclone_count = i + 1;
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
    const struct scene_number numbers[] = {
        {"seed", {.min = 0, .max = 4294967295.0, .is_whole = true}, &out->clouds.seed},
        {"systems_m", {.min = 0, .max = 1e8}, &out->clouds.systems_m}};
    const struct scene_node layers = scene_node_member(&clouds, "layers");
    const struct scene_node cyclones = scene_node_member(&clouds, "cyclones");
    const struct scene_node map = scene_node_member(&clouds, "map");
    const struct scene_node optional = scene_node_member(&clouds, "optional");
    bool is_optional = false;
    trl_result result = scene_node_check_keys(
        &clouds,
        (const char *const[]){"layers", "cyclones", "map", "optional", "seed", "systems_m", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(&clouds, numbers, sizeof numbers / sizeof *numbers);
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
    if (result == TRL_OK) {
        result = read_cyclones(&cyclones, out);
    }
    if (result == TRL_OK && is_optional && out->clouds.map_path &&
        !scene_path_exists(out->clouds.map_path)) {
        out->clouds.layer_count = 0;
    }
    return result;
}
