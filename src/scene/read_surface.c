// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

// In the order of enum layer_kind.
static const char *const kind_keys[] = {"elevation", "colour", "water", "lights",
                                        "normal",    "snow",   NULL};

// What a layer of a kind may say beside its file.
static const char *const extra_keys[][8] = {
    [LAYER_ELEVATION] = {"name", "optional", "feather_deg", "blend", "scale", "offset_m", "sea_bed",
                         NULL},
    [LAYER_COLOUR] = {"name", "optional", "feather_deg", "blend", NULL},
    [LAYER_WATER] = {"name", "optional", "feather_deg", "blend", NULL},
    [LAYER_LIGHTS] = {"name", "optional", "feather_deg", "blend", "radiance_cd_m2", NULL},
    [LAYER_NORMAL] = {"name", "optional", "feather_deg", "blend", NULL},
    [LAYER_SNOW] = {"name", "optional", "feather_deg", "albedo", NULL},
};

static const char *const any_extra_keys[] = {"name",    "optional", "feather_deg",    "blend",
                                             "scale",   "offset_m", "radiance_cd_m2", "albedo",
                                             "sea_bed", NULL};

// In the order of enum layer_blend.
static const char *const blend_words[] = {"over", "add", "multiply", "max", "min", NULL};
static const char *const normal_blend_words[] = {"over", "add", NULL};

static trl_result read_kind(const struct scene_node *node, enum layer_kind *kind)
{
    const struct scene_choice choice = {.forms = kind_keys,
                                        .extra = any_extra_keys,
                                        .what = "an object with one of elevation, colour, water, "
                                                "lights, normal, snow"};
    size_t index = 0;
    const trl_result result = scene_node_choose(node, &choice, &index);
    *kind = (enum layer_kind)index;
    return result;
}

// Keys of another kind of layer are unknown keys of this one.
static trl_result check_extras(const struct scene_node *node, enum layer_kind kind)
{
    const char *known[10] = {kind_keys[kind]};
    for (size_t i = 0; extra_keys[kind][i]; i++) {
        known[i + 1] = extra_keys[kind][i];
    }
    return scene_node_check_keys(node, known);
}

static trl_result read_numbers(const struct scene_node *node, struct layer *out)
{
    const struct scene_range scales = {.min = -1e6, .max = 1e6};
    // Files of radii: the planet's is taken off.
    const struct scene_range offsets = {.min = -1e8, .max = 1e8};
    const struct scene_number numbers[] = {
        {"feather_deg", {.min = 0, .max = 90}, &out->feather_deg},
        {"scale", scales, &out->scale},
        {"offset_m", offsets, &out->offset_m},
        {"radiance_cd_m2", {.min = 0, .max = 1e6}, &out->radiance_cd_m2}};
    return scene_read_numbers(node, numbers, sizeof numbers / sizeof *numbers);
}

static trl_result read_blend(const struct scene_node *node, struct layer *out)
{
    const struct scene_node blend = scene_node_member(node, "blend");
    size_t index = LAYER_BLEND_OVER;
    const trl_result result =
        blend.value
            ? scene_node_word(&blend, out->kind == LAYER_NORMAL ? normal_blend_words : blend_words,
                              &index)
            : TRL_OK;
    out->blend = (enum layer_blend)index;
    return result;
}

static trl_result read_strings(const struct scene_node *node, struct layer *out)
{
    const trl_context *ctx = node->doc->ctx;
    const struct scene_node file = scene_node_member(node, kind_keys[out->kind]);
    const struct scene_node name = scene_node_member(node, "name");
    trl_result result = scene_read_raster_path(&file, &out->path);
    const char *text = json_string_value(file.value);
    if (result == TRL_OK && !(out->file = mem_strdup(ctx, text))) {
        result = TRL_ERROR_MEMORY;
    }
    if (result == TRL_OK && name.value) {
        result = scene_node_string(&name, &text);
    }
    if (result == TRL_OK && !(out->name = mem_strdup(ctx, text))) {
        result = TRL_ERROR_MEMORY;
    }
    return result;
}

// Of deep, fine-grained snow that is a few days old (Wiscombe and Warren 1980, J. Atmos. Sci. 37),
// to 0.02, when missing.
static trl_result read_snow(const struct scene_node *node, struct layer *out)
{
    static const double NM[] = {400, 600, 700, 800}, ALBEDO[] = {0.92, 0.90, 0.87, 0.82};
    const struct scene_node albedo = scene_node_member(node, "albedo");
    if (out->kind != LAYER_SNOW) {
        return TRL_OK;
    }
    return albedo.value ? scene_read_spectrum(&albedo, &(struct scene_range){.min = 0, .max = 1},
                                              &out->albedo)
                        : spectrum_table_init(node->doc->ctx, NM, ALBEDO, 4, &out->albedo);
}

static trl_result read_layer(const struct scene_node *node, struct layer *out)
{
    *out = (struct layer){.scale = 1, .feather_deg = 0.1, .radiance_cd_m2 = 1};
    trl_result result = read_kind(node, &out->kind);
    if (result == TRL_OK) {
        result = check_extras(node, out->kind);
    }
    if (result == TRL_OK) {
        result = read_strings(node, out);
    }
    if (result == TRL_OK) {
        result = read_numbers(node, out);
    }
    if (result == TRL_OK) {
        result = read_blend(node, out);
    }
    if (result == TRL_OK) {
        result = read_snow(node, out);
    }
    const struct scene_node optional = scene_node_member(node, "optional");
    const struct scene_node bed = scene_node_member(node, "sea_bed");
    if (result == TRL_OK) {
        result = scene_node_bool_or(&optional, &out->is_optional);
    }
    return result == TRL_OK ? scene_node_bool_or(&bed, &out->has_bed) : result;
}

// From 39 degrees on, the angle of repose of what is loose, over 17 on both sides together, when
// missing.
static trl_result read_rock(const struct scene_node *node, struct scene_rock *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    const struct scene_node albedo = scene_node_member(node, "albedo");
    const struct scene_range degrees = {.min = 0, .max = 80};
    const struct scene_number numbers[] = {
        {"tint", {.min = 0, .max = 1}, &out->tint},
        {"slope_deg", degrees, &out->slope_deg},
        {"feather_deg", {.min = 0, .max = 80, .is_min_open = true}, &out->feather_deg}};
    *out = (struct scene_rock){.is_there = true, .tint = 0.5, .slope_deg = 39, .feather_deg = 17};
    trl_result result = scene_node_check_keys(
        node, (const char *const[]){"albedo", "tint", "slope_deg", "feather_deg", NULL});
    if (result == TRL_OK) {
        result =
            scene_read_spectrum(&albedo, &(struct scene_range){.min = 0, .max = 1}, &out->albedo);
    }
    return result == TRL_OK ? scene_read_numbers(node, numbers, 3) : result;
}

static trl_result read_detail(const struct scene_node *node, struct scene_detail *out)
{
    if (!node->value) {
        return TRL_OK;
    }
    const struct scene_node rock = scene_node_member(node, "rock");
    const struct scene_number numbers[] = {
        {"roughness", {.min = 0, .max = 10}, &out->roughness},
        {"albedo_variation", {.min = 0, .max = 1}, &out->albedo_variation},
        {"smallest_m", {.min = 0.01, .max = 1e6}, &out->smallest_m}};
    *out = (struct scene_detail){.roughness = 1, .albedo_variation = 0.2, .smallest_m = 0.03};
    trl_result result = scene_node_check_keys(
        node, (const char *const[]){"roughness", "albedo_variation", "smallest_m", "rock", NULL});
    if (result == TRL_OK) {
        result = scene_read_numbers(node, numbers, 3);
    }
    return result == TRL_OK ? read_rock(&rock, &out->rock) : result;
}

trl_result scene_read_layers(const struct scene_node *root, struct trl_scene *out)
{
    const struct scene_node surface = scene_node_member(root, "surface");
    out->exaggeration = 1;
    if (!surface.value) {
        return TRL_OK;
    }
    trl_result result =
        scene_node_check_keys(&surface, (const char *const[]){"layers", "exaggeration", "detail",
                                                              "noise", "climate", "biomes", NULL});
    const struct scene_node noise = scene_node_member(&surface, "noise");
    const struct scene_node layers = scene_node_member(&surface, "layers");
    if (result == TRL_OK) {
        result = scene_read_noise(&noise, &out->noise);
    }
    if (result == TRL_OK) {
        result = scene_read_biomes(&surface, out);
    }
    if (result == TRL_OK && (layers.value || !noise.value)) {
        result = scene_node_check_array(&layers, SCENE_MAX_LAYERS, "a list of layers");
    }
    for (size_t i = 0; result == TRL_OK && i < json_array_size(layers.value); i++) {
        const struct scene_node element = scene_node_element(&layers, i);
        out->layer_count = i + 1;
        result = read_layer(&element, &out->layers[i]);
    }
    const struct scene_range exaggerations = {.min = 0, .is_min_open = true, .max = 1000};
    const struct scene_node exaggeration = scene_node_member(&surface, "exaggeration");
    if (result == TRL_OK) {
        result = scene_node_number_or(&exaggeration, &exaggerations, &out->exaggeration);
    }
    const struct scene_node detail = scene_node_member(&surface, "detail");
    return result == TRL_OK ? read_detail(&detail, &out->detail) : result;
}
