// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Constituents made of spheres: what they are and how many becomes coefficients and phase
// functions.
#include <math.h>

#include "scatter/mie_population.h"
#include "scene/read.h"
#include "spectrum/cie.h"

// Coefficients are computed at this many wavelengths over the visible range, 20 nm apart.
enum { KNOTS = 25, MAX_PHASES = 8 };
static const double FIRST_NM = 355;
static const double KNOT_NM = 20;

// Where phase functions are computed when the scene does not say.
static const double DEFAULT_PHASE_NM[] = {450, 550, 650};

static const struct scene_range wavelengths = {.min = 200, .max = 5000};

struct mie_input {
    struct spectrum index, absorption_index;
    struct mie_sizes sizes;
    double optical_depth, at_nm;  // at_nm 0: not given
    double number_density_per_m3; // at density 1
    double phase_nm[MAX_PHASES];
    size_t phase_count;
};

static double complex index_at(const struct mie_input *in, double nm)
{
    return mie_complex(spectrum_at(&in->index, nm), spectrum_at(&in->absorption_index, nm));
}

static trl_result read_indices(const struct scene_node *node, struct mie_input *out)
{
    const struct scene_range real = {.min = 0.1, .max = 10};
    const struct scene_range imaginary = {.min = 0, .max = 10};
    const struct scene_node index = scene_node_member(node, "refractive_index");
    const struct scene_node absorption = scene_node_member(node, "absorption_index");
    const trl_result result = scene_read_spectrum(&index, &real, &out->index);
    return result == TRL_OK && absorption.value
               ? scene_read_spectrum(&absorption, &imaginary, &out->absorption_index)
               : result;
}

static trl_result read_sizes(const struct scene_node *node, struct mie_sizes *out)
{
    const char *const forms[] = {"log_normal", "gamma", NULL};
    const struct scene_choice choice = {.forms = forms,
                                        .what = "an object with one of log_normal, gamma"};
    size_t form = 0;
    trl_result result = scene_node_choose(node, &choice, &form);
    if (result != TRL_OK) {
        return result;
    }
    out->kind = form == 0 ? MIE_SIZE_LOG_NORMAL : MIE_SIZE_GAMMA;
    // Narrower ones than 0.002 are not resolved by the radii.
    const struct scene_range radii = {.min = 1e-10, .max = 1e-3};
    const struct scene_range variances = {.min = 0.002, .max = form == 0 ? 3 : 0.45};
    const struct scene_node inner = scene_node_member(node, forms[form]);
    const struct scene_node radius = scene_node_member(&inner, "effective_radius_m");
    const struct scene_node variance = scene_node_member(&inner, "effective_variance");
    result = scene_node_check_keys(
        &inner, (const char *const[]){"effective_radius_m", "effective_variance", NULL});
    if (result == TRL_OK) {
        result = scene_node_number(&radius, &radii, &out->effective_radius_m);
    }
    return result == TRL_OK ? scene_node_number(&variance, &variances, &out->effective_variance)
                            : result;
}

static trl_result read_optical_depth(const struct scene_node *node, struct mie_input *out)
{
    const struct scene_range depths = {.min = 0, .max = 1e4};
    const struct scene_node at = scene_node_member(node, "at_nm");
    const struct scene_node value = scene_node_member(node, "value");
    trl_result result = scene_node_check_keys(node, (const char *const[]){"at_nm", "value", NULL});
    if (result == TRL_OK) {
        result = scene_node_number(&at, &wavelengths, &out->at_nm);
    }
    return result == TRL_OK ? scene_node_number(&value, &depths, &out->optical_depth) : result;
}

static trl_result read_amount(const struct scene_node *node, struct mie_input *out)
{
    const struct scene_range densities = {.min = 0, .max = 1e25};
    const struct scene_node depth = scene_node_member(node, "optical_depth");
    const struct scene_node number = scene_node_member(node, "number_density_per_m3");
    if (!depth.value == !number.value) {
        return scene_node_fail(node,
                               "has %d of the keys optical_depth, number_density_per_m3; "
                               "must have exactly one",
                               depth.value ? 2 : 0);
    }
    return depth.value ? read_optical_depth(&depth, out)
                       : scene_node_number(&number, &densities, &out->number_density_per_m3);
}

static trl_result read_phase_nm(const struct scene_node *node, struct mie_input *out)
{
    if (!node->value) {
        out->phase_count = sizeof DEFAULT_PHASE_NM / sizeof *DEFAULT_PHASE_NM;
        for (size_t i = 0; i < out->phase_count; i++) {
            out->phase_nm[i] = DEFAULT_PHASE_NM[i];
        }
        return TRL_OK;
    }
    trl_result result = scene_node_check_array(node, MAX_PHASES, "a list of wavelengths in nm");
    out->phase_count = json_array_size(node->value);
    if (result == TRL_OK && out->phase_count == 0) {
        result = scene_node_fail(node, "is empty; must have a wavelength in nm");
    }
    for (size_t i = 0; i < out->phase_count && result == TRL_OK; i++) {
        struct scene_range range = wavelengths;
        if (i > 0) {
            range.min = out->phase_nm[i - 1];
            range.is_min_open = true;
        }
        const struct scene_node element = scene_node_element(node, i);
        result = scene_node_number(&element, &range, &out->phase_nm[i]);
    }
    return result;
}

static trl_result read_input(const struct scene_node *node, struct mie_input *out)
{
    const char *const keys[] = {
        "refractive_index", "absorption_index",      "size", "optical_depth",
        "phase_at_nm",      "number_density_per_m3", NULL};
    const struct scene_node size = scene_node_member(node, "size");
    const struct scene_node phase_nm = scene_node_member(node, "phase_at_nm");
    trl_result result = scene_node_check_keys(node, keys);
    if (result == TRL_OK) {
        result = read_indices(node, out);
    }
    if (result == TRL_OK) {
        result = read_sizes(&size, &out->sizes);
    }
    if (result == TRL_OK) {
        result = read_amount(node, out);
    }
    return result == TRL_OK ? read_phase_nm(&phase_nm, out) : result;
}

// Particles per m^3 where the profile is 1.
static trl_result choose_density(const struct scene_node *node, const struct mie_input *in,
                                 double column_m, struct mie_population *population, double *per_m3)
{
    *per_m3 = in->number_density_per_m3;
    if (in->at_nm <= 0) {
        return TRL_OK;
    }
    struct mie_optics optics;
    mie_population_compute(population, in->at_nm, index_at(in, in->at_nm), false, &optics);
    const double depth_per_m3 = column_m * (optics.scattering_m2 + optics.absorption_m2);
    *per_m3 = in->optical_depth / depth_per_m3;
    return isfinite(*per_m3) || in->optical_depth <= 0
               ? TRL_OK
               : scene_node_fail(node, "no number of these spheres has an optical depth: their "
                                       "profile or their extinction is 0");
}

static trl_result make_coefficients(const struct scene_node *node, const struct mie_input *in,
                                    double per_m3, struct mie_population *population,
                                    struct constituent *out)
{
    double nm[KNOTS], scattering[KNOTS], absorption[KNOTS];
    for (int i = 0; i < KNOTS; i++) {
        nm[i] = FIRST_NM + KNOT_NM * i;
        struct mie_optics optics;
        mie_population_compute(population, nm[i], index_at(in, nm[i]), false, &optics);
        scattering[i] = per_m3 * optics.scattering_m2;
        absorption[i] = per_m3 * optics.absorption_m2;
        if (!(scattering[i] + absorption[i] <= MEDIUM_MAX_PER_M)) {
            return scene_node_fail(node, "extinction is %.3g per m at %g nm; at most %g is allowed",
                                   scattering[i] + absorption[i], nm[i], MEDIUM_MAX_PER_M);
        }
    }
    const trl_context *ctx = node->doc->ctx;
    const trl_result result =
        spectrum_table_init(ctx, nm, scattering, KNOTS, &out->scattering_per_m);
    return result == TRL_OK
               ? spectrum_table_init(ctx, nm, absorption, KNOTS, &out->absorption_per_m)
               : result;
}

static trl_result make_phases(const struct scene_node *node, const struct mie_input *in,
                              struct mie_population *population, struct scene_phases *out)
{
    trl_result result = TRL_OK;
    for (size_t i = 0; i < in->phase_count && result == TRL_OK; i++) {
        struct mie_optics optics;
        mie_population_compute(population, in->phase_nm[i], index_at(in, in->phase_nm[i]), true,
                               &optics);
        if (!(optics.intensity[0] > 0)) {
            return scene_node_fail(node, "these spheres scatter nothing at %g nm", in->phase_nm[i]);
        }
        out->nm[i] = in->phase_nm[i];
        result = phase_table_init(node->doc->ctx, population->angle_rad, optics.intensity,
                                  MIE_ANGLES, &out->phase[out->count++]);
    }
    return result;
}

static trl_result make(const struct scene_node *node, const struct mie_input *in, double height_m,
                       struct constituent *out, struct scene_phases *phases)
{
    const trl_context *ctx = node->doc->ctx;
    struct mie_population *population = mem_alloc(ctx, 1, sizeof *population);
    if (!population) {
        return TRL_ERROR_MEMORY;
    }
    const double shortest_nm =
        fmin(FIRST_NM, fmin(in->phase_nm[0], in->at_nm > 0 ? in->at_nm : FIRST_NM));
    double largest_size = 0, per_m3 = 0;
    trl_result result =
        mie_population_init(ctx, &in->sizes, shortest_nm, &largest_size, population);
    if (result == TRL_ERROR_UNSUPPORTED) {
        result = scene_node_fail(node,
                                 "the largest spheres measure %.4g wavelengths around; at most "
                                 "%g can be computed",
                                 largest_size, MIE_MAX_SIZE);
    }
    if (result == TRL_OK) {
        result = choose_density(node, in, profile_column_m(&out->profile, height_m), population,
                                &per_m3);
    }
    if (result == TRL_OK) {
        result = make_coefficients(node, in, per_m3, population, out);
    }
    if (result == TRL_OK) {
        result = make_phases(node, in, population, phases);
    }
    mie_population_finish(ctx, population);
    mem_free(ctx, population);
    return result;
}

trl_result scene_read_mie(const struct scene_node *node, double height_m, struct constituent *out,
                          struct scene_phases *phases)
{
    struct mie_input in = {0};
    trl_result result = read_input(node, &in);
    if (result == TRL_OK) {
        result = make(node, &in, height_m, out, phases);
    }
    spectrum_finish(node->doc->ctx, &in.index);
    spectrum_finish(node->doc->ctx, &in.absorption_index);
    return result;
}
