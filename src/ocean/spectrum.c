// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/spectrum.h"

#include <math.h>

// Pierson and Moskowitz 1964: alpha and beta, by the wind 19.5 m above the water, which is 1.026 of
// that at 10 m (neutral air, drag coefficient 1.5e-3).
static const double PM_ALPHA = 0.0081, PM_BETA = 0.74, PM_WIND = 1.026;

// w_p from beta (g / U)^4 = 5/4 w_p^4.
static double find_grown_peak(double wind_m_s, double gravity_m_s2)
{
    return pow(0.8 * PM_BETA, 0.25) * gravity_m_s2 / (PM_WIND * wind_m_s);
}

struct wave_spectrum wave_spectrum_make(const struct ocean_waves *waves, double gravity_m_s2)
{
    const double u = waves->wind_m_s, g = gravity_m_s2;
    const double grown_per_s = find_grown_peak(u, g);
    struct wave_spectrum s = {PM_ALPHA, 1, grown_per_s, g, u};
    if (waves->spectrum == OCEAN_JONSWAP) {
        // A longer fetch than that at which the peaks of both meet changes nothing more.
        const double most_m = u * u / g * pow(22 * g / (u * grown_per_s), 3);
        const double fetch_m = fmin(waves->fetch_m, most_m);
        s.alpha = 0.076 * pow(u * u / (fetch_m * g), 0.22);
        s.gamma = 3.3;
        s.peak_per_s = 22 * cbrt(g * g / (u * fetch_m));
    }
    return s;
}

double wave_spectrum_at(const struct wave_spectrum *s, double omega_per_s)
{
    const double x = omega_per_s / s->peak_per_s;
    const double width = x <= 1 ? 0.07 : 0.09;
    const double r = exp(-0.5 * (x - 1) * (x - 1) / (width * width));
    return s->alpha * s->gravity_m_s2 * s->gravity_m_s2 * pow(omega_per_s, -5) *
           exp(-1.25 * pow(x, -4)) * pow(s->gamma, r);
}

double wave_spread_exponent(const struct wave_spectrum *s, double omega_per_s)
{
    const double x = omega_per_s / s->peak_per_s;
    const double most = 11.5 * pow(s->peak_per_s * s->wind_m_s / s->gravity_m_s2, -2.5);
    // Short waves spread no wider than a cosine: 1 / 2 is cos(angle / 2).
    return fmax(most * pow(x, x < 1 ? 5 : -2.5), 0.5);
}

double wave_spread_quantile(double exponent, double part)
{
    enum { STEPS = 720 };
    double sums[STEPS + 1] = {0};
    const double step = 2 * M_PI / STEPS;
    for (int i = 0; i < STEPS; i++) {
        const double angle = -M_PI + (i + 0.5) * step;
        sums[i + 1] = sums[i] + pow(fmax(cos(angle / 2), 0), 2 * exponent);
    }
    const double wanted = part * sums[STEPS];
    int i = 0;
    while (i + 1 < STEPS && sums[i + 1] < wanted) {
        i++;
    }
    const double within = (wanted - sums[i]) / fmax(sums[i + 1] - sums[i], 1e-300);
    return -M_PI + (i + fmin(fmax(within, 0), 1)) * step;
}
