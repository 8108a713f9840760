// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_PROJECTIVE_H
#define TERRAIN_PROJECTIVE_H
// The projective mesher (planetary projective grid mapping, PGM) with its options.

#include "terrain/mesher.h"
#include "terrain/projective_rows.h"

trl_projective_desc projective_desc_default(void);

bool projective_desc_is_good(const trl_projective_desc *desc);

// TRL_ERROR_INVALID: a grid that cannot be; TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result projective_create(const struct surface *surface,
                                          const trl_projective_desc *desc, struct mesher **out);

// With the default options; for the table of mesher.c.
TRL_MUST_USE trl_result projective_create_default(const struct surface *surface,
                                                  struct mesher **out);

#endif // TERRAIN_PROJECTIVE_H
