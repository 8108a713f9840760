// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "scatter/mie.h"

#include <math.h>
#include <string.h>

enum { SUMS = 8 };

// Where the series has converged (Bohren and Huffman, Appendix A, after Wiscombe 1980).
static size_t count_terms(double size)
{
    return (size_t)(size + 4 * cbrt(size) + 2);
}

// Where downward recurrences start. Beyond the turning point, n = z, an error shrinks at each step
// by exp(-2 acosh(n / z)), about exp(-2 sqrt(2 (n / z - 1))): from z + c z^(1/3) down to z by
// exp(-1.9 c^1.5) in all, which for c = 8 is less than rounding.
static size_t first_downward(double z)
{
    return (size_t)(z + 8 * cbrt(z) + 16);
}

trl_result mie_series_init(const trl_context *ctx, double largest_size, size_t angles,
                           struct mie_series *out)
{
    const size_t terms = count_terms(largest_size);
    *out = (struct mie_series){.capacity = terms, .angles = angles};
    out->a = mem_alloc(ctx, terms, sizeof *out->a);
    out->b = mem_alloc(ctx, terms, sizeof *out->b);
    out->inside = mem_alloc(ctx, terms + 1, sizeof *out->inside);
    out->ratio = mem_alloc(ctx, first_downward(largest_size) + 1, sizeof *out->ratio);
    out->scratch = mem_alloc(ctx, angles, (SUMS + 3) * sizeof *out->scratch);
    if (!out->a || !out->b || !out->inside || !out->ratio || !out->scratch) {
        mie_series_finish(ctx, out);
        return TRL_ERROR_MEMORY;
    }
    return TRL_OK;
}

void mie_series_finish(const trl_context *ctx, struct mie_series *series)
{
    mem_free(ctx, series->a);
    mem_free(ctx, series->b);
    mem_free(ctx, series->inside);
    mem_free(ctx, series->ratio);
    mem_free(ctx, series->scratch);
    *series = (struct mie_series){0};
}

// D_n = psi_n'/psi_n at z by D_(n-1) = n/z - 1/(D_n + n/z), downward, which is stable for any
// complex z (Bohren and Huffman, Eq. 4.89).
static void fill_inside(struct mie_series *series, double complex z)
{
    const size_t start = first_downward(fmax(series->size, cabs(z)));
    double complex d = 0;
    for (size_t n = start; n >= 1; n--) {
        if (n <= series->terms) {
            series->inside[n] = d;
        }
        const double complex part = (double)n / z;
        d = part - 1 / (d + part);
    }
}

// psi_n / psi_(n-1) where n > x: positive, below 1 and without zeros there. From the recurrence
// psi_(n+1) + psi_(n-1) = (2n+1)/x psi_n, downward.
static void fill_ratios(struct mie_series *series)
{
    double ratio = 0;
    for (size_t n = first_downward(series->size); n >= 1 && (double)n > series->size; n--) {
        ratio = 1 / ((2 * (double)n + 1) / series->size - ratio);
        series->ratio[n] = ratio;
    }
}

// Eq. 4.88, with the Riccati-Bessel functions psi and xi = psi - i chi. Both obey the recurrence
// above; upward it is stable for chi always, for psi while n < x.
void mie_series_compute(struct mie_series *series, double size, double complex index)
{
    series->size = size;
    series->terms = count_terms(size);
    if (series->terms > series->capacity) {
        series->terms = series->capacity;
    }
    fill_inside(series, index * size);
    fill_ratios(series);
    double psi_before = cos(size), psi = sin(size); // n = -1, 0
    double chi_before = -sin(size), chi = cos(size);
    for (size_t i = 0; i < series->terms; i++) {
        const double n = (double)(i + 1);
        const double psi_next =
            n > size ? psi * series->ratio[i + 1] : (2 * n - 1) / size * psi - psi_before;
        const double chi_next = (2 * n - 1) / size * chi - chi_before;
        const double complex xi = mie_complex(psi, -chi);
        const double complex xi_next = mie_complex(psi_next, -chi_next);
        const double complex electric = series->inside[i + 1] / index + n / size;
        const double complex magnetic = series->inside[i + 1] * index + n / size;
        series->a[i] = (electric * psi_next - psi) / (electric * xi_next - xi);
        series->b[i] = (magnetic * psi_next - psi) / (magnetic * xi_next - xi);
        psi_before = psi;
        psi = psi_next;
        chi_before = chi;
        chi = chi_next;
    }
}

static double squared(double complex z)
{
    return creal(z) * creal(z) + cimag(z) * cimag(z);
}

// Eq. 4.61, 4.62, and the asymmetry of page 120.
struct mie_efficiencies mie_series_efficiencies(const struct mie_series *series)
{
    double extinction = 0, scattering = 0, asymmetry = 0;
    for (size_t i = 0; i < series->terms; i++) {
        const double n = (double)(i + 1);
        const double complex a = series->a[i], b = series->b[i];
        extinction += (2 * n + 1) * creal(a + b);
        scattering += (2 * n + 1) * (squared(a) + squared(b));
        asymmetry += (2 * n + 1) / (n * (n + 1)) * creal(a * conj(b));
        if (i + 1 < series->terms) {
            asymmetry += n * (n + 2) / (n + 1) *
                         creal(a * conj(series->a[i + 1]) + b * conj(series->b[i + 1]));
        }
    }
    const double area = 2 / (series->size * series->size);
    return (struct mie_efficiencies){.extinction = area * extinction,
                                     .scattering = area * scattering,
                                     .asymmetry = scattering > 0 ? 2 * asymmetry / scattering : 0};
}

// Sums over the terms, and the angular functions pi_(n-1), pi_n of the term that is added.
struct angular {
    const struct mie_angles *angles;
    double *before, *now, *after;
    double *sum[SUMS];
};

static struct angular angular_start(struct mie_series *series, const struct mie_angles *angles)
{
    struct angular out = {.angles = angles,
                          .before = series->scratch,
                          .now = series->scratch + series->angles,
                          .after = series->scratch + 2 * series->angles};
    for (size_t s = 0; s < SUMS; s++) {
        out.sum[s] = series->scratch + (s + 3) * series->angles;
        memset(out.sum[s], 0, angles->count * sizeof *out.sum[s]);
    }
    for (size_t k = 0; k < angles->count; k++) {
        out.before[k] = 0;
        out.now[k] = 1;
    }
    return out;
}

// S_1 + S_2 and S_1 - S_2 at an angle, then at the opposite one, where the sign of every second
// term is another.
static void add_term(struct angular *w, const struct mie_series *series, size_t i)
{
    const double n = (double)(i + 1);
    const double factor = (2 * n + 1) / (n * (n + 1));
    const double complex plus = factor * (series->a[i] + series->b[i]);
    const double complex minus = factor * (series->a[i] - series->b[i]);
    const double re[] = {creal(plus), creal(minus)}, im[] = {cimag(plus), cimag(minus)};
    const double sign = i % 2 == 0 ? 1 : -1;
    double *const *sum = w->sum;
    for (size_t k = 0; k < w->angles->count; k++) {
        const double pi = w->now[k];
        const double tau = n * w->angles->cosine[k] * pi - (n + 1) * w->before[k];
        sum[0][k] += re[0] * (pi + tau);
        sum[1][k] += im[0] * (pi + tau);
        sum[2][k] += re[1] * (pi - tau);
        sum[3][k] += im[1] * (pi - tau);
        sum[4][k] += sign * re[0] * (pi - tau);
        sum[5][k] += sign * im[0] * (pi - tau);
        sum[6][k] += sign * re[1] * (pi + tau);
        sum[7][k] += sign * im[1] * (pi + tau);
    }
}

// pi_(n+1) = ((2n+1) cos pi_n - (n+1) pi_(n-1)) / n (Eq. 4.47).
static void step_angles(struct angular *w, double n)
{
    for (size_t k = 0; k < w->angles->count; k++) {
        w->after[k] = ((2 * n + 1) * w->angles->cosine[k] * w->now[k] - (n + 1) * w->before[k]) / n;
    }
    double *spare = w->before;
    w->before = w->now;
    w->now = w->after;
    w->after = spare;
}

static double sum_squares(double *const *sum, size_t k)
{
    return sum[0][k] * sum[0][k] + sum[1][k] * sum[1][k] + sum[2][k] * sum[2][k] +
           sum[3][k] * sum[3][k];
}

// Eq. 4.74 as sums and differences: S_1 + S_2 = sum f_n (a + b) (pi + tau), S_1 - S_2 = sum f_n
// (a - b) (pi - tau), f_n = (2n+1) / (n (n+1)). At the opposite angle pi + tau becomes (-1)^(n-1)
// (pi - tau). (|S_1|^2 + |S_2|^2) / 2 is a quarter of the sum of the squares.
void mie_series_add_intensity(struct mie_series *series, double weight,
                              const struct mie_angles *angles)
{
    struct angular w = angular_start(series, angles);
    for (size_t i = 0; i < series->terms; i++) {
        add_term(&w, series, i);
        step_angles(&w, (double)(i + 1));
    }
    for (size_t k = 0; k < angles->count; k++) {
        angles->forward[k] += weight / 4 * sum_squares(w.sum, k);
        angles->backward[k] += weight / 4 * sum_squares(w.sum + 4, k);
    }
}
