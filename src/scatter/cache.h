// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_CACHE_H
#define SCATTER_CACHE_H
// Solved atmospheres on disk, named by a hash of all that they depend on; the ten used last are
// kept.

#include "scatter/atmosphere.h"

// Fills the reserved arrays of the atmosphere. False when there is no file for it, or a damaged one
// (a warning).
bool cache_load(struct atmosphere *atmosphere, const struct solver_settings *settings);

// Writes the file, whole or not at all; failure is a warning.
void cache_store(const struct atmosphere *atmosphere, const struct solver_settings *settings);

#endif // SCATTER_CACHE_H
