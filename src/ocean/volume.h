// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_VOLUME_H
#define OCEAN_VOLUME_H
// Light in a column of water with a flat surface above and a Lambertian bed below: all orders of
// scattering, with reflection and refraction by the surface on both ways. docs/physics.md, *Light
// in the water*.

#include "ocean/slab.h"
#include "ocean/water_phase.h"

// At one wavelength.
struct volume_column {
    struct water_optics optics;
    double index; // refractive, above 1
    double depth_m;
    double bed_albedo;
};

struct volume_column volume_column_make(const struct ocean_desc *ocean, double depth_m, double nm);

struct volume_view {
    double eye_depth_m; // 0: above the water
    double sun_mu;      // cosine of the star's zenith angle in the air, above 0
    double view_mu; // cosine of the zenith angle of the line of sight, in the eye's medium; above
                    // the water below 0
    double azimuth_rad; // of the line of sight from the star's
};

// Radiance per irradiance of level water from above (sr^-1): by the star, and by a sky of the same
// radiance everywhere. Above the water that which leaves it, without what the surface mirrors;
// below,
// what reaches the eye, with the sky through the surface and without the disc of the star.
struct volume_light {
    double star, sky;
};

// One view. Threads: any.
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result volume_radiance(const trl_context *ctx, const struct volume_column *column,
                                        const struct volume_view *view, struct volume_light *out);

// Depths that a table has: none, then two for each octave from VOLUME_SHALLOWEST_M on, then water
// without a bed.
enum { VOLUME_DEPTHS = 28, VOLUME_ANGLES = 12, VOLUME_ORDERS = 3, VOLUME_WAVELENGTHS = 16 };
#define VOLUME_SHALLOWEST_M 0.03125

// For eyes above the water. Angles are the cosines of refracted rays, evenly from that of grazing
// ones to 1; light is what goes up below the surface per irradiance that has entered, so that what
// the surface takes, which depends on the angle most, is applied exactly.
struct volume_table {
    int count; // of wavelengths
    double nm[VOLUME_WAVELENGTHS];
    double index, critical; // cosine of the refracted grazing ray
    struct volume_column column[VOLUME_WAVELENGTHS];
    // [depth][sun][view][order][wavelength]: of cos(order * azimuth), over that power of the
    // product of the sines of both refracted rays
    float star[VOLUME_DEPTHS][VOLUME_ANGLES][VOLUME_ANGLES][VOLUME_ORDERS][VOLUME_WAVELENGTHS];
    float sky[VOLUME_DEPTHS][VOLUME_ANGLES][VOLUME_WAVELENGTHS]; // [depth][view][wavelength]
};

// At up to VOLUME_WAVELENGTHS wavelengths. Uses every core.
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result volume_table_make(const trl_context *ctx, const struct ocean_desc *ocean,
                                          const double *nm, int count, struct volume_table **out);
// The same, kept on disk from one start to the next.
TRL_MUST_USE trl_result volume_table_get(const trl_context *ctx, const struct ocean_desc *ocean,
                                         const double *nm, int count, struct volume_table **out);
void volume_table_destroy(const trl_context *ctx, struct volume_table **table);

// A table on disk. What it follows from comes first in it, and was zeroed as a whole, padding
// included.
struct volume_kept {
    const char *name; // of its files: each kind has eight
    void *table;
    size_t input_bytes, bytes;
};
// Whether all after the inputs could be read; else it stays. Storing: failure is a warning.
bool volume_cache_load(const trl_context *ctx, const struct volume_kept *kept);
void volume_cache_store(const trl_context *ctx, const struct volume_kept *kept);
struct volume_kept volume_table_kept(struct volume_table *table);

// What leaves the water of that depth, for each wavelength: as volume_radiance.
void volume_table_at(const struct volume_table *table, double depth_m,
                     const struct volume_view *view, struct volume_light out[VOLUME_WAVELENGTHS]);

// What goes up below the surface for one of the table's suns and one of its views.
struct volume_entry {
    double star[VOLUME_ORDERS][VOLUME_WAVELENGTHS]; // per irradiance that has entered: as the
                                                    // table's own
    double sky[VOLUME_WAVELENGTHS];                 // per irradiance of level water from above
};
void volume_table_entry(const struct volume_table *table, double depth_m, int sun, int view,
                        struct volume_entry *out);

// Depth beyond which the bed makes no difference: exp(-24) of light comes back.
double volume_deep_m(const struct volume_column *column);

// The medium without its forward peak.
void volume_medium_make(const struct volume_column *column, const struct water_phase *phase,
                        struct slab_medium *out);

// Cosine of the refracted ray, from the air into water of that index.
double volume_refract(double air_mu, double index);

#endif // OCEAN_VOLUME_H
