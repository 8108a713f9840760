// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_MEDIUM_EDIT_H
#define SCATTER_MEDIUM_EDIT_H
// Copies of a medium, and changes to them.

#include "scatter/medium.h"

// A copy that owns all it holds; medium_finish frees it. *out is zeroed on failure.
TRL_MUST_USE trl_result medium_copy(const trl_context *ctx, const struct medium *medium,
                                    struct medium *out);

// The same with the constituents and the height of another medium's atmosphere.
TRL_MUST_USE trl_result medium_copy_atmosphere(const trl_context *ctx, const struct medium *planet,
                                               const struct medium *atmosphere, struct medium *out);

// Multiplies scattering and absorption; factor >= 0.
void constituent_scale(struct constituent *constituent, double factor);

// Sets the asymmetry of a Henyey-Greenstein or Cornette-Shanks phase function, g in (-1, 1). False
// when the phase function has none.
bool constituent_set_asymmetry(struct constituent *constituent, double g);

#endif // SCATTER_MEDIUM_EDIT_H
