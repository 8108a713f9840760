// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_PROJECTION_H
#define TERRAIN_PROJECTION_H
// The projection camera of Michelic 2019, Section 3: for which place and height a grid around the
// camera's ground point was made, and when it must be made anew.

#include "base/camera.h"
#include "terrain/surface.h"

// z_s of Eq. 3: a grid lifted by it reaches the peak (at `peak_m` from the centre) that just shows
// behind the horizon of a sphere of `ground_m`, seen from `distance_m`. All > 0;
// peak_m, distance_m >= ground_m. It is the cotangent of the angle at the centre.
double projection_lift(double distance_m, double ground_m, double peak_m);

struct projection {
    bool is_made;
    uint64_t revision;      // of the surface
    struct vec3 position_m; // of the projection camera
    struct anchor anchor;   // below it
    double threshold_m;     // how far the camera may move away from position_m
    double height_m;        // above the ground
    // What lies within needs no smaller cells than what lies there: the height, or a few texels of
    // the finest elevations in reach.
    double near_m;
    double reach_rad;      // angle at the centre that covers all that may be seen
    double lift;           // z_s for that
    double solid_m;        // radius of the sphere that is all below ground, within reach
    double max_altitude_m; // within reach
};

// True when `p` was made for another place than the camera's, or for other heights within its reach
// and `more_rad`.
bool projection_is_stale(const struct projection *p, const struct surface *surface, double more_rad,
                         const struct camera *camera);
// How far the camera has moved of how far it may. Only of one that is made.
double projection_moved(const struct projection *p, const struct camera *camera);
struct projection projection_make(const struct surface *surface, const struct camera *camera);

// The eye of surface_select for what a projection shows, and `more_rad` around it.
struct surface_eye projection_eye(const struct projection *p, const struct surface *surface,
                                  double more_rad);

// Exponent of the warp for which ring `ring` of `rings` of a grid that reaches 1 at the last lies
// at `near`; within [1, 4].
double projection_power(double near, double ring, double rings);

#endif // TERRAIN_PROJECTION_H
