// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_OPTICS_H
#define REFERENCE_OPTICS_H
// The coefficients of a medium at the wavelengths of one path.

#include "reference/air.h"
#include "reference/lanes.h"

struct reference_optics {
    int count;                                  // wavelengths, 1 to REFERENCE_LANES
    lanes4 scattering[MEDIUM_MAX_CONSTITUENTS]; // m^-1 at reference density
    lanes4 extinction[MEDIUM_MAX_CONSTITUENTS];
    lanes4 ground_albedo;
    size_t constituent_count;
};

// Lanes beyond `count` are 0.
static inline struct reference_optics reference_optics_at(const struct medium *medium,
                                                          const double *nm, int count)
{
    struct reference_optics optics = {.count = count,
                                      .constituent_count = medium->constituent_count};
    for (int k = 0; k < count; ++k) {
        optics.ground_albedo[k] = spectrum_at(&medium->ground_albedo, nm[k]);
        for (size_t i = 0; i < medium->constituent_count; ++i) {
            const struct constituent *c = &medium->constituents[i];
            const double scattering = spectrum_at(&c->scattering_per_m, nm[k]);
            optics.scattering[i][k] = scattering;
            optics.extinction[i][k] = scattering + spectrum_at(&c->absorption_per_m, nm[k]);
        }
    }
    return optics;
}

// Of columns: optical depth; of densities: per metre.
static inline lanes4 reference_optics_extinction(const struct reference_optics *optics,
                                                 const struct reference_columns *columns)
{
    lanes4 sum = {0};
    for (size_t i = 0; i < optics->constituent_count; ++i) {
        sum += optics->extinction[i] * columns->of[i];
    }
    return sum;
}

static inline lanes4 reference_optics_scattering(const struct reference_optics *optics,
                                                 const struct reference_columns *columns)
{
    lanes4 sum = {0};
    for (size_t i = 0; i < optics->constituent_count; ++i) {
        sum += optics->scattering[i] * columns->of[i];
    }
    return sum;
}

#endif // REFERENCE_OPTICS_H
