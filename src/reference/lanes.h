// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_LANES_H
#define REFERENCE_LANES_H
// The wavelengths that one path carries: up to four, in double.

#include <math.h>

enum { REFERENCE_LANES = 4 };

typedef double lanes4 __attribute__((vector_size(REFERENCE_LANES * sizeof(double))));

static inline lanes4 lanes4_set(double value)
{
    return (lanes4){value, value, value, value};
}

static inline double lanes4_sum(const lanes4 *v)
{
    return (*v)[0] + (*v)[1] + ((*v)[2] + (*v)[3]);
}

static inline double lanes4_min(const lanes4 *v, int count)
{
    double least = (*v)[0];
    for (int k = 1; k < count; ++k) {
        least = fmin(least, (*v)[k]);
    }
    return least;
}

// Of the first `count` lanes; the others become 0.
static inline lanes4 lanes4_exp(const lanes4 *v, int count)
{
    lanes4 result = {0};
    for (int k = 0; k < count; ++k) {
        result[k] = exp((*v)[k]);
    }
    return result;
}

static inline lanes4 lanes4_expm1(const lanes4 *v, int count)
{
    lanes4 result = {0};
    for (int k = 0; k < count; ++k) {
        result[k] = expm1((*v)[k]);
    }
    return result;
}

#endif // REFERENCE_LANES_H
