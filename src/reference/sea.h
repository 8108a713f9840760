// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_SEA_H
#define REFERENCE_SEA_H
// Open water as paths meet it: the mean rough surface, facets of normally distributed slopes, over
// a volume that the caller knows. Written apart from what pictures use.

#include "base/vec3.h"
#include "reference/lanes.h"
#include "reference/random.h"

// Cosines of zenith angles, of the light and of the view, and of the azimuth of the line of sight
// from where the light comes from.
struct reference_rays {
    double light_mu, view_mu, azimuth_cosine;
};

struct reference_sea {
    double mean_square_slope; // > 0, along and across together
    double index;             // refractive
    double white_share;       // of the surface, Lambertian with that albedo
    double white_albedo;
    // What comes out of the water at wavelengths: pi times the radiance that leaves per irradiance
    // that has entered, without what the surface takes of it. NULL: nothing.
    const void *user;
    lanes4 (*volume)(const void *user, double depth_code, const struct reference_rays *rays,
                     const lanes4 *nm);
};

// A place of it: unit vectors to the zenith and to where the path came from; how deep it is; the
// path's wavelengths.
struct reference_facets {
    struct vec3 up, view;
    double depth_code;
    const lanes4 *nm;
};

// What goes from one direction to the other, times the cosine of the incident light: sr^-1.
lanes4 reference_sea_value(const struct reference_sea *sea, const struct reference_facets *place,
                           struct vec3 light);

// A direction by the slopes, or by the cosine; upward or not.
struct vec3 reference_sea_draw(const struct reference_sea *sea,
                               const struct reference_facets *place, struct random_stream *random);
// The density of these, sr^-1.
double reference_sea_density(const struct reference_sea *sea, const struct reference_facets *place,
                             struct vec3 light);

#endif // REFERENCE_SEA_H
