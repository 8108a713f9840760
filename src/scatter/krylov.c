// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/krylov.h"

#include <math.h>
#include <string.h>

// When the basis is full the iteration starts again from where it is, which costs steps: dense
// white planets took 29 in a row, and did not end in 200 with a basis of 12. Vectors are made when
// they are needed, as many as fit into this.
enum { MAX_BASIS = 48, LEAST_BASIS = 12 };
static const size_t BASIS_BYTES = (size_t)512 << 20;

// Light falls by orders of magnitude into the night, and each sun is to be right by itself: rows
// are weighed by what they hold, but no row by less than this part of its brighter neighbour.
// Nor is the deepest night worth steps: in dense matter light gets there from row to row, by
// diffusion, one step after the other.
static const double DARKER = 0.3;
static const double NIGHT = 1e-6; // of the brightest
static const double DARK = 1e-25;

// One number for each wavelength.
struct numbers {
    double of[LANES];
};

struct krylov {
    const trl_context *ctx;
    struct sweep *sweep;
    const struct plane *plane;
    const struct solver_settings *settings;
    struct moments basis[MAX_BASIS + 1];
    struct moments first;                       // b
    lanes *weight;                              // [suns] of the inner product
    lanes *partial;                             // [levels]
    struct numbers h[MAX_BASIS + 1][MAX_BASIS]; // Hessenberg, made triangular
    struct numbers cosine[MAX_BASIS], sine[MAX_BASIS];
    struct numbers g[MAX_BASIS + 1];
    double done;
    int most; // vectors of the basis
};

static int count_vectors(const struct moments *m)
{
    const size_t bytes =
        (size_t)m->levels * (size_t)m->suns * (size_t)harmonic_count(m->lmax) * sizeof(lanes);
    const size_t fit = BASIS_BYTES / bytes;
    return fit < LEAST_BASIS ? LEAST_BASIS : fit > MAX_BASIS ? MAX_BASIS : (int)fit;
}

static size_t row_size(const struct moments *m)
{
    return (size_t)harmonic_count(m->lmax);
}

static trl_result init_like(const trl_context *ctx, const struct moments *like, struct moments *out)
{
    return moments_init(ctx, like->optics, like->lmax, like->levels, like->suns, out);
}

static void copy(const struct moments *from, struct moments *to)
{
    const size_t points = (size_t)from->levels * (size_t)from->suns;
    memcpy(to->radiance, from->radiance, points * row_size(from) * sizeof(lanes));
    memcpy(to->irradiance, from->irradiance, (size_t)from->suns * sizeof(lanes));
}

static lanes to_lanes(const struct numbers *numbers)
{
    lanes v;
    for (int k = 0; k < LANES; k++) {
        v[k] = (float)numbers->of[k];
    }
    return v;
}

static void scale(struct moments *x, lanes factor)
{
    const size_t row = (size_t)x->suns * row_size(x);
#pragma omp parallel for schedule(static)
    for (int j = 0; j < x->levels; j++) {
        lanes *out = x->radiance + (size_t)j * row;
        for (size_t k = 0; k < row; k++) {
            out[k] *= factor;
        }
    }
    for (int i = 0; i < x->suns; i++) {
        x->irradiance[i] *= factor;
    }
}

static struct numbers dot(struct krylov *k, const struct moments *x, const struct moments *y)
{
    const size_t harmonics = row_size(x);
#pragma omp parallel for schedule(static)
    for (int j = 0; j < x->levels; j++) {
        lanes level = {0};
        for (int i = 0; i < x->suns; i++) {
            const size_t at = ((size_t)j * x->suns + i) * harmonics;
            lanes sum = {0};
            for (size_t h = 0; h < harmonics; h++) {
                sum += x->radiance[at + h] * k->weight[i] * y->radiance[at + h] * k->weight[i];
            }
            level += sum;
        }
        k->partial[j] = level;
    }
    struct numbers sum = {{0}};
    for (int n = 0; n < LANES; n++) {
        for (int j = 0; j < x->levels; j++) {
            sum.of[n] += (double)k->partial[j][n];
        }
        for (int i = 0; i < x->suns; i++) {
            const double weight = (double)k->weight[i][n];
            sum.of[n] +=
                (double)x->irradiance[i][n] * weight * (double)y->irradiance[i][n] * weight;
        }
    }
    return sum;
}

// weight[sun] = 1 / size of the row; from the brightest sun to the darkest.
static void weigh(struct krylov *k, const struct moments *b)
{
    const size_t harmonics = row_size(b);
    lanes brightest = {0};
    lanes brighter = {0};
    for (int i = b->suns - 1; i >= 0; i--) {
        lanes size = lanes_set((float)DARK);
        for (int j = 0; j < b->levels; j++) {
            const lanes a = b->radiance[((size_t)j * b->suns + i) * harmonics];
            size = lanes_max(size, lanes_max(a, -a));
        }
        brightest = lanes_max(brightest, size);
        brighter = lanes_max(size, brighter * (float)DARKER);
        brighter = lanes_max(brighter, brightest * (float)NIGHT);
        k->weight[i] = 1.0f / brighter;
    }
}

// x = (1 - K)^-1 x, roughly
static void precondition(const struct krylov *k, struct moments *x)
{
    if (k->plane) {
        plane_solve(k->plane, x);
    }
}

// out = (1 - K) x, preconditioned
static trl_result apply(struct krylov *k, const struct moments *x, struct moments *out)
{
    const trl_result result = sweep_order(k->sweep, x, k->done, out);
    if (result == TRL_OK) {
        scale(out, lanes_set(-1));
        moments_add(out, x, lanes_set(1));
        precondition(k, out);
    }
    return result;
}

// The new vector's part across all before it, by Gram and Schmidt, as the basis' next.
static void orthogonalise(struct krylov *k, int step)
{
    struct moments *w = &k->basis[step + 1];
    for (int n = 0; n <= step; n++) {
        k->h[n][step] = dot(k, w, &k->basis[n]);
        moments_add(w, &k->basis[n], -to_lanes(&k->h[n][step]));
    }
    const struct numbers square = dot(k, w, w);
    struct numbers inverse;
    for (int n = 0; n < LANES; n++) {
        const double length = sqrt(square.of[n]);
        k->h[step + 1][step].of[n] = length;
        inverse.of[n] = length > 0 ? 1 / length : 0;
    }
    scale(w, to_lanes(&inverse));
}

// Givens rotations keep h triangular. Returns the largest residual of a wavelength, relative to
// what it was at the start.
static double rotate(struct krylov *k, int step, const struct numbers *start)
{
    double largest = 0;
    for (int n = 0; n < LANES; n++) {
        for (int r = 0; r < step; r++) {
            const double a = k->h[r][step].of[n];
            const double b = k->h[r + 1][step].of[n];
            k->h[r][step].of[n] = k->cosine[r].of[n] * a + k->sine[r].of[n] * b;
            k->h[r + 1][step].of[n] = k->cosine[r].of[n] * b - k->sine[r].of[n] * a;
        }
        const double a = k->h[step][step].of[n];
        const double b = k->h[step + 1][step].of[n];
        const double length = hypot(a, b);
        const double c = length > 0 ? a / length : 1;
        const double s = length > 0 ? b / length : 0;
        k->cosine[step].of[n] = c;
        k->sine[step].of[n] = s;
        k->h[step][step].of[n] = length;
        k->g[step + 1].of[n] = -s * k->g[step].of[n];
        k->g[step].of[n] *= c;
        if (start->of[n] > 0) {
            largest = fmax(largest, fabs(k->g[step + 1].of[n]) / start->of[n]);
        }
    }
    return largest;
}

// x += the basis' best combination of `count` vectors.
static void combine(struct krylov *k, int count, struct moments *x)
{
    struct numbers y[MAX_BASIS];
    for (int n = 0; n < LANES; n++) {
        for (int r = count - 1; r >= 0; r--) {
            double sum = k->g[r].of[n];
            for (int c = r + 1; c < count; c++) {
                sum -= k->h[r][c].of[n] * y[c].of[n];
            }
            const double diagonal = k->h[r][r].of[n];
            y[r].of[n] = diagonal != 0 ? sum / diagonal : 0;
        }
    }
    for (int r = 0; r < count; r++) {
        moments_add(x, &k->basis[r], to_lanes(&y[r]));
    }
}

static trl_result reserve(struct krylov *k, int n, const struct moments *like)
{
    return k->basis[n].radiance ? TRL_OK : init_like(k->ctx, like, &k->basis[n]);
}

// basis[0] = the residual of x, at unit length; its length is g[0].
static void begin(struct krylov *k)
{
    const struct numbers square = dot(k, &k->basis[0], &k->basis[0]);
    struct numbers inverse;
    for (int n = 0; n < LANES; n++) {
        k->g[0].of[n] = sqrt(square.of[n]);
        inverse.of[n] = k->g[0].of[n] > 0 ? 1 / k->g[0].of[n] : 0;
    }
    scale(&k->basis[0], to_lanes(&inverse));
}

// Steps until the residual is small or the basis full; adds to x.
static trl_result run(struct krylov *k, const struct numbers *start, struct moments *x, int *steps,
                      double *residual)
{
    int count = 0;
    trl_result result = TRL_OK;
    const int most = k->settings->max_orders;
    while (count < k->most && *steps<most && * residual> k->settings->tolerance) {
        result = reserve(k, count + 1, x);
        if (result == TRL_OK) {
            result = apply(k, &k->basis[count], &k->basis[count + 1]);
        }
        if (result != TRL_OK) {
            return result;
        }
        orthogonalise(k, count);
        *residual = rotate(k, count, start);
        k->done = fmin(log(fmin(*residual, 1)) / log(k->settings->tolerance), 1);
        ++count;
        ++*steps;
    }
    combine(k, count, x);
    return TRL_OK;
}

static trl_result solve(struct krylov *k, struct moments *x, int *steps)
{
    trl_result result = init_like(k->ctx, x, &k->first);
    if (result == TRL_OK) {
        result = reserve(k, 0, x);
    }
    if (result != TRL_OK) {
        return result;
    }
    copy(x, &k->first);
    copy(x, &k->basis[0]);
    weigh(k, x);
    precondition(k, &k->basis[0]);
    begin(k);
    const struct numbers start = k->g[0];
    scale(x, lanes_set(0));
    double residual = 1;
    while (residual > k->settings->tolerance && *steps < k->settings->max_orders) {
        if (*steps > 0) { // b - (1 - K) x
            result = sweep_order(k->sweep, x, k->done, &k->basis[0]);
            if (result != TRL_OK) {
                return result;
            }
            moments_add(&k->basis[0], x, lanes_set(-1));
            moments_add(&k->basis[0], &k->first, lanes_set(1));
            precondition(k, &k->basis[0]);
            begin(k);
        }
        result = run(k, &start, x, steps, &residual);
        if (result != TRL_OK) {
            return result;
        }
    }
    return TRL_OK;
}

trl_result krylov_solve(const trl_context *ctx, struct sweep *sweep, const struct plane *plane,
                        const struct solver_settings *settings, struct moments *x, int *steps)
{
    struct krylov *k = mem_alloc(ctx, 1, sizeof *k);
    if (!k) {
        return TRL_ERROR_MEMORY;
    }
    *k = (struct krylov){
        .ctx = ctx, .sweep = sweep, .plane = plane, .settings = settings, .most = count_vectors(x)};
    k->weight = mem_alloc(ctx, (size_t)x->suns, sizeof(lanes));
    k->partial = mem_alloc(ctx, (size_t)x->levels, sizeof(lanes));
    *steps = 0;
    const trl_result result = k->weight && k->partial ? solve(k, x, steps) : TRL_ERROR_MEMORY;
    for (int n = 0; n <= MAX_BASIS; n++) {
        moments_finish(ctx, &k->basis[n]);
    }
    moments_finish(ctx, &k->first);
    mem_free(ctx, k->weight);
    mem_free(ctx, k->partial);
    mem_free(ctx, k);
    return result;
}
