// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_MIE_H
#define SCATTER_MIE_H
// Scattering of a plane wave by a homogeneous sphere (Mie 1908), after Bohren and Huffman 1983,
// "Absorption and Scattering of Light by Small Particles", Chapter 4. Their conventions: time goes
// as exp(-i omega t), so an index n + i k with k >= 0 absorbs; the size parameter x is the sphere's
// circumference over the wavelength in the medium around it, which is empty here.

#include "base/context.h"

#include <complex.h>

// Largest size parameter: spheres of 0.11 mm in violet light.
#define MIE_MAX_SIZE 2000.0

static inline double complex mie_complex(double real, double imaginary)
{
    const double complex i = I; // a float, as the standard has it
    return real + imaginary * i;
}

// Coefficients a_n, b_n of one sphere's scattered wave, in memory that serves many.
struct mie_series {
    size_t capacity; // terms that there is room for
    size_t angles;   // the same
    size_t terms;
    double size;             // x of the sphere
    double complex *a, *b;   // [terms], from n = 1; owned
    double complex *inside;  // scratch
    double *ratio, *scratch; // scratch
};

// Efficiencies are cross sections over pi radius^2.
struct mie_efficiencies {
    double extinction, scattering;
    double asymmetry; // mean cosine of the scattering angle
};

// Room for spheres up to this size parameter, and for so many angles in one call of
// mie_series_add_intensity.
TRL_MUST_USE trl_result mie_series_init(const trl_context *ctx, double largest_size, size_t angles,
                                        struct mie_series *out);
void mie_series_finish(const trl_context *ctx, struct mie_series *series);

// The sphere of this size parameter, > 0 and not above the largest, and index n + i k.
void mie_series_compute(struct mie_series *series, double size, double complex index);

struct mie_efficiencies mie_series_efficiencies(const struct mie_series *series);

// Adds weight * (|S_1|^2 + |S_2|^2) / 2, the intensity of scattered natural light, at the cosines
// cosine[i] of the scattering angle to forward[i] and at -cosine[i] to backward[i].
struct mie_angles {
    const double *cosine; // [count]
    size_t count;
    double *forward, *backward;
};
void mie_series_add_intensity(struct mie_series *series, double weight,
                              const struct mie_angles *angles);

#endif // SCATTER_MIE_H
