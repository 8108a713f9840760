// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_AUREOLE_H
#define SCATTER_AUREOLE_H
// Light around the star that sharp phase functions have scattered forward several times. The solver
// counts a forward peak as not scattered and the first order adds it once; here is what scattering
// in the peak again and again makes of it.

#include "scatter/optics.h"

struct aureole {
    const struct optics *optics;
    double disc_rad;
    int count;     // of moments in a row; 0 when no constituent has a peak
    int used;      // of them, until they have died away
    double *share; // [constituent][count]: moments of the peak alone, 1 up to lmax
    double *disc;  // [count]: means of the Legendre polynomials over the star's disc
};

// Empty when nothing has a peak. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result aureole_init(const trl_context *ctx, const struct optics *optics,
                                     double disc_rad, struct aureole *out);
void aureole_finish(const trl_context *ctx, struct aureole *aureole);

// Is there anything to be added at that cosine of the angle from the star?
bool aureole_reaches(const struct aureole *aureole, double nu);

// Adds it to a radiance that holds the first order: `single[i]` is that order of each constituent
// without its phase function, `phase[i]` the phase function there, `column_m` the way of the light
// from the star through where it is scattered to the eye.
void aureole_add(const struct aureole *aureole, double nu, const lanes *single, const float *phase,
                 const double *column_m, lanes *radiance);

#endif // SCATTER_AUREOLE_H
