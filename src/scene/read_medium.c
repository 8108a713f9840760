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
static const struct scene_range coefficients = {.min = 0, .max = MEDIUM_MAX_PER_M};
static const struct scene_range albedos = {.min = 0, .max = 1};
static const struct scene_range irradiances = {.min = 0, .max = MEDIUM_MAX_IRRADIANCE};
static const struct scene_range star_radii_deg = {.min = 0, .max = 90};
// A peak narrower than this is a delta function in float.
static const struct scene_range asymmetries = {.min = -0.9999, .max = 0.9999};

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

// Values so small that they sum to nothing cannot be normalised.
static trl_result check_phase_table(const struct scene_node *node, const struct phase *phase)
{
    for (size_t i = 0; i < phase->count; i++) {
        if (!isfinite(phase->value[i])) {
            return scene_node_fail(node, "sums to 0; must have values > 0");
        }
    }
    return TRL_OK;
}

static trl_result read_phase_table(const struct scene_node *node, struct phase *out)
{
    const struct scene_table_desc desc = {
        .x = {.min = 0, .max = 180}, .y = {.min = 0, .max = 1e12}, .pair = "[degrees, value]"};
    struct scene_table table;
    trl_result result = scene_node_table(node, &desc, &table);
    if (result == TRL_OK) {
        for (size_t i = 0; i < table.count; i++) {
            table.x[i] *= RADIANS_PER_DEGREE;
        }
        result = phase_table_init(node->doc->ctx, table.x, table.y, table.count, out);
    }
    mem_free(node->doc->ctx, table.x);
    return result == TRL_OK ? check_phase_table(node, out) : result;
}

static trl_result read_asymmetry(const struct scene_node *node, double *g)
{
    const trl_result result = scene_node_check_keys(node, (const char *const[]){"g", NULL});
    const struct scene_node member = scene_node_member(node, "g");
    return result == TRL_OK ? scene_node_number(&member, &asymmetries, g) : result;
}

trl_result scene_read_phase(const struct scene_node *node, struct phase *out)
{
    *out = (struct phase){.kind = PHASE_ISOTROPIC};
    size_t form = 0;
    if (json_is_string(node->value)) {
        const char *const words[] = {"isotropic", "rayleigh", NULL};
        const trl_result result = scene_node_word(node, words, &form);
        out->kind = form == 0 ? PHASE_ISOTROPIC : PHASE_RAYLEIGH;
        return result;
    }
    const char *const forms[] = {"henyey_greenstein", "cornette_shanks", "table", NULL};
    const struct scene_choice choice = {
        .forms = forms,
        .what = "\"rayleigh\", \"isotropic\" or an object with one of henyey_greenstein, "
                "cornette_shanks, table"};
    const trl_result result = scene_node_choose(node, &choice, &form);
    if (result != TRL_OK) {
        return result;
    }
    const struct scene_node inner = scene_node_member(node, forms[form]);
    if (form == 2) {
        return read_phase_table(&inner, out);
    }
    out->kind = form == 0 ? PHASE_HENYEY_GREENSTEIN : PHASE_CORNETTE_SHANKS;
    return read_asymmetry(&inner, &out->g);
}

static trl_result read_name(const struct scene_node *node, const char *fallback, char **out)
{
    const char *name = fallback;
    const trl_result result = node->value ? scene_node_string(node, &name) : TRL_OK;
    if (result != TRL_OK) {
        return result;
    }
    *out = mem_strdup(node->doc->ctx, name);
    return *out ? TRL_OK : TRL_ERROR_MEMORY;
}

static trl_result read_coefficient(const struct scene_node *node, struct spectrum *out)
{
    return node->value ? scene_read_spectrum(node, &coefficients, out) : TRL_OK;
}

// A constituent that only absorbs needs no phase function.
static trl_result read_constituent(const struct scene_node *node, struct constituent *out)
{
    const char *const keys[] = {"name", "scattering_per_m", "absorption_per_m", "profile", "phase",
                                NULL};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node name = scene_node_member(node, "name");
    const struct scene_node scattering = scene_node_member(node, "scattering_per_m");
    const struct scene_node absorption = scene_node_member(node, "absorption_per_m");
    const struct scene_node profile = scene_node_member(node, "profile");
    const struct scene_node phase = scene_node_member(node, "phase");
    if (result == TRL_OK) {
        result = read_name(&name, "constituent", &out->name);
    }
    if (result == TRL_OK) {
        result = read_coefficient(&scattering, &out->scattering_per_m);
    }
    if (result == TRL_OK) {
        result = read_coefficient(&absorption, &out->absorption_per_m);
    }
    if (result == TRL_OK) {
        result = scene_read_profile(&profile, &out->profile);
    }
    if (result == TRL_OK && (phase.value || scattering.value)) {
        result = scene_read_phase(&phase, &out->phase);
    }
    return result;
}

static trl_result read_constituents(const struct scene_node *node, struct medium *out)
{
    trl_result result =
        scene_node_check_array(node, MEDIUM_MAX_CONSTITUENTS, "a list of constituents");
    for (size_t i = 0; result == TRL_OK && i < json_array_size(node->value); i++) {
        const struct scene_node element = scene_node_element(node, i);
        out->constituent_count = i + 1;
        result = read_constituent(&element, &out->constituents[i]);
    }
    return result;
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
    return result == TRL_OK ? read_constituents(&constituents, out) : result;
}

static trl_result read_star(const struct scene_node *node, struct medium *out)
{
    const char *const keys[] = {"spectral_irradiance", "angular_radius_deg", NULL};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node irradiance = scene_node_member(node, "spectral_irradiance");
    const struct scene_node radius = scene_node_member(node, "angular_radius_deg");
    double radius_deg = 0;
    if (result == TRL_OK) {
        result = scene_read_spectrum(&irradiance, &irradiances, &out->star_irradiance);
    }
    if (result == TRL_OK) {
        result = scene_node_number_or(&radius, &star_radii_deg, &radius_deg);
    }
    out->star_angular_radius_rad = radius_deg * RADIANS_PER_DEGREE;
    return result;
}

static trl_result read_planet(const struct scene_node *node, struct medium *out)
{
    const char *const keys[] = {"radius_m", "ground_albedo", NULL};
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
