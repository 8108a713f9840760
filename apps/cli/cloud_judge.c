// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud_judge.h"

#include <math.h>
#include <stdlib.h>

static int compare_drawn(const void *a, const void *b)
{
    const double x = ((const struct cloud_pixel *)a)->drawn;
    const double y = ((const struct cloud_pixel *)b)->drawn;
    return (x > y) - (x < y);
}

static double traced(const struct cloud_pixel *p)
{
    return 0.5 * (p->halves[0] + p->halves[1]);
}

static void judge_errors(const struct cloud_pixel *at, size_t count, struct cloud_figures *f)
{
    const double size_of_normal = sqrt(2 / 3.14159265358979323846); // mean size of a normal error
    const double part = 1.0 / (double)count;
    double square = 0;
    for (size_t i = 0; i < count; i++) {
        const struct cloud_pixel *p = &at[i];
        const double first = 1 - p->halves[0] / p->drawn, second = 1 - p->halves[1] / p->drawn;
        square += part * first * second;
        f->size += part * fabs(p->drawn - traced(p)) / traced(p);
        f->noise += part * size_of_normal * p->error / traced(p);
        // The sign by one half, the size by the other.
        f->least_size += part * copysign(0.5 * (fabs(first) + fabs(second)), first * second);
    }
    f->rms = sqrt(fmax(square, 0));
}

static void judge_contrast(const struct cloud_pixel *at, size_t count, struct cloud_figures *f)
{
    const double part = 1.0 / (double)count;
    double sums[3][2] = {{0}}, square[2] = {0};
    for (size_t i = 0; i < count; i++) {
        double *sum = sums[3 * i / count];
        sum[0] += part * at[i].drawn;
        sum[1] += part * traced(&at[i]);
        square[0] += part * at[i].drawn * at[i].drawn;
        square[1] += part * at[i].halves[0] * at[i].halves[1];
    }
    double mean[2] = {0};
    for (int third = 0; third < 3; third++) {
        f->thirds[third] = sums[third][0] / sums[third][1];
        mean[0] += sums[third][0];
        mean[1] += sums[third][1];
    }
    f->traced_cd_m2 = mean[1];
    f->ratio = mean[0] / mean[1];
    for (int k = 0; k < 2; k++) {
        f->contrast[k] = sqrt(fmax(square[k] / (mean[k] * mean[k]) - 1, 0));
    }
}

struct cloud_figures cloud_judge(struct cloud_pixel *pixels, size_t count)
{
    struct cloud_figures figures = {0};
    qsort(pixels, count, sizeof *pixels, compare_drawn);
    judge_errors(pixels, count, &figures);
    judge_contrast(pixels, count, &figures);
    return figures;
}
