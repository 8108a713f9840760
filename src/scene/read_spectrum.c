// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "base/file.h"
#include "scene/read.h"
#include "spectrum/cie.h"
#include "spectrum/spectrum_csv.h"

enum { CSV_MAX_BYTES = 16 << 20, CHECKED_WAVELENGTHS = 48 };

#define WAVELENGTH_RANGE                                                                           \
    (struct scene_range)                                                                           \
    {                                                                                              \
        .min = 0, .max = 1e9, .is_min_open = true                                                  \
    }

enum form { FORM_POWER_LAW, FORM_RAYLEIGH, FORM_BLACKBODY, FORM_FILE };
static const char *const form_names[] = {"power_law", "rayleigh", "blackbody", "file", NULL};

static trl_result read_power_law(const struct scene_node *node, struct spectrum *out)
{
    const char *const keys[] = {"at_nm", "value", "exponent", NULL};
    const struct scene_range wavelengths = WAVELENGTH_RANGE;
    const struct scene_range any = {.min = 0, .max = 1e12};
    const struct scene_range exponents = {.min = -100, .max = 100};
    *out = (struct spectrum){.kind = SPECTRUM_POWER_LAW};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node at = scene_node_member(node, "at_nm");
    const struct scene_node value = scene_node_member(node, "value");
    const struct scene_node exponent = scene_node_member(node, "exponent");
    if (result == TRL_OK) {
        result = scene_node_number(&at, &wavelengths, &out->power_law.at_nm);
    }
    if (result == TRL_OK) {
        result = scene_node_number(&value, &any, &out->power_law.value);
    }
    if (result == TRL_OK) {
        result = scene_node_number(&exponent, &exponents, &out->power_law.exponent);
    }
    return result;
}

static trl_result read_rayleigh(const struct scene_node *node, struct spectrum *out)
{
    const char *const keys[] = {"refractive_index", "number_density_per_m3", NULL};
    const struct scene_range indices = {.min = 1, .max = 10};
    const struct scene_range densities = {.min = 1, .max = 1e32};
    *out = (struct spectrum){.kind = SPECTRUM_RAYLEIGH};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node index = scene_node_member(node, "refractive_index");
    const struct scene_node density = scene_node_member(node, "number_density_per_m3");
    if (result == TRL_OK) {
        result = scene_node_number(&index, &indices, &out->rayleigh.refractive_index);
    }
    if (result == TRL_OK) {
        result = scene_node_number(&density, &densities, &out->rayleigh.number_density_per_m3);
    }
    return result;
}

static trl_result read_blackbody(const struct scene_node *node, struct spectrum *out)
{
    const char *const keys[] = {"temperature_K", "total_W_m2", NULL};
    const struct scene_range temperatures = {.min = 1, .max = 1e9};
    const struct scene_range totals = {.min = 0, .max = 1e12};
    *out = (struct spectrum){.kind = SPECTRUM_BLACKBODY};
    trl_result result = scene_node_check_keys(node, keys);
    const struct scene_node temperature = scene_node_member(node, "temperature_K");
    const struct scene_node total = scene_node_member(node, "total_W_m2");
    if (result == TRL_OK) {
        result = scene_node_number(&temperature, &temperatures, &out->blackbody.temperature_K);
    }
    if (result == TRL_OK) {
        result = scene_node_number(&total, &totals, &out->blackbody.total_W_m2);
    }
    return result;
}

static trl_result read_file(const struct scene_node *node, struct spectrum *out)
{
    const trl_context *ctx = node->doc->ctx;
    char *path = NULL;
    char *text = NULL;
    size_t length = 0;
    trl_result result = scene_read_path(node, &path);
    if (result == TRL_OK && !scene_path_exists(path)) {
        result = scene_node_fail(node, "there is no file %s", path);
    }
    if (result == TRL_OK) {
        result = file_read(ctx, path, CSV_MAX_BYTES, &text, &length);
    }
    if (result == TRL_OK) {
        result = spectrum_csv_parse(ctx, text, length, path, out);
    }
    mem_free(ctx, text);
    mem_free(ctx, path);
    return result;
}

static trl_result read_table(const struct scene_node *node, const struct scene_range *range,
                             struct spectrum *out)
{
    const struct scene_table_desc desc = {
        .x = WAVELENGTH_RANGE, .y = *range, .pair = "[nm, value]"};
    struct scene_table table;
    trl_result result = scene_node_table(node, &desc, &table);
    if (result == TRL_OK) {
        result = spectrum_table_init(node->doc->ctx, table.x, table.y, table.count, out);
    }
    mem_free(node->doc->ctx, table.x);
    return result;
}

static trl_result check_value(const struct scene_node *node, const struct scene_range *range,
                              double nm, double value)
{
    if (scene_range_holds(range, value)) {
        return TRL_OK;
    }
    char allowed[128];
    scene_range_describe(range, allowed, sizeof allowed);
    return scene_node_fail(node, "is %.10g at %.10g nm; must be %s", value, nm, allowed);
}

// A table at its knots, a formula at enough wavelengths that a smooth function cannot hide between
// them.
static trl_result check_values(const struct scene_node *node, const struct scene_range *range,
                               const struct spectrum *spectrum)
{
    const bool is_table = spectrum->kind == SPECTRUM_TABLE;
    const size_t count = is_table ? spectrum->table.count : CHECKED_WAVELENGTHS;
    for (size_t i = 0; i < count; i++) {
        const double nm = is_table ? spectrum->table.nm[i]
                                   : CIE_FIRST_NM + (CIE_LAST_NM - CIE_FIRST_NM) * (double)i /
                                                        (CHECKED_WAVELENGTHS - 1);
        const trl_result result = check_value(node, range, nm, spectrum_at(spectrum, nm));
        if (result != TRL_OK) {
            return result;
        }
    }
    return TRL_OK;
}

static trl_result read_form(const struct scene_node *node, struct spectrum *out)
{
    const struct scene_choice choice = {
        .forms = form_names,
        .what = "a number, a list of pairs [nm, value], or an object with one of power_law, "
                "rayleigh, blackbody, file"};
    size_t form = 0;
    const trl_result result = scene_node_choose(node, &choice, &form);
    if (result != TRL_OK) {
        return result;
    }
    const struct scene_node inner = scene_node_member(node, form_names[form]);
    switch ((enum form)form) {
    case FORM_POWER_LAW:
        return read_power_law(&inner, out);
    case FORM_RAYLEIGH:
        return read_rayleigh(&inner, out);
    case FORM_BLACKBODY:
        return read_blackbody(&inner, out);
    case FORM_FILE:
        return read_file(&inner, out);
    }
    return TRL_ERROR_INVALID;
}

trl_result scene_read_spectrum(const struct scene_node *node, const struct scene_range *range,
                               struct spectrum *out)
{
    *out = (struct spectrum){0};
    if (json_is_number(node->value)) {
        return scene_node_number(node, range, &out->constant);
    }
    if (json_is_array(node->value)) {
        return read_table(node, range, out);
    }
    const trl_result result = read_form(node, out);
    return result == TRL_OK ? check_values(node, range, out) : result;
}
