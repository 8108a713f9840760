// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef API_WAVELENGTHS_H
#define API_WAVELENGTHS_H
// Light at exactly the wavelengths that queries ask for, as many at a time as a solution has.

#include "scatter/solver.h"

// Keeps each wavelength once, ascending; returns how many.
size_t wavelengths_sort(double *nm, size_t count);

// What is done with a solution; `self` is the caller's.
struct wavelengths_work {
    enum optics_use use;
    uint32_t orders; // of scattering; 0: all
    trl_result (*answer)(void *self, const struct solution *solution);
    void *self;
};

// Solves the air at all of `nm` (ascending, each once), and answers after each solution.
// TRL_ERROR_INVALID: the medium is none at one of them; TRL_ERROR_MEMORY, what solving and
// answering return.
TRL_MUST_USE trl_result wavelengths_solve(const trl_context *ctx, const struct medium *medium,
                                          const double *nm, size_t count,
                                          const struct wavelengths_work *work);

#endif // API_WAVELENGTHS_H
