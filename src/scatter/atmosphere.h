// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_ATMOSPHERE_H
#define SCATTER_ATMOSPHERE_H
// Everything that pictures need of an atmosphere, solved once or taken from the cache.

#include "scatter/table.h"

enum atmosphere_quality {
    ATMOSPHERE_FINE,
    ATMOSPHERE_DRAFT // in a fraction of the time; never cached
};

// Instead of a number of wavelengths: three, in red, green and blue.
enum { ATMOSPHERE_RGB = LANES + 1 };

struct atmosphere_desc {
    uint32_t wavelengths; // for the solver, 1 .. LANES, or ATMOSPHERE_RGB
    uint32_t orders;      // of scattering, reflections by the ground included; 0: all
    bool uses_cache;
    bool only_from_cache; // nothing is computed: *out is NULL where the cache has none
    enum atmosphere_quality quality;
};

struct atmosphere_desc atmosphere_desc_default(void); // 16, cached, fine

struct atmosphere_stats {
    double solve_s, table_s; // 0 when from the cache
    double load_s;           // 0 when computed
    int orders;              // as in struct solution
    size_t solution_bytes, table_bytes;
    bool is_from_cache;
};

struct atmosphere {
    const trl_context *ctx;
    struct medium medium; // a copy
    struct optics *optics;
    struct solution solution;
    struct peaked peaked;
    struct bands bands;
    struct table table;
    struct atmosphere_stats stats;
};

// Blocks for about a second, or 0.1 s from the cache.
// TRL_ERROR_INVALID: more wavelengths than there are lanes; TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED.
// A cache that cannot be read or written is only a warning.
TRL_MUST_USE trl_result atmosphere_create(const trl_context *ctx, const struct medium *medium,
                                          const struct atmosphere_desc *desc,
                                          struct atmosphere **out);
void atmosphere_destroy(struct atmosphere **atmosphere);

#endif // SCATTER_ATMOSPHERE_H
