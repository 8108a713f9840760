// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <math.h>

#include "scene/read.h"

#define PI 3.14159265358979323846
#define RADIANS_PER_DEGREE (PI / 180)

// Bounds that no planet reaches, so that what is computed from them stays finite in float too.
static const struct scene_range lengths = {.min = 1, .max = 1e9};
static const struct scene_range scale_lengths = {.min = 1e-3, .max = 1e9};
static const struct scene_range altitudes = {.min = -1e9, .max = 1e9};
static const struct scene_range densities = {.min = 0, .max = 1e6};
static const struct scene_range albedos = {.min = 0, .max = 1};
static const struct scene_range irradiances = {.min = 0, .max = MEDIUM_MAX_IRRADIANCE};
static const struct scene_range star_radii_deg = {.min = 0, .max = 90};
static const struct scene_range coronas = {.min = 0, .max = 1000};

static trl_result read_profile_table(const struct scene_node *node, struct profile *out)
{
    const struct scene_table_desc desc = {.x = altitudes, .y = densities, .pair = "[m, density]"};
    struct scene_table table;
    trl_result result = scene_node_table(node, &desc, &table);
    if (result == TRL_OK) {
        result = profile_table_init(node->doc->ctx, table.x, table.y, table.count, out);
    }
    mem_free(node->doc->ctx, table.x);
    return result;
}

static trl_result read_exponential(const struct scene_node *node, struct profile *out)
{
    *out = (struct profile){.kind = PROFILE_EXPONENTIAL};
    const trl_result result =
        scene_node_check_keys(node, (const char *const[]){"scale_height_m", NULL});
    const struct scene_node height = scene_node_member(node, "scale_height_m");
    return result == TRL_OK ? scene_node_number(&height, &scale_lengths, &out->scale_height_m)
                            : result;
}

static trl_result read_tent(const struct scene_node *node, struct profile *out)
{
    *out = (struct profile){.kind = PROFILE_TENT};
    trl_result result =
        scene_node_check_keys(node, (const char *const[]){"centre_m", "half_width_m", NULL});
    const struct scene_node centre = scene_node_member(node, "centre_m");
    const struct scene_node width = scene_node_member(node, "half_width_m");
    if (result == TRL_OK) {
        result = scene_node_number(&centre, &altitudes, &out->centre_m);
    }
    return result == TRL_OK ? scene_node_number(&width, &scale_lengths, &out->half_width_m)
                            : result;
}

trl_result scene_read_profile(const struct scene_node *node, struct profile *out)
{
    *out = (struct profile){.kind = PROFILE_UNIFORM};
    size_t form = 0;
    if (json_is_string(node->value)) {
        return scene_node_word(node, (const char *const[]){"uniform", NULL}, &form);
    }
    const char *const forms[] = {"exponential", "tent", "table", NULL};
    const struct scene_choice choice = {
        .forms = forms, .what = "\"uniform\" or an object with one of exponential, tent, table"};
    const trl_result result = scene_node_choose(node, &choice, &form);
    if (result != TRL_OK) {
        return result;
    }
    const struct scene_node inner = scene_node_member(node, forms[form]);
    if (form == 0) {
        return read_exponential(&inner, out);
    }
    return form == 1 ? read_tent(&inner, out) : read_profile_table(&inner, out);
}

static trl_result read_atmosphere(const struct scene_node *node, struct medium *out)
{
    if (!node->value) {
        // No air; the top only has to be above the ground.
        out->top_radius_m = out->ground_radius_m * 1.01;
        return TRL_OK;
    }
    const char *const keys[] = {"height_m", "constituents", NULL};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node height = scene_node_member(node, "height_m");
    const struct scene_node constituents = scene_node_member(node, "constituents");
    double height_m = 0;
    if (result == TRL_OK) {
        result = scene_node_number(&height, &lengths, &height_m);
    }
    out->top_radius_m = out->ground_radius_m + height_m;
    return result == TRL_OK ? scene_read_constituents(&constituents, out) : result;
}

static trl_result read_star(const struct scene_node *node, struct medium *out)
{
    const char *const keys[] = {"spectral_irradiance", "angular_radius_deg", "corona", NULL};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node irradiance = scene_node_member(node, "spectral_irradiance");
    const struct scene_node radius = scene_node_member(node, "angular_radius_deg");
    const struct scene_node corona = scene_node_member(node, "corona");
    double radius_deg = 0;
    if (result == TRL_OK) {
        result = scene_read_spectrum(&irradiance, &irradiances, &out->star_irradiance);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&radius, &star_radii_deg, &radius_deg);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&corona, &coronas, &out->star_corona);
    }
    out->star_angular_radius_rad = radius_deg * RADIANS_PER_DEGREE;
    return result;
}

static trl_result read_planet(const struct scene_node *node, struct medium *out)
{
    const char *const keys[] = {"radius_m", "ground_albedo", "gravity_m_s2", NULL};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node radius = scene_node_member(node, "radius_m");
    const struct scene_node albedo = scene_node_member(node, "ground_albedo");
    if (result == TRL_OK) {
        result = scene_node_number(&radius, &lengths, &out->ground_radius_m);
    }
    return result == TRL_OK ? scene_read_spectrum(&albedo, &albedos, &out->ground_albedo) : result;
}

trl_result scene_read_medium(const struct scene_node *root, struct medium *out)
{
    const struct scene_node star = scene_node_member(root, "star");
    const struct scene_node planet = scene_node_member(root, "planet");
    const struct scene_node atmosphere = scene_node_member(root, "atmosphere");
    trl_result result = read_star(&star, out);
    if (result == TRL_OK) {
        result = read_planet(&planet, out);
    }
    return result == TRL_OK ? read_atmosphere(&atmosphere, out) : result;
}
