// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_CLOUDS_H
#define REFERENCE_CLOUDS_H
// Clouds as paths meet them: an extinction over space, the same at all wavelengths. Whoever has the
// field says what it is; this module only asks. Free paths are drawn by delta tracking (Woodcock
// 1965), what comes through by ratio tracking (Novak, Selle and Jarosz 2014), both against a bound
// that holds for a ball around a place, so that thin and empty air take few looks.

#include "base/vec3.h"
#include "reference/random.h"

// Functions may be called from many threads. Positions are from the planet's centre.
struct reference_clouds {
    const void *user;
    double highest_m;                     // altitude of the uppermost top
    double albedo;                        // part of what clouds take that they scatter
    double forward_g, back_g, back_share; // two lobes of Henyey and Greenstein
    double (*extinction_per_m)(const void *user, struct vec3 position_m);
    // What the extinction is below within *reach_m of a place; *reach_m > 0.
    double (*most_per_m)(const void *user, struct vec3 position_m, double *reach_m);
};

// A straight way to be tracked through clouds; the direction is a unit vector.
struct reference_clouds_way {
    struct vec3 from_m, direction;
    double length_m;
};

// Distance to a random collision, or INFINITY if there is none on the way.
double reference_clouds_meet(const struct reference_clouds *clouds,
                             const struct reference_clouds_way *way, struct random_stream *random);

// What comes through, at random, with the right mean.
double reference_clouds_passed(const struct reference_clouds *clouds,
                               const struct reference_clouds_way *way,
                               struct random_stream *random);

// Phase function in sr^-1, and a cosine drawn from it.
double reference_clouds_phase(const struct reference_clouds *clouds, double cosine);
double reference_clouds_draw(const struct reference_clouds *clouds, struct random_stream *random);

#endif // REFERENCE_CLOUDS_H
