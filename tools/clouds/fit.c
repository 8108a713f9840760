// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "fit.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { ROUNDS = 6, STEPS = 30, TRIES = 8 };

struct normal {
    double a[FIT_MOST][FIT_MOST], b[FIT_MOST];
};

double fit_error(const struct fit *fit, const double *numbers, const double *weights,
                 const struct cloud_sample *samples, size_t count)
{
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        const double error =
            (fit->measured(&samples[i]) - fit->law(numbers, &samples[i])) * weights[i];
        sum += error * error;
    }
    return sum / (double)count;
}

// Gauss and Jordan's elimination; the matrix is positive definite.
static void solve(struct normal *n, int count)
{
    for (int i = 0; i < count; i++) {
        for (int r = 0; r < count; r++) {
            const double part = r == i ? 0 : n->a[r][i] / n->a[i][i];
            for (int c = 0; c < count; c++) {
                n->a[r][c] -= part * n->a[i][c];
            }
            n->b[r] -= part * n->b[i];
        }
    }
    for (int i = 0; i < count; i++) {
        n->b[i] /= n->a[i][i];
    }
}

static void add_sample(const struct fit *fit, const struct cloud_sample *sample, double weight,
                       struct normal *n)
{
    double slope[FIT_MOST], moved[FIT_MOST];
    memcpy(moved, fit->numbers, sizeof moved);
    for (int k = 0; k < fit->count; k++) {
        const double step = 1e-4 * fmax(fabs(moved[k]), 1e-2);
        moved[k] = fit->numbers[k] + step;
        slope[k] = fit->law(moved, sample);
        moved[k] = fit->numbers[k] - step;
        slope[k] = weight * (slope[k] - fit->law(moved, sample)) / (2 * step);
        moved[k] = fit->numbers[k];
    }
    const double error = weight * (fit->measured(sample) - fit->law(moved, sample));
    for (int k = 0; k < fit->count; k++) {
        n->b[k] += slope[k] * error;
        for (int l = 0; l < fit->count; l++) {
            n->a[k][l] += slope[k] * slope[l];
        }
    }
}

// Returns whether there was a better one.
static bool take_step(struct fit *fit, const double *weights, const struct cloud_sample *samples,
                      size_t count, double *damping)
{
    struct normal normal = {0};
    for (size_t i = 0; i < count; i++) {
        add_sample(fit, &samples[i], weights[i], &normal);
    }
    const double before = fit_error(fit, fit->numbers, weights, samples, count);
    for (int i = 0; i < TRIES; i++) {
        struct normal damped = normal;
        double moved[FIT_MOST];
        for (int k = 0; k < fit->count; k++) {
            damped.a[k][k] += *damping * damped.a[k][k] + 1e-9;
        }
        solve(&damped, fit->count);
        for (int k = 0; k < fit->count; k++) {
            moved[k] = fit->numbers[k] + damped.b[k];
        }
        const double after = fit_error(fit, moved, weights, samples, count);
        if (after < before) {
            memcpy(fit->numbers, moved, sizeof(double) * (size_t)fit->count);
            *damping *= 0.3;
            return before - after > 1e-7 * before;
        }
        *damping *= 4;
    }
    return false;
}

void fit_numbers(struct fit *fit, const struct cloud_sample *samples, size_t count)
{
    double *weights = malloc(count * sizeof *weights);
    for (int round = 0; weights && round < ROUNDS; round++) {
        for (size_t i = 0; i < count; i++) {
            weights[i] = 1 / (fmax(fit->law(fit->numbers, &samples[i]), 0) + fit->floor);
        }
        double damping = 1e-3;
        for (int i = 0; i < STEPS && take_step(fit, weights, samples, count, &damping); i++) {
        }
    }
    free(weights);
}
