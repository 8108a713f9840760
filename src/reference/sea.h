// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_SEA_H
#define REFERENCE_SEA_H
// Open water as paths meet it: the mean rough surface, facets of normally distributed slopes, over
// a volume that sends light back as Lambert's law has it. Written apart from what pictures use.

#include "base/vec3.h"
#include "reference/lanes.h"
#include "reference/random.h"

struct reference_sea {
    double mean_square_slope; // > 0, along and across together
    double index;             // refractive
    double white_share;       // of the surface, Lambertian with that albedo
    double white_albedo;
};

// A place of it: unit vectors to the zenith and to where the path came from; albedo of the volume
// as of struct sky_sea.
struct reference_facets {
    struct vec3 up, view;
    lanes4 volume;
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
