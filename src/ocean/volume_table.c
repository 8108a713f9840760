// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/volume.h"

#include "scatter/quadrature.h"
#include "shared/fresnel.glsl"

#include <math.h>
#include <string.h>

enum { N = SLAB_NODES, STRIDE = SLAB_MAX, COUNT = N + VOLUME_ANGLES, OCTAVES = 13 };
_Static_assert(VOLUME_DEPTHS == 2 * OCTAVES + 2, "none, two an octave, and the deep");

// VOLUME_SHALLOWEST_M times 1, 1.5, 2, 3, 4, ...
static double table_depth_m(int i)
{
    return i == 0 ? 0 : VOLUME_SHALLOWEST_M * exp2((i - 1) / 2) * (i % 2 ? 1 : 1.5);
}

static double angle_mu(const struct volume_table *table, int i)
{
    return table->critical + (1 - table->critical) * i / (VOLUME_ANGLES - 1);
}

// One wavelength and one azimuth order on its way through the depths.
struct work {
    struct volume_table *table;
    int wavelength;
    struct water_phase phase;
    struct slab_medium medium;
    struct slab_grid grid;
    double inner[COUNT];
    struct slab now, next, mixed; // depths 2^k, 2^(k + 1), 1.5 2^k
    double reflected[SLAB_MAX * SLAB_MAX];
};

// The order m grows as this to the power m, away from the vertical.
static double sines_of(double a, double b)
{
    return sqrt(fmax((1 - a * a) * (1 - b * b), 0));
}

// Mode m of the exact phase function less what its cut moments have of it.
static double phase_difference(const struct work *w, int m, int sun, int view)
{
    enum { STEPS = 32 };
    const double a = w->grid.mu[N + sun], b = w->grid.mu[N + view];
    const double sines = sines_of(a, b);
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double azimuth = M_PI * (i + 0.5) / STEPS;
        sum += water_phase_value(&w->phase, sines * cos(azimuth) - a * b) * cos(m * azimuth);
    }
    sum *= (m == 0 ? 1.0 : 2.0) / STEPS / (1 - w->medium.peak);
    for (int l = m; l < SLAB_MOMENTS; l++) {
        const int lm = harmonic_index(l, m);
        const double term =
            w->medium.moment[l] * w->grid.harmonic[N + sun][lm] * w->grid.harmonic[N + view][lm];
        sum -= (l + m) % 2 ? -term : term;
    }
    return sum;
}

static double single_correction(const struct work *w, int m, int sun, int view)
{
    const double a = w->grid.mu[N + sun], b = w->grid.mu[N + view];
    return w->medium.albedo * phase_difference(w, m, sun, view) * a / (a + b);
}

// Light that goes up below the surface, for one depth whose reflection is w->reflected.
static void store(struct work *w, const struct slab_order *order, int depth)
{
    // Columns: the suns, then the sky.
    double up[SLAB_MAX * STRIDE] = {0};
    const double index = w->table->index;
    const int columns = VOLUME_ANGLES + (order->m == 0);
    for (int i = 0; i < COUNT; i++) {
        for (int s = 0; s < VOLUME_ANGLES; s++) {
            up[i * STRIDE + s] = w->reflected[i * STRIDE + N + s];
        }
        for (int k = 0; k < N && order->m == 0; k++) {
            up[i * STRIDE + VOLUME_ANGLES] += w->reflected[i * STRIDE + k] * slab_weight(order, k) *
                                              (1 - w->inner[k]) * index * index / M_PI;
        }
    }
    double matrix[N * N];
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < N; k++) {
            matrix[i * N + k] = w->reflected[i * STRIDE + k] * slab_weight(order, k) * w->inner[k];
        }
    }
    slab_solve(matrix, up, columns);
    for (int i = N; i < COUNT; i++) {
        for (int k = 0; k < N; k++) {
            const double factor =
                w->reflected[i * STRIDE + k] * slab_weight(order, k) * w->inner[k];
            for (int c = 0; c < columns; c++) {
                up[i * STRIDE + c] += factor * up[k * STRIDE + c];
            }
        }
    }
    const double extinction = w->medium.extinction_per_m;
    const double depth_m = depth < VOLUME_DEPTHS - 1
                               ? table_depth_m(depth)
                               : volume_deep_m(&w->table->column[w->wavelength]);
    for (int v = 0; v < VOLUME_ANGLES; v++) {
        for (int s = 0; s < VOLUME_ANGLES; s++) {
            const double way = 1 / w->grid.mu[N + s] + 1 / w->grid.mu[N + v];
            const double single =
                single_correction(w, order->m, s, v) * -expm1(-extinction * depth_m * way);
            w->table->star[depth][s][v][order->m][w->wavelength] =
                (float)((up[(N + v) * STRIDE + s] + single) / w->grid.mu[N + s] /
                        pow(sines_of(w->grid.mu[N + s], w->grid.mu[N + v]), order->m));
        }
        if (order->m == 0) {
            w->table->sky[depth][v][w->wavelength] = (float)up[(N + v) * STRIDE + VOLUME_ANGLES];
        }
    }
}

static void fill(struct work *w, int m)
{
    const struct slab_order order = {&w->grid, &w->medium, m};
    const double bed = w->table->column[w->wavelength].bed_albedo;
    slab_make(&order, 0, &w->now);
    slab_add_bed(&order, &w->now, bed, w->reflected);
    store(w, &order, 0);
    struct slab half;
    slab_make(&order, VOLUME_SHALLOWEST_M / 2, &half);
    slab_double(&order, &half, &w->now);
    for (int k = 0; k < OCTAVES; k++) {
        slab_add_bed(&order, &w->now, bed, w->reflected);
        store(w, &order, 1 + 2 * k);
        slab_add(&order, &w->now, &half, &w->mixed);
        slab_add_bed(&order, &w->mixed, bed, w->reflected);
        store(w, &order, 2 + 2 * k);
        slab_double(&order, &w->now, &w->next);
        half = w->now;
        w->now = w->next;
    }
    const double deep_m = volume_deep_m(&w->table->column[w->wavelength]);
    for (double now_m = table_depth_m(2 * OCTAVES + 1); now_m < deep_m; now_m *= 2) {
        slab_double(&order, &w->now, &w->next);
        w->now = w->next;
    }
    memcpy(w->reflected, w->now.reflected, sizeof w->reflected);
    store(w, &order, VOLUME_DEPTHS - 1);
}

static void begin(struct volume_table *table, int wavelength, struct work *w)
{
    const struct volume_column *column = &table->column[wavelength];
    w->table = table;
    w->wavelength = wavelength;
    w->phase = water_phase_make(&column->optics);
    volume_medium_make(column, &w->phase, &w->medium);
    double others[VOLUME_ANGLES];
    for (int i = 0; i < VOLUME_ANGLES; i++) {
        // Straight down has no azimuth.
        others[i] = fmin(angle_mu(table, i), 1 - 1e-4);
    }
    slab_grid_init(table->critical, others, VOLUME_ANGLES, &w->grid);
    for (int i = 0; i < COUNT; i++) {
        w->inner[i] = fresnel_reflectance(w->grid.mu[i], 1 / table->index);
    }
}

// All but the light.
static struct volume_table *describe(const trl_context *ctx, const struct ocean_desc *ocean,
                                     const double *nm, int count)
{
    struct volume_table *table = mem_alloc(ctx, 1, sizeof *table);
    if (table) {
        table->count = count;
        // One for the ways of all wavelengths: from 400 to 700 nm that of water changes by 0.9 %.
        table->index = water_refractive_index(&ocean->water, nm[count / 2]);
        table->critical = volume_refract(0, table->index);
    }
    for (int k = 0; table && k < count; k++) {
        table->nm[k] = nm[k];
        table->column[k] = volume_column_make(ocean, 0, nm[k]);
    }
    return table;
}

static trl_result light_up(const trl_context *ctx, struct volume_table *table)
{
    const int tasks = table->count * VOLUME_ORDERS;
    struct work *works = mem_alloc(ctx, (size_t)tasks, sizeof *works);
    if (!works) {
        return TRL_ERROR_MEMORY;
    }
#pragma omp parallel for schedule(dynamic)
    for (int task = 0; task < tasks; task++) {
        begin(table, task / VOLUME_ORDERS, &works[task]);
        fill(&works[task], task % VOLUME_ORDERS);
    }
    mem_free(ctx, works);
    return TRL_OK;
}

trl_result volume_table_make(const trl_context *ctx, const struct ocean_desc *ocean,
                             const double *nm, int count, struct volume_table **out)
{
    *out = describe(ctx, ocean, nm, count);
    const trl_result result = *out ? light_up(ctx, *out) : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        volume_table_destroy(ctx, out);
    }
    return result;
}

struct volume_kept volume_table_kept(struct volume_table *table)
{
    return (struct volume_kept){"water", table, offsetof(struct volume_table, star), sizeof *table};
}

trl_result volume_table_get(const trl_context *ctx, const struct ocean_desc *ocean,
                            const double *nm, int count, struct volume_table **out)
{
    *out = describe(ctx, ocean, nm, count);
    const struct volume_kept kept = volume_table_kept(*out);
    if (*out && volume_cache_load(ctx, &kept)) {
        return TRL_OK;
    }
    const trl_result result = *out ? light_up(ctx, *out) : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        volume_cache_store(ctx, &kept);
    } else {
        volume_table_destroy(ctx, out);
    }
    return result;
}

void volume_table_destroy(const trl_context *ctx, struct volume_table **table)
{
    mem_free(ctx, *table);
    *table = NULL;
}

struct cell {
    int first;
    double part;
};

// Where a table of stars is read.
struct place {
    struct cell sun, view;
    double factor[VOLUME_ORDERS]; // of each azimuth order
};

static struct cell angle_cell(const struct volume_table *table, double mu)
{
    const double x = (mu - table->critical) / (1 - table->critical) * (VOLUME_ANGLES - 1);
    const int first = x < VOLUME_ANGLES - 2 ? (int)fmax(x, 0) : VOLUME_ANGLES - 2;
    return (struct cell){first, x - first};
}

// Between depths light is about linear in the exponential of twice the depth.
static struct cell depth_cell(const struct volume_table *table, int wavelength, double depth_m,
                              double way)
{
    int first = VOLUME_DEPTHS - 2;
    while (first > 0 && table_depth_m(first) > depth_m) {
        first--;
    }
    const struct water_optics *o = &table->column[wavelength].optics;
    const double rate =
        way * (o->absorption_per_m + o->clear_per_m / 2 + o->particles_per_m * o->backscatter);
    const double low = exp(-rate * table_depth_m(first));
    const double high = first < VOLUME_DEPTHS - 2 ? exp(-rate * table_depth_m(first + 1)) : 0;
    const double part = low > high ? (low - exp(-rate * depth_m)) / (low - high) : 1;
    return (struct cell){first, fmin(fmax(part, 0), 1)};
}

static double star_at(const struct volume_table *t, int depth, int k, const struct place *at)
{
    double sum = 0;
    for (int corner = 0; corner < 4; corner++) {
        const int s = corner & 1, v = corner >> 1;
        const float(*orders)[VOLUME_WAVELENGTHS] =
            t->star[depth][at->sun.first + s][at->view.first + v];
        double light = 0;
        for (int m = 0; m < VOLUME_ORDERS; m++) {
            light += (double)orders[m][k] * at->factor[m];
        }
        sum +=
            light * (s ? at->sun.part : 1 - at->sun.part) * (v ? at->view.part : 1 - at->view.part);
    }
    return sum;
}

static double sky_at(const struct volume_table *t, int depth, int k, struct cell view)
{
    return (double)t->sky[depth][view.first][k] * (1 - view.part) +
           (double)t->sky[depth][view.first + 1][k] * view.part;
}

void volume_table_at(const struct volume_table *table, double depth_m,
                     const struct volume_view *view, struct volume_light out[VOLUME_WAVELENGTHS])
{
    const double sun = volume_refract(view->sun_mu, table->index);
    const double seen = volume_refract(view->view_mu, table->index);
    struct place at = {angle_cell(table, sun), angle_cell(table, seen), {1}};
    for (int m = 1; m < VOLUME_ORDERS; m++) {
        at.factor[m] = pow(sines_of(sun, seen), m) * cos(m * view->azimuth_rad);
    }
    const double passes = 1 - fresnel_reflectance(fabs(view->view_mu), table->index);
    const double enters = 1 - fresnel_reflectance(view->sun_mu, table->index);
    for (int k = 0; k < table->count; k++) {
        const struct cell d = depth_cell(table, k, depth_m, 1 / sun + 1 / seen);
        const double star[2] = {star_at(table, d.first, k, &at),
                                star_at(table, d.first + 1, k, &at)};
        // Radiance goes with the square of the index, of each wavelength its own.
        const double leaves = passes / (table->column[k].index * table->column[k].index);
        out[k] = (struct volume_light){
            .star = leaves * enters * (star[0] + (star[1] - star[0]) * d.part),
            .sky = leaves * (sky_at(table, d.first, k, at.view) * (1 - d.part) +
                             sky_at(table, d.first + 1, k, at.view) * d.part)};
    }
}

void volume_table_entry(const struct volume_table *table, double depth_m, int sun, int view,
                        struct volume_entry *out)
{
    const double way = 1 / angle_mu(table, sun) + 1 / angle_mu(table, view);
    for (int k = 0; k < table->count; k++) {
        const struct cell d = depth_cell(table, k, depth_m, way);
        for (int m = 0; m < VOLUME_ORDERS; m++) {
            const double low = (double)table->star[d.first][sun][view][m][k];
            const double high = (double)table->star[d.first + 1][sun][view][m][k];
            out->star[m][k] = low + (high - low) * d.part;
        }
        const double low = (double)table->sky[d.first][view][k];
        out->sky[k] = low + ((double)table->sky[d.first + 1][view][k] - low) * d.part;
    }
}
