// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_SOLVER_H
#define SCATTER_SOLVER_H
// The source-moment method on the grids of struct moments: all orders of scattering at once, or
// some one by one.

#include "scatter/transport.h"

enum solver_quality {
    SOLVER_INTERACTIVE, // for pictures: about 0.5 %
    SOLVER_PRECISE      // for numbers: about 0.1 % beyond the interpolation of twilight
};

struct solver_settings {
    int lmax;
    int levels, suns;
    int zeniths;          // directions above, and as many below, the geometric horizon
    int azimuths;         // over half a turn
    int first_refinement; // the first order, which is peaked, has this many times more of both
    double nodes_per_shell;
    double first_nodes_per_shell; // of the first order, which has the kink of the planet's shadow
    int orders;                   // exactly these, and no tail; 0: until the tolerance is met
    bool has_plane;               // as preconditioner, see plane.h
    int max_orders;               // steps of the iteration at most
    double tolerance;             // what is left of the iteration's residual
};

// Grids by the medium's optical depth and the sharpness of its phase functions.
struct solver_settings solver_settings_choose(const struct optics *optics,
                                              enum solver_quality quality);

struct solution {
    const struct optics *optics;
    struct ray_rules *rules;
    struct sunlight sun;
    struct moments moments; // of the radiance of all orders, light of the ground included
    int orders;             // orders of scattering, or steps of the iteration over all of them
};

// Vertical optical depth above which a medium is refused: orders of scattering grow with its
// square.
#define SOLVER_MAX_DEPTH 1000.0

// Moments of backward peaks above this are refused: without them light that turns back twice would
// be some per cent off (5 % near the horizon for a moment of 0.25).
#define SOLVER_MAX_BACKWARD_PEAK 0.1

// Solves at the wavelengths of `optics`, which must outlive the solution.
// TRL_ERROR_INVALID (too dense, or a backward peak too sharp), TRL_ERROR_MEMORY,
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result solution_init(const trl_context *ctx, const struct optics *optics,
                                      const struct solver_settings *settings, struct solution *out);
// The same without solving: arrays of zeros, for a cache to fill.
TRL_MUST_USE trl_result solution_reserve(const trl_context *ctx, const struct optics *optics,
                                         const struct solver_settings *settings,
                                         struct solution *out);
void solution_finish(const trl_context *ctx, struct solution *solution);

#endif // SCATTER_SOLVER_H
