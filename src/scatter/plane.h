// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_PLANE_H
#define SCATTER_PLANE_H
// All orders of scattering at once, roughly: as if the star stood equally high everywhere, and for
// the lowest harmonics alone. Then suns and azimuth orders part, and what is left is a small matrix
// for each azimuth order, which is factorised once. It is what makes the iteration of krylov.h
// short in dense matter.

#include "scatter/sweep.h"

struct plane;
// Along the rays of `settings`, whose lmax is 2 at least.
TRL_MUST_USE trl_result plane_create(const trl_context *ctx, const struct solution *solution,
                                     const struct solver_settings *settings, struct plane **out);
void plane_destroy(const trl_context *ctx, struct plane **plane);

// x = (1 - K)^-1 x for the harmonics of the plane; the others stay.
void plane_solve(const struct plane *plane, struct moments *x);

#endif // SCATTER_PLANE_H
