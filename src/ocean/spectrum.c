// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/spectrum.h"

#include <math.h>

// Pierson and Moskowitz 1964: alpha and beta, by the wind 19.5 m above the water, which is 1.026 of
// that at 10 m (neutral air, drag coefficient 1.5e-3).
static const double PM_ALPHA = 0.0081, PM_BETA = 0.74, PM_WIND = 1.026;

// Hasselmann et al. 1973: variance g^2 / U^4 and peak w_p U / g over the fetch g F / U^2, without
// dimensions.
static const double GROWTH_VARIANCE = 1.6e-7, GROWTH_PEAK = 22;

// Integral over x = w / w_p of x^-5 exp(-5/4 x^-4) gamma^r: 1/5 for gamma = 1.
static double integrate_shape(double gamma)
{
    enum { STEPS = 2000 };
    const struct wave_spectrum unit = {1, gamma, 1, 1, 0};
    const double low = log(0.3), step = (log(100) - low) / STEPS;
    double sum = 0;
    for (int i = 0; i < STEPS; i++) {
        const double x = exp(low + (i + 0.5) * step);
        sum += wave_spectrum_at(&unit, x) * x * step;
    }
    return sum;
}

// How much higher than in a full-grown sea the peak is, by the period and the height that the sea
// has: DNV-RP-C205 (2010), 3.5.5, there in seconds and metres for g = 9.81. A full-grown sea has
// 4.99, so that gamma goes over to its 1.
static double find_gamma(double peak_per_s, double variance_m2, double gravity_m_s2)
{
    const double height_s = sqrt(4 * sqrt(variance_m2) / gravity_m_s2);
    const double ratio = 2 * M_PI / (peak_per_s * height_s) / sqrt(9.81);
    return exp(fmin(fmax(5.75 - 1.15 * ratio, 0), log(5)));
}

// Height and peak grow with the fetch until they are those of the full-grown sea: w_p from beta
// (g / U)^4 = 5/4 w_p^4. Hasselmann's own alpha = 0.076 (g F / U^2)^-0.22 with gamma = 3.3 would
// make waves 4 to 34 % higher than their own measured growth: here alpha is what that growth asks.
struct wave_spectrum wave_spectrum_make(const struct ocean_waves *waves, double gravity_m_s2)
{
    const double u = waves->wind_m_s, g = gravity_m_s2;
    const double grown_per_s = pow(0.8 * PM_BETA, 0.25) * g / (PM_WIND * u);
    struct wave_spectrum s = {PM_ALPHA, 1, grown_per_s, g, u};
    if (waves->spectrum == OCEAN_JONSWAP) {
        const double grown_m2 = PM_ALPHA * g * g / (5 * pow(grown_per_s, 4));
        const double variance_m2 = fmin(GROWTH_VARIANCE * waves->fetch_m * u * u / g, grown_m2);
        s.peak_per_s = fmax(GROWTH_PEAK * cbrt(g * g / (u * waves->fetch_m)), grown_per_s);
        s.gamma = find_gamma(s.peak_per_s, variance_m2, g);
        s.alpha = variance_m2 * pow(s.peak_per_s, 4) / (g * g * integrate_shape(s.gamma));
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

double wave_spectrum_variance_m2(const struct wave_spectrum *s)
{
    return s->alpha * s->gravity_m_s2 * s->gravity_m_s2 * integrate_shape(s->gamma) /
           pow(s->peak_per_s, 4);
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
