// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUDS_FIT_H
#define CLOUDS_FIT_H
// Least squares of errors over what a law says (and `floor`, so that the dark does not rule), by
// Levenberg and Marquardt's steps. Weights are those of the law before, since what is measured is
// noisy: else its low values would count most.

#include "samples.h"

enum { FIT_MOST = 13 };

struct fit {
    const char *name;
    double (*law)(const double *numbers, const struct cloud_sample *sample);
    double (*measured)(const struct cloud_sample *sample);
    double floor;
    int count; // of numbers
    double numbers[FIT_MOST];
};

void fit_numbers(struct fit *fit, const struct cloud_sample *samples, size_t count);

// Mean square of those errors.
double fit_error(const struct fit *fit, const double *numbers, const double *weights,
                 const struct cloud_sample *samples, size_t count);

#endif // CLOUDS_FIT_H
