// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scene/read.h"

static const struct scene_range coefficients = {.min = 0, .max = MEDIUM_MAX_PER_M};

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
static trl_result read_coefficients(const struct scene_node *node, struct constituent *out,
                                    struct scene_phases *phases)
{
    const struct scene_node scattering = scene_node_member(node, "scattering_per_m");
    const struct scene_node absorption = scene_node_member(node, "absorption_per_m");
    const struct scene_node phase = scene_node_member(node, "phase");
    trl_result result = read_coefficient(&scattering, &out->scattering_per_m);
    if (result == TRL_OK) {
        result = read_coefficient(&absorption, &out->absorption_per_m);
    }
    if (result == TRL_OK && (phase.value || scattering.value)) {
        result = scene_read_phases(&phase, phases);
    }
    return result;
}

static trl_result read_whole(const struct scene_node *node, double height_m,
                             struct constituent *out, struct scene_phases *phases)
{
    const char *const plain_keys[] = {
        "name", "scattering_per_m", "absorption_per_m", "profile", "phase", "mie", NULL};
    const char *const mie_keys[] = {"name", "profile", "mie", NULL};
    const struct scene_node name = scene_node_member(node, "name");
    const struct scene_node profile = scene_node_member(node, "profile");
    const struct scene_node mie = scene_node_member(node, "mie");
    trl_result result = scene_node_check_keys(node, mie.value ? mie_keys : plain_keys);
    if (result == TRL_OK) {
        result = read_name(&name, "constituent", &out->name);
    }
    if (result == TRL_OK && !mie.value) {
        result = read_coefficients(node, out, phases);
    }
    if (result == TRL_OK) {
        result = scene_read_profile(&profile, &out->profile);
    }
    return result == TRL_OK && mie.value ? scene_read_mie(&mie, height_m, out, phases) : result;
}

// The share of a constituent around one of its phase functions, which moves to `out`.
static trl_result copy_share(const trl_context *ctx, const struct constituent *whole,
                             struct scene_phases *phases, size_t index, struct constituent *out)
{
    const struct spectrum_hat hat = spectrum_hat_of(phases->nm, phases->count, index);
    out->phase = phases->phase[index];
    phases->phase[index] = (struct phase){0};
    out->name = mem_printf(ctx, "%s, %g nm", whole->name, phases->nm[index]);
    trl_result result = out->name ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = spectrum_copy(ctx, &whole->scattering_per_m, &out->scattering_per_m);
    }
    if (result == TRL_OK) {
        result = spectrum_copy(ctx, &whole->absorption_per_m, &out->absorption_per_m);
    }
    out->scattering_per_m.hat = out->absorption_per_m.hat = hat;
    return result == TRL_OK ? profile_copy(ctx, &whole->profile, &out->profile) : result;
}

// Phase functions p_k at wavelengths, linear between them, are a sum: sum_k hat_k(nm) p_k. So what
// scatters with them is a sum of constituents with one each, whose coefficients have the hat as a
// factor.
static trl_result append(const struct scene_node *node, struct constituent *whole,
                         struct scene_phases *phases, struct medium *out)
{
    const size_t needed = phases->count > 1 ? phases->count : 1;
    const size_t room = MEDIUM_MAX_CONSTITUENTS - out->constituent_count;
    if (needed > room) {
        return scene_node_fail(node,
                               "counts as %zu constituents, one for each phase function; there is "
                               "room for %zu more of %d",
                               needed, room, MEDIUM_MAX_CONSTITUENTS);
    }
    if (needed == 1) {
        whole->phase = phases->phase[0];
        phases->phase[0] = (struct phase){0};
        out->constituents[out->constituent_count++] = *whole;
        *whole = (struct constituent){0};
        return TRL_OK;
    }
    trl_result result = TRL_OK;
    for (size_t i = 0; i < needed && result == TRL_OK; i++) {
        struct constituent *share = &out->constituents[out->constituent_count++];
        result = copy_share(node->doc->ctx, whole, phases, i, share);
    }
    return result;
}

trl_result scene_read_constituents(const struct scene_node *node, struct medium *out)
{
    const trl_context *ctx = node->doc->ctx;
    const double height_m = out->top_radius_m - out->ground_radius_m;
    trl_result result =
        scene_node_check_array(node, MEDIUM_MAX_CONSTITUENTS, "a list of constituents");
    for (size_t i = 0; result == TRL_OK && i < json_array_size(node->value); i++) {
        const struct scene_node element = scene_node_element(node, i);
        struct constituent whole = {0};
        struct scene_phases phases = {0};
        result = read_whole(&element, height_m, &whole, &phases);
        if (result == TRL_OK) {
            result = append(&element, &whole, &phases, out);
        }
        constituent_finish(ctx, &whole);
        scene_phases_finish(ctx, &phases);
    }
    return result;
}
