// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_VOLUME_UNDER_H
#define OCEAN_VOLUME_UNDER_H
// Light for eyes under water: all that a column of water of one depth sends into every direction at
// every depth, for all stars. docs/physics.md, *Under water*.
//
// Along a line of sight of the optical length t water adds J (1 - exp(-t)): J is the mean of what
// it scatters into the line, weighed by what of it arrives. It is stored instead of the light
// itself because it is even where light goes to 0: near the surface, and near the bed. What is
// scattered once by the star's beam has a closed form, and is left out.

#include "ocean/volume.h"

// Depths: none, then two for each octave up to the bed. Directions: the nodes of slab.h, of lines
// of sight that go down, then of those that go up.
enum { UNDER_OCTAVES = 9, UNDER_DEPTHS = 2 * UNDER_OCTAVES + 2, UNDER_ORDERS = 12 };
enum { UNDER_SUNS = VOLUME_ANGLES };

struct under_order {
    // Per irradiance of a plane that faces the refracted star, in cos(order * azimuth).
    float source[UNDER_DEPTHS][UNDER_SUNS][2][SLAB_NODES]; // J
    float rising[UNDER_SUNS][SLAB_NODES]; // light below the surface that goes up, of the whole way
};

// At one wavelength.
struct under_light {
    struct under_order order[UNDER_ORDERS];
    float bed[UNDER_SUNS]; // irradiance of the level bed without the beam's own, as above
    // The same by an even sky, per irradiance of level water from above.
    float sky_source[UNDER_DEPTHS][2][SLAB_NODES];
    float sky_rising[SLAB_NODES];
    float sky_bed;
};

struct volume_under {
    int count; // of wavelengths
    double depth_m;
    double nm[VOLUME_WAVELENGTHS];
    double index, critical;
    struct volume_column column[VOLUME_WAVELENGTHS];
    struct water_phase phase[VOLUME_WAVELENGTHS];
    double extinction_per_m[VOLUME_WAVELENGTHS]; // without the forward peak
    double node[SLAB_NODES];                     // cosines
    struct under_light light[VOLUME_WAVELENGTHS];
};

// Of the depth i of a column.
double volume_under_depth_m(double depth_m, int i);

// Uses every core. `depth_m` is finite, above 0. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result volume_under_make(const trl_context *ctx, const struct ocean_desc *ocean,
                                          const double *nm, int count, double depth_m,
                                          struct volume_under **out);
// The same, kept on disk from one start to the next.
TRL_MUST_USE trl_result volume_under_get(const trl_context *ctx, const struct ocean_desc *ocean,
                                         const double *nm, int count, double depth_m,
                                         struct volume_under **out);
void volume_under_destroy(const trl_context *ctx, struct volume_under **under);

// What an eye sees of the water at a depth, all orders of scattering, for one of the wavelengths:
// as volume_radiance, from the table.
struct volume_light volume_under_at(const struct volume_under *under, int wavelength,
                                    const struct volume_view *view);

// A line of sight in the water: cosines of its and the star's angle to the zenith.
struct under_sight {
    double eye_depth_m, view_mu, sun_mu; // sun_mu: refracted, above 0
    double azimuth_rad;
};

// J by the star and by the sky for one direction.
struct under_source {
    double star, sky;
};
struct under_source volume_under_source(const struct volume_under *under, int wavelength,
                                        const struct under_sight *sight);
// What goes up below the surface toward an eye that looks down by view_mu < 0 there, of the whole
// way with the bed: the depth of the eye does not count.
struct under_source volume_under_rising(const struct volume_under *under, int wavelength,
                                        const struct under_sight *sight);
// Irradiance of the level bed but for the beam's own.
struct under_source volume_under_bed(const struct volume_under *under, int wavelength,
                                     double sun_mu);
// What the beam scatters once into a line of sight of that length, per irradiance of a plane that
// faces the refracted star.
double volume_under_once(const struct volume_under *under, int wavelength,
                         const struct under_sight *sight, double length_m);

// J of a line of sight, and the light at its end: what rises below the surface, or the bed's.
struct under_sources {
    struct under_source source, far;
};
// What an eye sees of them over a bed at that depth.
struct volume_light volume_under_join(const struct volume_under *under, int wavelength,
                                      double depth_m, const struct volume_view *view,
                                      const struct under_sources *sources);

#endif // OCEAN_VOLUME_UNDER_H
