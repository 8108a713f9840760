// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/volume_under.h"

#include "scatter/quadrature.h"
#include "shared/fresnel.glsl"

#include <math.h>
#include <omp.h>
#include <stddef.h>
#include <string.h>

enum {
    N = SLAB_NODES,
    STRIDE = SLAB_MAX,
    SUNS = UNDER_SUNS,
    COUNT = N + SUNS,
    LAST = UNDER_DEPTHS - 1
};

double volume_under_depth_m(double depth_m, int i)
{
    return i == 0 ? 0 : depth_m * exp2((i - 1) / 2 - UNDER_OCTAVES) * (i % 2 ? 1 : 1.5);
}

// One wavelength and one azimuth order. Columns of fields are the suns, then the sky.
enum { COLUMNS = SUNS + 1 };
struct work {
    struct volume_under *under;
    int wavelength;
    struct slab_medium medium;
    struct slab_grid grid;
    double inner[COUNT];
    double kernel[2][N][SUNS]; // of this order, from the suns: on its way, and turned back
    struct slab octave[UNDER_OCTAVES + 2]; // depths of 2^(k - 1) of the first level
    struct slab top;
    double below[UNDER_DEPTHS][SLAB_MAX * SLAB_MAX]; // reflection by what is below that depth
    double down[N * COLUMNS], up[N * COLUMNS];       // diffuse light below the surface
    double bed[N * COLUMNS];                         // what goes up from the bed
};

// What all wavelengths have.
static void begin(struct volume_under *under, struct work *w)
{
    w->under = under;
    double suns[SUNS];
    for (int i = 0; i < SUNS; i++) {
        const double mu = under->critical + (1 - under->critical) * i / (SUNS - 1);
        suns[i] = fmin(mu, 1 - 1e-4); // straight down has no azimuth
    }
    slab_grid_init(under->critical, suns, SUNS, &w->grid);
    w->grid.outputs = N; // nobody looks toward the suns
    for (int i = 0; i < COUNT; i++) {
        w->inner[i] = fresnel_reflectance(w->grid.mu[i], 1 / under->index);
    }
}

// The order's kernel between two directions, of light on its way or turned back.
static double kernel(const struct work *w, int m, int a, int b, bool is_turned)
{
    double sum = 0;
    for (int l = m; l < SLAB_MOMENTS; l++) {
        const int lm = harmonic_index(l, m);
        const double term = w->medium.moment[l] * w->grid.harmonic[a][lm] * w->grid.harmonic[b][lm];
        sum += is_turned && (l + m) % 2 ? -term : term;
    }
    return sum;
}

static void find_kernels(struct work *w, int m)
{
    for (int turned = 0; turned < 2; turned++) {
        for (int i = 0; i < N; i++) {
            for (int c = 0; c < SUNS; c++) {
                w->kernel[turned][i][c] = kernel(w, m, i, N + c, turned);
            }
        }
    }
}

// All layers between two depths are octaves, or halves of such.
static void make_layers(struct work *w, const struct slab_order *order)
{
    slab_make(order, volume_under_depth_m(w->under->depth_m, 1) / 2, &w->octave[0]);
    for (int k = 0; k <= UNDER_OCTAVES; k++) {
        slab_double(order, &w->octave[k], &w->octave[k + 1]);
    }
    struct slab none = {.direct = {0}};
    slab_make(order, 0, &none);
    slab_add_bed(order, &none, w->under->column[w->wavelength].bed_albedo, w->below[LAST]);
    for (int i = LAST - 1; i >= 0; i--) {
        const struct slab *layer = i == 0 ? &w->octave[1] : &w->octave[(i - 1) / 2];
        slab_add_below(order, layer, w->below[i + 1], w->below[i]);
    }
}

// The layer above a depth.
static const struct slab *find_top(struct work *w, const struct slab_order *order, int i)
{
    const int octave = (i - 1) / 2 + 1;
    if (i == 0) {
        slab_make(order, 0, &w->top);
        return &w->top;
    }
    if (i % 2) {
        return &w->octave[octave];
    }
    slab_add(order, &w->octave[octave], &w->octave[octave - 1], &w->top);
    return &w->top;
}

static double window(const struct work *w, int i)
{
    return (1 - w->inner[i]) * w->under->index * w->under->index / M_PI;
}

// out += op x over the nodes, for all columns.
static void add_applied(const struct slab_order *order, const double *op, const double *x,
                        double *out)
{
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < N; k++) {
            const double factor = op[i * STRIDE + k] * slab_weight(order, k);
            for (int c = 0; c < COLUMNS; c++) {
                out[i * COLUMNS + c] += factor * x[k * COLUMNS + c];
            }
        }
    }
}

// x = (1 - op factor)^-1 x.
static void close_loop(const struct slab_order *order, const double *op, const double *factor,
                       double *x)
{
    double matrix[N * N], right[N * STRIDE];
    for (int i = 0; i < N; i++) {
        for (int k = 0; k < N; k++) {
            matrix[i * N + k] = op[i * STRIDE + k] * slab_weight(order, k) * factor[k];
        }
        memcpy(right + (size_t)i * STRIDE, x + (size_t)i * COLUMNS, COLUMNS * sizeof *x);
    }
    slab_solve(matrix, right, COLUMNS);
    for (int i = 0; i < N; i++) {
        memcpy(x + (size_t)i * COLUMNS, right + (size_t)i * STRIDE, COLUMNS * sizeof *x);
    }
}

// U = R (beam + sky + r U) and D = sky + r U.
static void light_surface(struct work *w, const struct slab_order *order)
{
    double sky[N * COLUMNS] = {0};
    for (int i = 0; i < N; i++) {
        sky[i * COLUMNS + SUNS] = order->m == 0 ? window(w, i) : 0;
        for (int c = 0; c < COLUMNS; c++) {
            w->up[i * COLUMNS + c] = c < SUNS ? w->below[0][i * STRIDE + N + c] : 0;
        }
    }
    add_applied(order, w->below[0], sky, w->up);
    close_loop(order, w->below[0], w->inner, w->up);
    for (int i = 0; i < N; i++) {
        for (int c = 0; c < COLUMNS; c++) {
            w->down[i * COLUMNS + c] = sky[i * COLUMNS + c] + w->inner[i] * w->up[i * COLUMNS + c];
        }
    }
}

// D = what passes + R1 U, U = R2 (D + beam).
static void light_depth(struct work *w, const struct slab_order *order, const struct slab *top,
                        const double *below, double down[N * COLUMNS], double up[N * COLUMNS])
{
    double beam_up[N * COLUMNS] = {0}, again[SLAB_MAX * SLAB_MAX] = {0}, one[N];
    for (int i = 0; i < N; i++) {
        one[i] = 1;
        for (int c = 0; c < COLUMNS; c++) {
            const int sun = N + c;
            down[i * COLUMNS + c] = (c < SUNS ? top->passed[i * STRIDE + sun] : 0) +
                                    top->direct[i] * w->down[i * COLUMNS + c];
            beam_up[i * COLUMNS + c] = c < SUNS ? top->direct[sun] * below[i * STRIDE + sun] : 0;
        }
        for (int k = 0; k < N; k++) {
            const double factor = top->reflected[i * STRIDE + k] * slab_weight(order, k);
            for (int j = 0; j < N; j++) {
                again[i * STRIDE + j] += factor * below[k * STRIDE + j];
            }
        }
    }
    add_applied(order, top->passed, w->down, down);
    add_applied(order, top->reflected, beam_up, down);
    close_loop(order, again, one, down);
    memcpy(up, beam_up, sizeof beam_up);
    add_applied(order, below, down, up);
}

// Of a line of sight of that optical length from a depth, per scattering: as volume_under_once.
static double once(const struct work *w, int sun, double depth, double way, double along)
{
    const double rate = 1 + along / w->grid.mu[N + sun]; // along: cosine downward
    const double arrived = exp(-depth / w->grid.mu[N + sun]);
    const double x = rate * way;
    return arrived * (fabs(x) > 1e-6 ? -expm1(-x) / rate : way);
}

// J of the lines of sight that go down (0) or up (1) by a node.
static void store_line(struct work *w, const struct slab_order *order, int depth, int line,
                       const double light[N * COLUMNS])
{
    struct under_light *out = &w->under->light[w->wavelength];
    const double here_m = volume_under_depth_m(w->under->depth_m, depth);
    const double length_m = line ? here_m : w->under->depth_m - here_m;
    const double *far = line ? w->down : w->bed;
    for (int i = 0; i < N; i++) {
        const double mu = w->grid.mu[i], along = line ? -mu : mu;
        const double way = w->medium.extinction_per_m * length_m / mu;
        const double taken = -expm1(-way);
        for (int c = 0; c < COLUMNS; c++) {
            const double added = light[i * COLUMNS + c] - exp(-way) * far[i * COLUMNS + c];
            if (c < SUNS) {
                const double one = w->medium.albedo * w->kernel[!line][i][c] *
                                   once(w, c, w->medium.extinction_per_m * here_m, way, along);
                out->order[order->m].source[depth][c][line][i] = (float)((added - one) / taken);
            } else if (order->m == 0) {
                out->sky_source[depth][line][i] = (float)(added / taken);
            }
        }
    }
}

static void store_bed(struct work *w, const struct slab_order *order,
                      const double down[N * COLUMNS])
{
    struct under_light *light = &w->under->light[w->wavelength];
    for (int c = 0; c < COLUMNS && order->m == 0; c++) {
        double sum = 0;
        for (int i = 0; i < N; i++) {
            sum += slab_weight(order, i) * w->grid.mu[i] * down[i * COLUMNS + c];
        }
        *(c < SUNS ? &light->bed[c] : &light->sky_bed) = (float)sum;
    }
}

static void store_rising(struct work *w, const struct slab_order *order)
{
    struct under_light *light = &w->under->light[w->wavelength];
    const double bed = w->medium.extinction_per_m * w->under->depth_m;
    for (int i = 0; i < N; i++) {
        for (int c = 0; c < SUNS; c++) {
            const double one = w->medium.albedo * w->kernel[1][i][c] *
                               once(w, c, 0, bed / w->grid.mu[i], w->grid.mu[i]);
            light->order[order->m].rising[c][i] = (float)(w->up[i * COLUMNS + c] - one);
        }
        if (order->m == 0) {
            light->sky_rising[i] = (float)w->up[i * COLUMNS + SUNS];
        }
    }
}

// The same of a line without length: what diffuse light is scattered into it where the eye is.
static void store_point(struct work *w, const struct slab_order *order, int depth, int line,
                        const double same[N * COLUMNS], const double turned[N * COLUMNS])
{
    struct under_light *out = &w->under->light[w->wavelength];
    for (int i = 0; i < N; i++) {
        double sum[COLUMNS] = {0};
        for (int k = 0; k < N; k++) {
            const double weight = w->medium.albedo * slab_weight(order, k);
            const double on = weight * kernel(w, order->m, i, k, false);
            const double back = weight * kernel(w, order->m, i, k, true);
            for (int c = 0; c < COLUMNS; c++) {
                sum[c] += on * same[k * COLUMNS + c] + back * turned[k * COLUMNS + c];
            }
        }
        for (int c = 0; c < SUNS; c++) {
            out->order[order->m].source[depth][c][line][i] = (float)sum[c];
        }
        if (order->m == 0) {
            out->sky_source[depth][line][i] = (float)sum[SUNS];
        }
    }
}

static void fill(struct work *w, int m)
{
    const struct slab_order order = {&w->grid, &w->medium, m};
    find_kernels(w, m);
    make_layers(w, &order);
    light_surface(w, &order);
    for (int i = LAST; i >= 0; i--) {
        double down[N * COLUMNS] = {0}, up[N * COLUMNS] = {0};
        light_depth(w, &order, find_top(w, &order, i), w->below[i], down, up);
        if (i == LAST) {
            memcpy(w->bed, up, sizeof w->bed);
            store_bed(w, &order, down);
        }
        if (i < LAST) {
            store_line(w, &order, i, 0, up);
        } else {
            store_point(w, &order, i, 0, up, down);
        }
        if (i > 0) {
            store_line(w, &order, i, 1, down);
        } else {
            store_point(w, &order, i, 1, down, up);
        }
    }
    store_rising(w, &order);
    w->under->extinction_per_m[w->wavelength] = w->medium.extinction_per_m;
    memcpy(w->under->node, w->grid.mu, sizeof w->under->node);
}

static struct volume_under *describe(const trl_context *ctx, const struct ocean_desc *ocean,
                                     const double *nm, int count, double depth_m)
{
    struct volume_under *under = mem_alloc(ctx, 1, sizeof *under);
    if (under) {
        under->count = count;
        under->depth_m = depth_m;
        under->index = water_refractive_index(&ocean->water, nm[count / 2]);
        under->critical = volume_refract(0, under->index);
    }
    for (int k = 0; under && k < count; k++) {
        under->nm[k] = nm[k];
        under->column[k] = volume_column_make(ocean, depth_m, nm[k]);
        under->phase[k] = water_phase_make(&under->column[k].optics);
    }
    return under;
}

static trl_result light_up(const trl_context *ctx, struct volume_under *under)
{
    const int tasks = under->count * UNDER_ORDERS;
    struct work *works = mem_alloc(ctx, (size_t)omp_get_max_threads(), sizeof *works);
    struct slab_medium *media = mem_alloc(ctx, (size_t)under->count, sizeof *media);
    if (!works || !media) {
        mem_free(ctx, works);
        mem_free(ctx, media);
        return TRL_ERROR_MEMORY;
    }
#pragma omp parallel
    {
        struct work *work = &works[omp_get_thread_num()];
        begin(under, work);
#pragma omp for
        for (int k = 0; k < under->count; k++) {
            volume_medium_make(&under->column[k], &under->phase[k], &media[k]);
        }
#pragma omp for schedule(dynamic)
        for (int task = 0; task < tasks; task++) {
            work->wavelength = task / UNDER_ORDERS;
            work->medium = media[work->wavelength];
            fill(work, task % UNDER_ORDERS);
        }
    }
    mem_free(ctx, works);
    mem_free(ctx, media);
    return TRL_OK;
}

trl_result volume_under_make(const trl_context *ctx, const struct ocean_desc *ocean,
                             const double *nm, int count, double depth_m, struct volume_under **out)
{
    *out = describe(ctx, ocean, nm, count, depth_m);
    const trl_result result = *out ? light_up(ctx, *out) : TRL_ERROR_MEMORY;
    if (result != TRL_OK) {
        volume_under_destroy(ctx, out);
    }
    return result;
}

trl_result volume_under_get(const trl_context *ctx, const struct ocean_desc *ocean,
                            const double *nm, int count, double depth_m, struct volume_under **out)
{
    *out = describe(ctx, ocean, nm, count, depth_m);
    if (!*out) {
        return TRL_ERROR_MEMORY;
    }
    const struct volume_kept kept = {"under", *out, offsetof(struct volume_under, extinction_per_m),
                                     sizeof **out};
    if (volume_cache_load(ctx, &kept)) {
        return TRL_OK;
    }
    const trl_result result = light_up(ctx, *out);
    if (result == TRL_OK) {
        volume_cache_store(ctx, &kept);
    } else {
        volume_under_destroy(ctx, out);
    }
    return result;
}

void volume_under_destroy(const trl_context *ctx, struct volume_under **under)
{
    mem_free(ctx, *under);
    *under = NULL;
}
