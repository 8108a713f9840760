// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/volume.h"

#include "scatter/quadrature.h"
#include "shared/fresnel.glsl"

#include <math.h>
#include <string.h>

enum { N = SLAB_NODES, STRIDE = SLAB_MAX, SUN = N, VIEW = N + 1, DIRECTIONS = N + 2 };

// Azimuth orders of what is scattered more than once. Single scattering has all of them.
enum { ORDERS = 12 };

double volume_deep_m(const struct volume_column *column)
{
    return 12 / fmax(column->optics.absorption_per_m, 1e-4);
}

double volume_refract(double air_mu, double index)
{
    return sqrt(1 - (1 - air_mu * air_mu) / (index * index));
}

struct volume_column volume_column_make(const struct ocean_desc *ocean, double depth_m, double nm)
{
    return (struct volume_column){.optics = water_optics_at(&ocean->water, nm),
                                  .index = water_refractive_index(&ocean->water, nm),
                                  .depth_m = depth_m,
                                  .bed_albedo = spectrum_at(&ocean->bed.albedo, nm)};
}

void volume_medium_make(const struct volume_column *column, const struct water_phase *phase,
                        struct slab_medium *out)
{
    const double scattering = column->optics.clear_per_m + column->optics.particles_per_m;
    out->peak = water_phase_moments(phase, SLAB_MOMENTS, out->moment);
    const double kept = scattering * (1 - out->peak);
    out->extinction_per_m = column->optics.absorption_per_m + kept;
    out->albedo = out->extinction_per_m > 0 ? kept / out->extinction_per_m : 0;
}

// Everything that one query needs.
struct query {
    struct volume_column column;
    const struct volume_view *view;
    struct water_phase phase;
    struct slab_medium medium;
    struct slab_grid grid;
    double inner[DIRECTIONS]; // reflectance of the surface from below
    struct slab upper, lower;
    double below[SLAB_MAX * SLAB_MAX]; // reflection by what is below the eye
    double whole[SLAB_MAX * SLAB_MAX]; // by all the water
};

// Radiance of one azimuth order along all directions, going down and up.
struct field {
    double down[DIRECTIONS], up[DIRECTIONS];
};

static void apply(const struct slab_order *order, const double *op, const double *x, double *out)
{
    for (int i = 0; i < DIRECTIONS; i++) {
        for (int k = 0; k < N; k++) {
            out[i] += op[i * STRIDE + k] * slab_weight(order, k) * x[k];
        }
    }
}

// x = (1 - op factor)^-1 x for all directions.
static void close_loop(const struct slab_order *order, const double *op, const double *factor,
                       double *x)
{
    double matrix[N * N], right[N * SLAB_MAX];
    for (int i = 0; i < N; i++) {
        right[i * STRIDE] = x[i];
        for (int k = 0; k < N; k++) {
            matrix[i * N + k] = op[i * STRIDE + k] * slab_weight(order, k) * factor[k];
        }
    }
    slab_solve(matrix, right, 1);
    double solved[DIRECTIONS] = {0};
    for (int k = 0; k < N; k++) {
        solved[k] = factor[k] * right[k * STRIDE];
    }
    apply(order, op, solved, x);
}

// Light at the eye: `entered` is diffuse light just below the surface, `beam` the irradiance of the
// refracted star.
static void find_field(const struct query *q, const struct slab_order *order,
                       const double entered[DIRECTIONS], double beam, struct field *out)
{
    double up[DIRECTIONS] = {0};
    for (int i = 0; i < DIRECTIONS; i++) {
        up[i] = beam * q->whole[i * STRIDE + SUN];
    }
    apply(order, q->whole, entered, up);
    close_loop(order, q->whole, q->inner, up);
    double down[DIRECTIONS];
    for (int i = 0; i < DIRECTIONS; i++) {
        down[i] = entered[i] + q->inner[i] * up[i];
    }
    *out = (struct field){{0}, {0}};
    if (q->view->eye_depth_m <= 0) {
        memcpy(out->up, up, sizeof up);
        memcpy(out->down, down, sizeof down);
        return;
    }
    // D = what passes + R1 U, U = R2 (D + beam).
    for (int i = 0; i < DIRECTIONS; i++) {
        out->down[i] = beam * q->upper.passed[i * STRIDE + SUN] + q->upper.direct[i] * down[i];
    }
    apply(order, q->upper.passed, down, out->down);
    double beam_up[DIRECTIONS], again[SLAB_MAX * SLAB_MAX] = {0}, one[DIRECTIONS];
    for (int i = 0; i < DIRECTIONS; i++) {
        beam_up[i] = beam * q->upper.direct[SUN] * q->below[i * STRIDE + SUN];
        one[i] = 1;
        for (int k = 0; k < N; k++) {
            const double factor = q->upper.reflected[i * STRIDE + k] * slab_weight(order, k);
            for (int j = 0; j < N; j++) {
                again[i * STRIDE + j] += factor * q->below[k * STRIDE + j];
            }
        }
    }
    apply(order, q->upper.reflected, beam_up, out->down);
    close_loop(order, again, one, out->down);
    memcpy(out->up, beam_up, sizeof beam_up);
    apply(order, q->below, out->down, out->up);
}

static double from_field(const struct query *q, const struct field *field)
{
    return q->view->view_mu < 0 ? field->up[VIEW] : field->down[VIEW];
}

// The depth integral of light scattered once, per scattering coefficient and extinction, seen from
// a depth.
static double single_path(const struct query *q, double eye_depth_m, bool goes_up)
{
    const double sun = q->grid.mu[SUN], view = q->grid.mu[VIEW];
    const double eye = q->medium.extinction_per_m * eye_depth_m;
    const double below = q->medium.extinction_per_m * q->column.depth_m - eye;
    if (goes_up) {
        return sun / (sun + view) * exp(-eye / sun) * -expm1(-below * (1 / sun + 1 / view));
    }
    const double difference = eye * (1 / sun - 1 / view);
    return exp(-eye / view) * eye / view *
           (fabs(difference) > 1e-6 ? -expm1(-difference) / difference : 1);
}

// What light scattered once has more than the orders have of it (Nakajima and Tanaka 1988, J.
// Quant. Spectrosc. Radiat. Transfer 40), per that integral.
static double single_difference(const struct query *q, bool goes_up)
{
    const double sun = q->grid.mu[SUN], view = q->grid.mu[VIEW];
    // The star's light and that to the eye go against the directions to the star and of sight.
    const double up = goes_up ? 1 : -1;
    const double cosine =
        -up * sun * view + sqrt((1 - sun * sun) * (1 - view * view)) * cos(q->view->azimuth_rad);
    double cut = 0;
    for (int m = 0; m < ORDERS; m++) {
        double order = 0;
        for (int l = m; l < SLAB_MOMENTS; l++) {
            const int lm = harmonic_index(l, m);
            const double sign = goes_up && (l + m) % 2 ? -1 : 1;
            order +=
                sign * q->medium.moment[l] * q->grid.harmonic[SUN][lm] * q->grid.harmonic[VIEW][lm];
        }
        cut += order * cos(m * q->view->azimuth_rad);
    }
    const double exact = water_phase_value(&q->phase, cosine) / (1 - q->medium.peak);
    return q->medium.albedo * (exact - cut);
}

// Of the light on its straight way, and of that which the surface sends down again.
static double single_correction(const struct query *q)
{
    const double eye_m = q->view->eye_depth_m;
    if (q->view->view_mu < 0) {
        return single_difference(q, true) * single_path(q, eye_m, true);
    }
    const double mirrored =
        q->inner[VIEW] * exp(-q->medium.extinction_per_m * eye_m / q->grid.mu[VIEW]);
    return single_difference(q, false) * single_path(q, eye_m, false) +
           mirrored * single_difference(q, true) * single_path(q, 0, true);
}

static void prepare(const struct volume_column *column, const struct volume_view *view,
                    struct query *q)
{
    q->column = *column;
    const double seen_m = view->eye_depth_m + volume_deep_m(column);
    if (column->depth_m > seen_m) {
        q->column.depth_m = seen_m;
        q->column.bed_albedo = 0;
    }
    q->view = view;
    q->phase = water_phase_make(&column->optics);
    volume_medium_make(column, &q->phase, &q->medium);
    const double seen = fabs(view->view_mu);
    const double others[2] = {volume_refract(view->sun_mu, column->index),
                              view->eye_depth_m > 0 ? seen : volume_refract(seen, column->index)};
    slab_grid_init(volume_refract(0, column->index), others, 2, &q->grid);
    for (int i = 0; i < DIRECTIONS; i++) {
        q->inner[i] = fresnel_reflectance(q->grid.mu[i], 1 / column->index);
    }
}

// Adds one azimuth order.
static void add_order(struct query *q, int m, struct volume_light *sum)
{
    const struct slab_order order = {&q->grid, &q->medium, m};
    const double eye_m = q->view->eye_depth_m;
    slab_make(&order, q->column.depth_m - eye_m, &q->lower);
    slab_add_bed(&order, &q->lower, q->column.bed_albedo, q->below);
    if (eye_m > 0) {
        struct slab bed = {.direct = {0}};
        memcpy(bed.reflected, q->below, sizeof bed.reflected);
        slab_make(&order, eye_m, &q->upper);
        slab_add(&order, &q->upper, &bed, &q->lower);
        memcpy(q->whole, q->lower.reflected, sizeof q->whole);
    } else {
        memcpy(q->whole, q->below, sizeof q->whole);
    }
    struct field field;
    double entered[DIRECTIONS] = {0};
    find_field(q, &order, entered, 1, &field);
    sum->star += from_field(q, &field) * cos(m * q->view->azimuth_rad);
    if (m == 0) {
        for (int i = 0; i < DIRECTIONS; i++) {
            entered[i] = (1 - q->inner[i]) * q->column.index * q->column.index / M_PI;
        }
        find_field(q, &order, entered, 0, &field);
        sum->sky += from_field(q, &field);
    }
}

trl_result volume_radiance(const trl_context *ctx, const struct volume_column *column,
                           const struct volume_view *view, struct volume_light *out)
{
    struct query *q = mem_alloc(ctx, 1, sizeof *q);
    if (!q) {
        return TRL_ERROR_MEMORY;
    }
    prepare(column, view, q);
    *out = (struct volume_light){0};
    for (int m = 0; m < ORDERS; m++) {
        add_order(q, m, out);
    }
    out->star += single_correction(q);
    // Per irradiance above the surface.
    out->star *= (1 - fresnel_reflectance(view->sun_mu, column->index)) / q->grid.mu[SUN];
    if (view->eye_depth_m <= 0) {
        const double leaves = (1 - fresnel_reflectance(-view->view_mu, column->index)) /
                              (column->index * column->index);
        out->star *= leaves;
        out->sky *= leaves;
    }
    mem_free(ctx, q);
    return TRL_OK;
}
