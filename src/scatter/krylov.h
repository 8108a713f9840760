// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_KRYLOV_H
#define SCATTER_KRYLOV_H
// All orders of scattering by GMRES (Saad and Schultz 1986): the moments x of all orders solve
// x = b + K x, b the first order and K the step from order to order.

#include "scatter/plane.h"

// `x` holds the first order and gets the sum of all. Returns the number of steps in `steps`.
// TRL_ERROR_MEMORY, TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result krylov_solve(const trl_context *ctx, struct sweep *sweep,
                                     const struct plane *plane,
                                     const struct solver_settings *settings, struct moments *x,
                                     int *steps);

#endif // SCATTER_KRYLOV_H
