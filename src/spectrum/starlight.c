// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "spectrum/starlight.h"

#include <math.h>

static const double ZERO_MAGNITUDE_LX = 2.54e-6;

double starlight_illuminance_lx(double magnitude)
{
    return ZERO_MAGNITUDE_LX * pow(10, -0.4 * magnitude);
}

double starlight_temperature_K(double colour_index)
{
    const double c = fmin(fmax(colour_index, -0.4), 5);
    return 4600 * (1 / (0.92 * c + 1.7) + 1 / (0.92 * c + 0.62));
}
