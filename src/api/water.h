// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef API_WATER_H
#define API_WATER_H
// What the functions of terrella/water.h share.

#include <terrella/water.h>

#include "ocean/ocean.h"

enum { WATER_CANARY = 0x54575431 };

TRL_MUST_USE trl_result water_check_ocean(const trl_context *ctx, const trl_scene *scene);
TRL_MUST_USE trl_result water_check_query(const trl_context *ctx, const trl_water_query *query,
                                          size_t index);

// By paths; light by star and sky alone.
void water_trace(const struct ocean_desc *ocean, const trl_water_desc *desc,
                 const trl_water_query *query, trl_water_light *out);

#endif // API_WATER_H
