// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SKY_CATALOGUE_H
#define SKY_CATALOGUE_H
// A table of stars: lines "right_ascension_deg,declination_deg,magnitude,colour_index" (J2000, V,
// B-V). A header line, empty lines and # comments are passed over.

#include "base/context.h"
#include "base/vec3.h"

struct catalogue_star {
    struct vec3 direction; // unit, ICRS: x to the vernal equinox, z to the celestial north pole
    double magnitude, colour_index;
};

struct catalogue {
    struct catalogue_star *stars; // owned
    size_t count;
};

// Stars of the limiting magnitude and brighter. TRL_ERROR_IO; TRL_ERROR_INVALID names file and
// line; TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result catalogue_load(const trl_context *ctx, const char *path,
                                       double limit_magnitude, struct catalogue *out);
void catalogue_finish(const trl_context *ctx, struct catalogue *catalogue);

#endif // SKY_CATALOGUE_H
