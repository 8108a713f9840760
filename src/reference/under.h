// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_UNDER_H
#define REFERENCE_UNDER_H
// Paths that begin under water: in a layer of it over a level Lambertian bed, below the mean rough
// surface, and through that into the air. Written apart from what pictures use.

#include "base/context.h"
#include "base/vec3.h"
#include "reference/lanes.h"

#include <stdbool.h>

// At one wavelength.
struct reference_water_optics {
    double absorption_per_m;
    double clear_per_m;                    // scattering by molecules that depolarise by 0.09
    double particles_per_m;                // by particles of Fournier and Forand
    double particle_index, particle_slope; // as in water.h
    double bed_albedo;
};

struct reference_under {
    bool is_there;         // the eye is under water
    double level_radius_m; // of the surface
    double depth_m;        // of the bed, below it
    double mean_square_slope, index;
    const void *user;
    void (*optics)(const void *user, double nm, struct reference_water_optics *out);
};

struct reference_tracer;
struct reference_scratch;
struct reference_path;

// What paths of one tracer look up.
struct reference_under_tables;
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result reference_under_tables_make(const trl_context *ctx,
                                                    const struct reference_under *under,
                                                    const lanes4 *nm, int count,
                                                    struct reference_under_tables **out);
void reference_under_tables_destroy(const trl_context *ctx, struct reference_under_tables **tables);

// As reference_trace, from an eye under water: the radiance behind a window into air, without what
// the window takes.
void reference_under_trace(const struct reference_under_tables *tables,
                           const struct reference_tracer *tracer, struct reference_scratch *scratch,
                           struct reference_path *path);

#endif // REFERENCE_UNDER_H
