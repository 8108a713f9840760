// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/slab.h"

#include "scatter/quadrature.h"

#include <math.h>
#include <string.h>

enum { N = SLAB_NODES, STRIDE = SLAB_MAX };

// Optical depth of the layer that doubling begins with, relative to the lowest cosine: it scatters
// once, which is off by this much.
static const double THIN = 1e-5;

void slab_grid_init(double critical, const double *others, int other_count, struct slab_grid *out)
{
    // Each side of the critical angle has a rule of its own: radiance jumps there.
    struct gauss rule;
    gauss_init(&rule, SLAB_BELOW);
    for (int k = 0; k < SLAB_BELOW; k++) {
        out->mu[k] = critical * rule.node[k];
        out->weight[k] = critical * rule.weight[k];
    }
    gauss_init(&rule, N - SLAB_BELOW);
    for (int k = SLAB_BELOW; k < N; k++) {
        out->mu[k] = critical + (1 - critical) * rule.node[k - SLAB_BELOW];
        out->weight[k] = (1 - critical) * rule.weight[k - SLAB_BELOW];
    }
    for (int k = 0; k < other_count; k++) {
        out->mu[N + k] = fmax(others[k], 1e-4);
        out->weight[N + k] = 0;
    }
    out->count = out->outputs = N + other_count;
    for (int k = 0; k < out->count; k++) {
        harmonic_values(SLAB_MOMENTS - 1, out->mu[k], out->harmonic[k]);
    }
}

double slab_weight(const struct slab_order *order, int k)
{
    return order->grid->weight[k] * (order->m == 0 ? 2 * M_PI : M_PI);
}

void slab_solve(double *restrict a, double *restrict b, int count)
{
    for (int r = 0; r < N; r++) {
        for (int c = 0; c < N; c++) {
            a[r * N + c] = (r == c) - a[r * N + c];
        }
    }
    for (int p = 0; p < N; p++) {
        for (int r = p + 1; r < N; r++) {
            const double factor = a[r * N + p] / a[p * N + p];
            for (int c = p + 1; c < N; c++) {
                a[r * N + c] -= factor * a[p * N + c];
            }
            for (int c = 0; c < count; c++) {
                b[r * STRIDE + c] -= factor * b[p * STRIDE + c];
            }
        }
    }
    for (int p = N - 1; p >= 0; p--) {
        for (int c = 0; c < count; c++) {
            b[p * STRIDE + c] /= a[p * N + p];
        }
        for (int r = 0; r < p; r++) {
            for (int c = 0; c < count; c++) {
                b[r * STRIDE + c] -= a[r * N + p] * b[p * STRIDE + c];
            }
        }
    }
}

// A layer so thin that light scatters in it once.
static void fill_thin(const struct slab_order *order, double depth, struct slab *out)
{
    const struct slab_grid *grid = order->grid;
    const struct slab_medium *medium = order->medium;
    for (int i = 0; i < grid->count; i++) {
        out->direct[i] = exp(-depth / grid->mu[i]);
    }
    for (int i = 0; i < grid->outputs; i++) {
        const double scattered = medium->albedo * depth / grid->mu[i];
        for (int j = 0; j < grid->count; j++) {
            double same = 0, turned = 0; // kernels of the order m: light on its way, and back
            for (int l = order->m; l < SLAB_MOMENTS; l++) {
                const int lm = harmonic_index(l, order->m);
                const double term =
                    medium->moment[l] * grid->harmonic[i][lm] * grid->harmonic[j][lm];
                same += term;
                turned += (l + order->m) % 2 ? -term : term;
            }
            out->passed[i * STRIDE + j] = scattered * same;
            out->reflected[i * STRIDE + j] = scattered * turned;
        }
    }
}

// Columns that are summed at once, in registers; and of those that are left over.
enum { BLOCK = 12, PIECE = 4 };

// One row of the product below, from a column on: `width` of them, at most BLOCK.
static inline void add_row(const double factor[N], const double *right, int width,
                           double *restrict out)
{
    double sum[BLOCK] = {0};
    for (int k = 0; k < N; k++) {
        for (int j = 0; j < width; j++) {
            sum[j] += factor[k] * right[k * STRIDE + j];
        }
    }
    for (int j = 0; j < width; j++) {
        out[j] += sum[j];
    }
}

// out += sum over the nodes of left times right.
static void add_product(const struct slab_order *order, const double *left, const double *right,
                        double *out)
{
    const int count = order->grid->count, outputs = order->grid->outputs;
    for (int i = 0; i < outputs; i++) {
        double factor[N];
        for (int k = 0; k < N; k++) {
            factor[k] = left[i * STRIDE + k] * slab_weight(order, k);
        }
        int j = 0;
        for (; j + BLOCK <= count; j += BLOCK) {
            add_row(factor, right + j, BLOCK, out + i * STRIDE + j);
        }
        for (; j + PIECE <= count; j += PIECE) {
            add_row(factor, right + j, PIECE, out + i * STRIDE + j);
        }
        add_row(factor, right + j, count - j, out + i * STRIDE + j);
    }
}

struct between {
    double down[SLAB_MAX * SLAB_MAX]; // diffuse light at the boundary of two layers
    double up[SLAB_MAX * SLAB_MAX];
};

// D = passed + R1 U and U = R2 (direct + D), so (1 - R1 R2) D = passed + R1 R2 direct.
static void meet(const struct slab_order *order, const struct slab *upper, const double *reflected,
                 struct between *out)
{
    const int count = order->grid->count, outputs = order->grid->outputs;
    double again[SLAB_MAX * SLAB_MAX] = {0};
    add_product(order, upper->reflected, reflected, again);
    double matrix[N * N];
    for (int i = 0; i < outputs; i++) {
        for (int j = 0; j < count; j++) {
            const double from = again[i * STRIDE + j];
            out->down[i * STRIDE + j] = upper->passed[i * STRIDE + j] + from * upper->direct[j];
            if (i < N && j < N) {
                matrix[i * N + j] = from * slab_weight(order, j);
            }
        }
    }
    slab_solve(matrix, out->down, count);
    // The other directions follow from the nodes.
    for (int i = N; i < outputs; i++) {
        for (int k = 0; k < N; k++) {
            const double factor = again[i * STRIDE + k] * slab_weight(order, k);
            for (int j = 0; j < count; j++) {
                out->down[i * STRIDE + j] += factor * out->down[k * STRIDE + j];
            }
        }
    }
    for (int i = 0; i < outputs; i++) {
        for (int j = 0; j < count; j++) {
            out->up[i * STRIDE + j] = reflected[i * STRIDE + j] * upper->direct[j];
        }
    }
    add_product(order, reflected, out->down, out->up);
}

static void leave_above(const struct slab_order *order, const struct slab *upper,
                        const struct between *between, double *reflected)
{
    const int count = order->grid->count, outputs = order->grid->outputs;
    for (int i = 0; i < outputs; i++) {
        for (int j = 0; j < count; j++) {
            reflected[i * STRIDE + j] =
                upper->reflected[i * STRIDE + j] + upper->direct[i] * between->up[i * STRIDE + j];
        }
    }
    add_product(order, upper->passed, between->up, reflected);
}

void slab_add(const struct slab_order *order, const struct slab *upper, const struct slab *lower,
              struct slab *out)
{
    const int count = order->grid->count, outputs = order->grid->outputs;
    struct between between;
    meet(order, upper, lower->reflected, &between);
    leave_above(order, upper, &between, out->reflected);
    for (int i = 0; i < outputs; i++) {
        for (int j = 0; j < count; j++) {
            out->passed[i * STRIDE + j] = lower->direct[i] * between.down[i * STRIDE + j] +
                                          lower->passed[i * STRIDE + j] * upper->direct[j];
        }
    }
    for (int i = 0; i < count; i++) {
        out->direct[i] = upper->direct[i] * lower->direct[i];
    }
    add_product(order, lower->passed, between.down, out->passed);
}

void slab_double(const struct slab_order *order, const struct slab *half, struct slab *out)
{
    slab_add(order, half, half, out);
}

void slab_add_below(const struct slab_order *order, const struct slab *layer, const double *below,
                    double *reflected)
{
    struct between between;
    meet(order, layer, below, &between);
    leave_above(order, layer, &between, reflected);
}

// The bed sends the same radiance up in all directions, L per beam: A / pi times the irradiance by
// the beam, what the layer scatters, and what comes back of the bed's own light.
void slab_add_bed(const struct slab_order *order, const struct slab *layer, double albedo,
                  double *reflected)
{
    const struct slab_grid *grid = order->grid;
    double lit[SLAB_MAX], back = 0; // irradiance of the bed per beam, and by its own radiance of 1
    for (int j = 0; j < grid->count; j++) {
        lit[j] = grid->mu[j] * layer->direct[j];
    }
    for (int k = 0; k < N; k++) {
        const double weight = slab_weight(order, k) * grid->mu[k];
        for (int j = 0; j < grid->count; j++) {
            lit[j] += weight * layer->passed[k * STRIDE + j];
        }
        for (int l = 0; l < N; l++) {
            back += weight * slab_weight(order, l) * layer->reflected[k * STRIDE + l];
        }
    }
    const double share = order->m == 0 ? albedo / M_PI / (1 - albedo / M_PI * back) : 0;
    for (int i = 0; i < grid->outputs; i++) {
        double leaves = layer->direct[i];
        for (int k = 0; k < N; k++) {
            leaves += layer->passed[i * STRIDE + k] * slab_weight(order, k);
        }
        for (int j = 0; j < grid->count; j++) {
            reflected[i * STRIDE + j] = layer->reflected[i * STRIDE + j] + leaves * share * lit[j];
        }
    }
}

void slab_make(const struct slab_order *order, double depth_m, struct slab *out)
{
    const double depth = order->medium->extinction_per_m * depth_m;
    const double wanted = THIN * order->grid->mu[0];
    const int doublings = depth > wanted ? (int)ceil(log2(depth / wanted)) : 0;
    struct slab other;
    struct slab *from = doublings % 2 ? &other : out, *to = doublings % 2 ? out : &other;
    fill_thin(order, depth * exp2(-doublings), from);
    for (int i = 0; i < doublings; i++) {
        slab_double(order, from, to);
        struct slab *swap = from;
        from = to;
        to = swap;
    }
}
