// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include <math.h>

#include "scene/read.h"

#define PI 3.14159265358979323846
#define RADIANS_PER_DEGREE (PI / 180)

// A peak narrower than this is a delta function in float.
static const struct scene_range asymmetries = {.min = -0.9999, .max = 0.9999};

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

// A pair [nm, PHASE] of a list with ascending wavelengths.
static trl_result read_pair(const struct scene_node *node, double above_nm,
                            struct scene_phases *out)
{
    const struct scene_range wavelengths = {.min = above_nm, .max = 1e9, .is_min_open = true};
    if (!json_is_array(node->value) || json_array_size(node->value) != 2) {
        return scene_node_fail(node, "must be a pair [nm, phase function]");
    }
    const struct scene_node nm = scene_node_element(node, 0);
    const struct scene_node phase = scene_node_element(node, 1);
    const trl_result result = scene_node_number(&nm, &wavelengths, &out->nm[out->count]);
    // Counted before it is read: what has been read before an error is finished.
    return result == TRL_OK ? scene_read_phase(&phase, &out->phase[out->count++]) : result;
}

static trl_result read_list(const struct scene_node *node, struct scene_phases *out)
{
    trl_result result = scene_node_check_array(node, MEDIUM_MAX_CONSTITUENTS,
                                               "a list of pairs [nm, phase function]");
    if (result == TRL_OK && json_array_size(node->value) == 0) {
        result = scene_node_fail(node, "is empty; must have a pair [nm, phase function]");
    }
    for (size_t i = 0; result == TRL_OK && i < json_array_size(node->value); i++) {
        const struct scene_node element = scene_node_element(node, i);
        result = read_pair(&element, i > 0 ? out->nm[i - 1] : 0, out);
    }
    return result;
}

trl_result scene_read_phases(const struct scene_node *node, struct scene_phases *out)
{
    *out = (struct scene_phases){0};
    const char *const forms[] = {"henyey_greenstein", "cornette_shanks", "table", "by_wavelength",
                                 NULL};
    const struct scene_choice choice = {
        .forms = forms,
        .what = "\"rayleigh\", \"isotropic\" or an object with one of henyey_greenstein, "
                "cornette_shanks, table, by_wavelength"};
    size_t form = 0;
    const trl_result result =
        json_is_string(node->value) ? TRL_OK : scene_node_choose(node, &choice, &form);
    if (result != TRL_OK) {
        return result;
    }
    if (form == 3) {
        const struct scene_node list = scene_node_member(node, "by_wavelength");
        return read_list(&list, out);
    }
    out->count = 1;
    return scene_read_phase(node, &out->phase[0]);
}

void scene_phases_finish(const trl_context *ctx, struct scene_phases *phases)
{
    for (size_t i = 0; i < phases->count; i++) {
        mem_free(ctx, phases->phase[i].angle_rad);
    }
    *phases = (struct scene_phases){0};
}
