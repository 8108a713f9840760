// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef SCATTER_UMBRA_H
#define SCATTER_UMBRA_H
// Light that was scattered before, in and around the shadow of a body: how much of it is left
// where the star is covered. The medium counts as level layers under one height of the star, with
// the depths and distances of rays on the sphere; scattering as isotropic with the scattering
// coefficient times 1 - g (van de Hulst's similarity). docs/physics.md, section 23.
//
// Places are given across the shadow's axis: u along the horizon's direction to the star as it is
// seen along the axis, v beside it, in m; and by altitude.

#include "scatter/bands.h"
#include "scatter/ray.h"

enum {
    UMBRA_US = 40,        // over (-1, 1) of umbra_coordinate
    UMBRA_VS = 20,        // over [0, 1): both sides are alike
    UMBRA_ALTITUDES = 12, // top (k / (UMBRA_ALTITUDES - 1))^2
    UMBRA_RINGS = 19,     // of horizontal distance: 0, then by the root of 2
    UMBRA_PLACES = UMBRA_VS * UMBRA_US
};

typedef float umbra_bands __attribute__((vector_size(16)));

// How far scattered light comes from: of the light of unit sources at another altitude and at a
// horizontal distance that reaches a place.
struct umbra_kernel {
    const struct optics *optics;
    int lane[BAND_COUNT];
    double altitude_m[UMBRA_ALTITUDES];
    double ring_m[UMBRA_RINGS];
    // Mean intensity at the first altitude per intensity that is scattered isotropically at the
    // second; at an altitude per radiance of the ground; irradiance of the ground.
    umbra_bands air_air[UMBRA_ALTITUDES][UMBRA_ALTITUDES][UMBRA_RINGS];
    umbra_bands air_ground[UMBRA_ALTITUDES][UMBRA_RINGS];
    umbra_bands ground_air[UMBRA_ALTITUDES][UMBRA_RINGS];
    umbra_bands ground_albedo;
};

// The optics must outlive the kernel. Takes some milliseconds.
void umbra_kernel_init(const struct optics *optics, const int lane[BAND_COUNT],
                       struct umbra_kernel *kernel);

// Whether light that similarity does not count as scattered is in the beam.
enum umbra_beam { UMBRA_SIMILAR, UMBRA_WHOLE };

// What is left of the star's light at an altitude; the cosine of its zenith angle is above 0.
umbra_bands umbra_kernel_direct(const struct umbra_kernel *kernel, double altitude_m, double mu,
                                enum umbra_beam beam);

struct umbra_shadow {
    double radius_m; // of the body
    double along_m;  // of the ground behind it
    double star_rad; // angular radius
    double star_mu;  // cosine of the star's zenith angle, > 0
    int orders;      // scatterings and reflections that light may have; 0: all
};

// Shares of light less the visible part of the star, which is known better between the nodes; u
// fastest, then v, then altitude.
struct umbra_map {
    double scale_m;                               // of umbra_coordinate
    float air[UMBRA_ALTITUDES * UMBRA_PLACES][4]; // of light that the air scatters again,
                                                  // X, Y, Z; fourth: forward
    float ground[UMBRA_PLACES][4];                // of the sky's light on the ground, in bands
};

// In (-1, 1).
static inline double umbra_coordinate(double across_m, double scale_m)
{
    const double size_m = across_m < 0 ? -across_m : across_m;
    return across_m / (size_m + scale_m);
}

// Takes 0.3 s. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result umbra_map_make(const trl_context *ctx, const struct umbra_kernel *kernel,
                                       const struct umbra_shadow *shadow, const struct bands *bands,
                                       struct umbra_map *out);

#endif // SCATTER_UMBRA_H
