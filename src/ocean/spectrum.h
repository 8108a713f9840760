// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_SPECTRUM_H
#define OCEAN_SPECTRUM_H
// How high waves of which frequency and direction are in a wind. docs/physics.md, *Waves*.

#include "ocean/ocean.h"

// S = alpha g^2 w^-5 exp(-5/4 (w_p / w)^4) gamma^r: JONSWAP (Hasselmann et al. 1973), or with
// gamma 1 that of a full-grown sea (Pierson and Moskowitz 1964).
struct wave_spectrum {
    double alpha, gamma;
    double peak_per_s; // rad/s
    double gravity_m_s2;
    double wind_m_s; // 10 m above the water
};

// Wind and gravity above 0.
struct wave_spectrum wave_spectrum_make(const struct ocean_waves *waves, double gravity_m_s2);

// Variance of the height per angular frequency, m^2 s.
double wave_spectrum_at(const struct wave_spectrum *spectrum, double omega_per_s);

// Of the height, all frequencies, m^2.
double wave_spectrum_variance_m2(const struct wave_spectrum *spectrum);

// Wavenumber in deep water: omega^2 = g k.
static inline double wave_number_per_m(double omega_per_s, double gravity_m_s2)
{
    return omega_per_s * omega_per_s / gravity_m_s2;
}

// The exponent s of the spread cos^2s(angle / 2) about the wind (Mitsuyasu et al. 1975).
double wave_spread_exponent(const struct wave_spectrum *spectrum, double omega_per_s);

// The angle from the wind below which that part of the energy travels, [0, 1] to [-pi, pi].
double wave_spread_quantile(double exponent, double part);

#endif // OCEAN_SPECTRUM_H
