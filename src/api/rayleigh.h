// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef API_RAYLEIGH_H
#define API_RAYLEIGH_H

#include "scatter/medium.h"
#include <terrella/atmosphere.h>

// TRL_ERROR_INVALID, logged: a field is out of range.
TRL_MUST_USE trl_result check_rayleigh(const trl_context *ctx, const trl_rayleigh_desc *desc);

// trl_sky_radiance by that model; arguments are checked.
TRL_MUST_USE trl_result rayleigh_sky_radiance(const trl_context *ctx, const struct medium *medium,
                                              const trl_rayleigh_desc *desc,
                                              const trl_sky_query *queries, size_t count,
                                              double *radiance);

#endif // API_RAYLEIGH_H
