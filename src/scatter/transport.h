// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_TRANSPORT_H
#define SCATTER_TRANSPORT_H
// Radiance that reaches an eye along one ray, for many suns and azimuths at once and for sixteen
// wavelengths at once: the one kernel under the solver, the tables and the spectral queries.
// docs/physics.md derives it.
//
// Radiance is per unit irradiance of the star (sr^-1).

#include "scatter/sunlight.h"

// Spherical-harmonic moments of the diffuse radiance over shell coordinate and sun, and the diffuse
// irradiance of the ground: a whole multiple-scattering state of a planet.
struct moments {
    const struct optics *optics;
    int lmax;
    int levels; // uniform in the shell coordinate, ground to top
    int suns;
    double sun_centre, sun_width; // the sun grid is uniform in asinh((mu - centre) / width)
    double sun_first, sun_scale;  // asinh at the first sun; index = (asinh - first) * scale
    lanes *radiance;              // [levels][suns][harmonic_count(lmax)]
    float *inverse_sun_sine;      // [suns] of the star's zenith angle; 0 in the zenith and nadir
    lanes *irradiance;            // [suns], of level ground at the reference radius
};

// Grids for the medium; zero everywhere.
TRL_MUST_USE trl_result moments_init(const trl_context *ctx, const struct optics *optics, int lmax,
                                     int levels, int suns, struct moments *out);
void moments_finish(const trl_context *ctx, struct moments *moments);

// Where a shell coordinate lies between the levels.
enum { MOMENTS_TAPS = 4 };
struct moments_levels {
    int first;
    float weight[MOMENTS_TAPS]; // of the levels first, first + 1, ...
};
struct moments_levels moments_levels_at(const struct moments *moments, double shell);

// y += factor x, on the same grids
void moments_add(struct moments *y, const struct moments *x, lanes factor);

double moments_sun_mu(const struct moments *moments, int sun);         // of a grid point
double moments_level_radius(const struct moments *moments, int level); // m

// Irradiance of level ground at the reference radius by the sky, per unit irradiance of the star,
// at the cosine of the star's zenith angle.
lanes moments_irradiance(const struct moments *moments, double mu);

// What varies under one ray: the star's zenith angle at the eye, and the angle between ray and
// star.
struct transport_family {
    int count;
    const float *sun_mu; // cosine of the star's zenith angle at the eye
    const float *nu;     // cosine of the angle between the ray and the star's centre
};

// Where each constituent's single scattering goes: output channel (-1: none), with its phase
// function over the family (NULL: left out, the caller applies it).
struct transport_channels {
    int channel[MEDIUM_MAX_CONSTITUENTS];
    const float *phase[MEDIUM_MAX_CONSTITUENTS]; // [count], sr^-1
};

struct transport_scratch; // per thread
TRL_MUST_USE trl_result transport_scratch_create(const trl_context *ctx, int max_count, int suns,
                                                 struct transport_scratch **out);
void transport_scratch_destroy(const trl_context *ctx, struct transport_scratch **scratch);

// radiance[channel][member] += light scattered once, out of the direct light of the star.
void transport_add_single(const struct sunlight *sun, const struct ray *ray,
                          const struct transport_family *family,
                          const struct transport_channels *channels, lanes *const *radiance,
                          struct transport_scratch *scratch);

// radiance[member] += light scattered out of the radiance of the moments.
void transport_add_multiple(const struct moments *moments, const struct ray *ray,
                            const struct transport_family *family, lanes *radiance,
                            struct transport_scratch *scratch);

// radiance[member] += light of the Lambertian ground, where the ray meets it: lit by the star (sun
// not NULL) and by the diffuse irradiance of the moments (not NULL).
void transport_add_ground(const struct sunlight *sun, const struct moments *moments,
                          const struct ray *ray, const struct transport_family *family,
                          lanes *radiance);

#endif // SCATTER_TRANSPORT_H
