// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_SURFACE_H
#define REFERENCE_SURFACE_H
// The ground as paths meet it: a height over each direction from the planet's centre, lit as
// Lambert says. Whoever has the heights and colours says what they are; this module only asks.

#include "base/vec3.h"
#include "reference/sea.h"
#include "reference/under.h"

#include <stdbool.h>

// What is seen at a place of the ground. Colours are linear sRGB, in the star's own light.
struct reference_look {
    struct vec3 normal; // unit
    bool has_colour;    // else its albedo is the medium's
    double albedo_rgb[3];
    double water;       // part that is open water, which reflects as the surface's sea does
    double depth_code;  // of that: struct reference_facets
    double glow_rgb[3]; // light of its own: 1 is white of `white_cd_m2`
};

// Functions may be called from many threads. Directions are from the planet's centre, of any
// length but 0.
struct reference_surface {
    const void *user;
    double lowest_m, highest_m;   // altitudes between which the ground lies
    struct reference_sea sea;     // where a look says that there is water
    struct reference_under under; // where the eye is below it
    double white_cd_m2;           // luminance of the ground's own light where that is white
    // Altitude above the medium's ground.
    double (*altitude_m)(const void *user, struct vec3 direction);
    // Along the ground within `reach_m` the height bends as a parabola does over this length,
    // nearly: half a texel of the finest raster there; > 0.
    double (*step_m)(const void *user, struct vec3 direction, double reach_m);
    // Whether no ground within `reach_m` (along the ground) rises above an altitude; false also
    // where that is not known.
    bool (*is_below)(const void *user, struct vec3 direction, double reach_m, double altitude_m);
    void (*look)(const void *user, struct vec3 direction, struct reference_look *look);
};

// A straight way: from a point, a unit direction, no farther than `length_m`.
struct reference_way {
    struct vec3 from_m, direction;
    double length_m;
    double pixel_rad; // what is narrower, seen from the start, is not looked for; 0: everything is
};

// Distance along the way to the first ground of a surface over a sphere of `radius_m`, or a
// negative number if there is none. A way that begins below the ground meets it at once. Between
// places that are looked at the height may leave a parabola through three of them by eight times
// what that parabola bends; where it bends more, the way is halved, down to a 64th of `step_m` or a
// quarter of a pixel.
double reference_surface_meet(const struct reference_surface *surface, double radius_m,
                              const struct reference_way *way);

#endif // REFERENCE_SURFACE_H
