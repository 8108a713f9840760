// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLI_VALIDATE_PLOT_H
#define CLI_VALIDATE_PLOT_H

#include "validate.h"

#include <stdio.h>

// The spectral model's errors in one view as an SVG: a dot with a bar of noise for each value.
void validate_plot_errors(FILE *page, const struct validate_case *c);

// Luminance over elevation in the middle third of the pictures: a line for each model, dots with
// bars of noise for the path tracer.
void validate_plot_profiles(FILE *page, const struct validate_case *c);

#endif // CLI_VALIDATE_PLOT_H
