// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Compiled with -O3 -ffast-math: hot.
#include "scatter/plane.h"

#include <math.h>
#include <string.h>

// Harmonics up to l = DEGREE: the solver keeps at least these.
enum { DEGREE = 2, SUNS_AT_ONCE = 4 };

// Where nothing absorbs, a plane loses no light and the matrix is singular; the sphere that it
// stands for does. This much is kept at each scattering.
static const double KEPT = 0.999;

// One matrix 1 - K for each azimuth order m, as its factors L (unit diagonal) and U. Unknowns are
// the moments l = m .. DEGREE of level 0, then those of level 1, ...; with m = 0 the last one is
// the irradiance of the ground.
struct plane {
    const trl_context *ctx;
    const struct solution *solution;
    const struct solver_settings *settings;
    int levels;
    int size[DEGREE + 1];
    lanes *matrix[DEGREE + 1];  // [row][column]
    lanes *inverse[DEGREE + 1]; // [row] of the diagonal of U
    int worker_count;
    struct ray *rays; // [worker_count]
    lanes *rows;      // [worker_count][row_size]
    size_t row_size;
    lanes *vectors; // [worker_count][size[0]][SUNS_AT_ONCE]
};

static int unknown(int level, int l, int m)
{
    return level * (DEGREE + 1 - m) + l - m;
}

// row[m][unknown] = what each unknown sends along the ray, in units of its cos(m phi).
LANES_INLINE void fill_ray_rows(const struct plane *p, const struct ray *ray, lanes *const *row)
{
    const struct optics *optics = p->solution->optics;
    const struct moments *moments = &p->solution->moments;
    for (int m = 0; m <= DEGREE; m++) {
        memset(row[m], 0, (size_t)p->size[m] * sizeof(lanes));
    }
    double harmonic[(DEGREE + 1) * (DEGREE + 2) / 2];
    for (int k = 0; k < ray->node_count; k++) {
        const struct ray_node *node = &ray->node[k];
        const lanes attenuation = optics_attenuation(optics, node->column_m);
        const struct moments_levels at = moments_levels_at(moments, node->shell);
        harmonic_values(DEGREE, node->mu, harmonic);
        for (int l = 0; l <= DEGREE; l++) {
            const lanes source =
                optics_source(optics, node->density, l) * attenuation * (float)node->weight_m;
            for (int m = 0; m <= l; m++) {
                const lanes sent = source * (float)harmonic[harmonic_index(l, m)];
                for (int t = 0; t < MOMENTS_TAPS; t++) {
                    row[m][unknown(at.first + t, l, m)] += sent * at.weight[t];
                }
            }
        }
    }
    if (ray->hits_ground) {
        row[0][p->size[0] - 1] +=
            optics->ground_albedo * optics_attenuation(optics, ray->column_m) * (float)(1 / M_PI);
    }
}

// matrix[row] -= factor * ray's row
LANES_INLINE void subtract(lanes *restrict out, const lanes *restrict in, float factor, int count)
{
    for (int k = 0; k < count; k++) {
        out[k] -= in[k] * factor;
    }
}

LANES_CLONES static void fill_level(const struct plane *p, int level, int worker)
{
    const struct optics *optics = p->solution->optics;
    const struct solver_settings *set = p->settings;
    const double radius_m = moments_level_radius(&p->solution->moments, level);
    lanes *row[DEGREE + 1];
    row[0] = p->rows + (size_t)worker * p->row_size;
    for (int m = 1; m <= DEGREE; m++) {
        row[m] = row[m - 1] + p->size[m - 1];
    }
    struct directions directions;
    directions_init(&directions, optics, radius_m, set->zeniths, set->azimuths);
    double harmonic[(DEGREE + 1) * (DEGREE + 2) / 2];
    for (int q = 0; q < directions.zeniths; q++) {
        const struct ray_desc desc = sweep_ray(set, radius_m, directions.mu[q]);
        struct ray *ray = &p->rays[worker];
        ray_init(ray, optics, p->solution->rules, &desc);
        fill_ray_rows(p, ray, row);
        harmonic_values(DEGREE, desc.mu, harmonic);
        for (int m = 0; m <= DEGREE; m++) {
            // The integral of cos(m phi)^2.
            const double weight = KEPT * directions.weight[q] * (m == 0 ? 2 * M_PI : M_PI);
            for (int l = m; l <= DEGREE; l++) {
                subtract(p->matrix[m] + (size_t)unknown(level, l, m) * p->size[m], row[m],
                         (float)(weight * harmonic[harmonic_index(l, m)]), p->size[m]);
            }
        }
        if (level == 0 && desc.mu > 0) {
            subtract(p->matrix[0] + (size_t)(p->size[0] - 1) * p->size[0], row[0],
                     (float)(KEPT * directions.weight[q] * 2 * M_PI * desc.mu), p->size[0]);
        }
    }
}

// Rows of L and U in place, one pivot after the other. No pivots are looked for: the diagonal is
// about 1, the rest about what is scattered again.
LANES_CLONES static void eliminate(const struct plane *p, int m, int pivot, int row)
{
    const int n = p->size[m];
    const lanes *restrict from = p->matrix[m] + (size_t)pivot * n;
    lanes *restrict to = p->matrix[m] + (size_t)row * n;
    const lanes factor = to[pivot] * p->inverse[m][pivot];
    to[pivot] = factor;
    for (int c = pivot + 1; c < n; c++) {
        to[c] -= factor * from[c];
    }
}

static void factorise(struct plane *p, int m)
{
    const int n = p->size[m];
    for (int pivot = 0; pivot < n; pivot++) {
        p->inverse[m][pivot] = 1.0f / p->matrix[m][(size_t)pivot * n + pivot];
#pragma omp parallel for schedule(static) num_threads(p->worker_count)
        for (int row = pivot + 1; row < n; row++) {
            eliminate(p, m, pivot, row);
        }
    }
}

static void fill(struct plane *p)
{
    for (int m = 0; m <= DEGREE; m++) {
        const size_t n = (size_t)p->size[m];
        for (size_t k = 0; k < n; k++) {
            p->matrix[m][k * n + k] = lanes_set(1);
        }
    }
#pragma omp parallel for schedule(dynamic) num_threads(p->worker_count)
    for (int level = 0; level < p->levels; level++) {
        const unsigned state = lanes_flush_denormals();
        fill_level(p, level, lanes_thread());
        lanes_restore(state);
    }
    for (int m = 0; m <= DEGREE; m++) {
        factorise(p, m);
    }
}

static trl_result reserve(struct plane *p)
{
    bool has_memory = true;
    for (int m = 0; m <= DEGREE; m++) {
        p->size[m] = p->levels * (DEGREE + 1 - m) + (m == 0);
        p->row_size += (size_t)p->size[m];
        p->matrix[m] = mem_alloc(p->ctx, (size_t)p->size[m] * (size_t)p->size[m], sizeof(lanes));
        p->inverse[m] = mem_alloc(p->ctx, (size_t)p->size[m], sizeof(lanes));
        has_memory = has_memory && p->matrix[m] && p->inverse[m];
    }
    p->worker_count = lanes_max_threads();
    const size_t workers = (size_t)p->worker_count;
    p->rays = mem_alloc(p->ctx, workers, sizeof *p->rays);
    p->rows = mem_alloc(p->ctx, workers * p->row_size, sizeof(lanes));
    p->vectors = mem_alloc(p->ctx, workers * (size_t)p->size[0] * SUNS_AT_ONCE, sizeof(lanes));
    return has_memory && p->rays && p->rows && p->vectors ? TRL_OK : TRL_ERROR_MEMORY;
}

trl_result plane_create(const trl_context *ctx, const struct solution *solution,
                        const struct solver_settings *settings, struct plane **out)
{
    *out = mem_alloc(ctx, 1, sizeof **out);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    **out = (struct plane){
        .ctx = ctx, .solution = solution, .settings = settings, .levels = settings->levels};
    const trl_result result = reserve(*out);
    if (result != TRL_OK) {
        plane_destroy(ctx, out);
        return result;
    }
    fill(*out);
    return TRL_OK;
}

void plane_destroy(const trl_context *ctx, struct plane **plane)
{
    struct plane *p = *plane;
    if (!p) {
        return;
    }
    for (int m = 0; m <= DEGREE; m++) {
        mem_free(ctx, p->matrix[m]);
        mem_free(ctx, p->inverse[m]);
    }
    mem_free(ctx, p->rays);
    mem_free(ctx, p->rows);
    mem_free(ctx, p->vectors);
    mem_free(ctx, p);
    *plane = NULL;
}

// L then U, for a few suns side by side, so that the matrix is read once for all of them.
LANES_CLONES static void substitute(const struct plane *p, int m, lanes *restrict x)
{
    const int n = p->size[m];
    for (int r = 0; r < n; r++) {
        const lanes *row = p->matrix[m] + (size_t)r * n;
        lanes sum[SUNS_AT_ONCE] = {{0}};
        for (int c = 0; c < r; c++) {
            for (int s = 0; s < SUNS_AT_ONCE; s++) {
                sum[s] += row[c] * x[c * SUNS_AT_ONCE + s];
            }
        }
        for (int s = 0; s < SUNS_AT_ONCE; s++) {
            x[r * SUNS_AT_ONCE + s] -= sum[s];
        }
    }
    for (int r = n - 1; r >= 0; r--) {
        const lanes *row = p->matrix[m] + (size_t)r * n;
        lanes sum[SUNS_AT_ONCE] = {{0}};
        for (int c = r + 1; c < n; c++) {
            for (int s = 0; s < SUNS_AT_ONCE; s++) {
                sum[s] += row[c] * x[c * SUNS_AT_ONCE + s];
            }
        }
        for (int s = 0; s < SUNS_AT_ONCE; s++) {
            x[r * SUNS_AT_ONCE + s] = (x[r * SUNS_AT_ONCE + s] - sum[s]) * p->inverse[m][r];
        }
    }
}

// Moments of a few suns to the vector of unknowns, or back.
static void exchange(const struct plane *p, int m, int sun, struct moments *x, lanes *vector,
                     bool is_back)
{
    const int harmonics = harmonic_count(x->lmax);
    for (int s = 0; s < SUNS_AT_ONCE; s++) {
        if (sun + s >= x->suns) {
            continue;
        }
        for (int level = 0; level < p->levels; level++) {
            lanes *a = x->radiance + ((size_t)level * x->suns + sun + s) * harmonics;
            for (int l = m; l <= DEGREE; l++) {
                lanes *v = &vector[unknown(level, l, m) * SUNS_AT_ONCE + s];
                if (is_back) {
                    a[harmonic_index(l, m)] = *v;
                } else {
                    *v = a[harmonic_index(l, m)];
                }
            }
        }
        if (m == 0) {
            lanes *v = &vector[(p->size[0] - 1) * SUNS_AT_ONCE + s];
            if (is_back) {
                x->irradiance[sun + s] = *v;
            } else {
                *v = x->irradiance[sun + s];
            }
        }
    }
}

void plane_solve(const struct plane *p, struct moments *x)
{
#pragma omp parallel for schedule(dynamic) num_threads(p->worker_count)
    for (int sun = 0; sun < x->suns; sun += SUNS_AT_ONCE) {
        const unsigned state = lanes_flush_denormals();
        lanes *vector = p->vectors + (size_t)lanes_thread() * (size_t)p->size[0] * SUNS_AT_ONCE;
        for (int m = 0; m <= DEGREE; m++) {
            exchange(p, m, sun, x, vector, false);
            substitute(p, m, vector);
            exchange(p, m, sun, x, vector, true);
        }
        lanes_restore(state);
    }
}
