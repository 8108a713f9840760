// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_WATER_PHASE_H
#define OCEAN_WATER_PHASE_H
// How water with particles in it scatters: a mixture of two phase functions, per sr, whose integral
// over the sphere is 1.

#include "ocean/water.h"

// Fournier and Forand 1994, Proc. SPIE 2258, as Fournier and Jonasz 1999, Proc. SPIE 3761:
// particles with a power law of sizes.
struct water_phase {
    double clear_share;  // of all scattering, by the liquid
    double index, slope; // of the particles: refractive index relative to water, exponent of sizes
    double nu, scale;    // exponent, and delta / sin^2(half the angle)
};

// Index and slope of the particles along Mobley, Sundman and Boss 2002, Appl. Opt. 41, Eq. 5, from
// the part that goes back, which is kept from 0.0005 to 0.09.
struct water_phase water_phase_make(const struct water_optics *optics);

double water_phase_value(const struct water_phase *phase, double cosine);

// The same with the peak cut that water_phase_moments splits off: its integral is what is left.
double water_phase_blunt(const struct water_phase *phase, double angle);

// Splits off a peak of light that goes on as if not scattered, and returns its share. moment[l] =
// integral of the rest, per its own share, times the Legendre polynomial P_l, l < count.
double water_phase_moments(const struct water_phase *phase, int count, double *moment);

#endif // OCEAN_WATER_PHASE_H
