// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_CASTER_H
#define REFERENCE_CASTER_H
// The ground of a picture by one ray a pixel, in double: what meshes are judged by.

#include "base/camera.h"
#include "base/context.h"
#include "reference/surface.h"

#include <stdint.h>

struct reference_caster {
    const struct reference_surface *surface;
    double radius_m; // of its sphere
    const struct camera *camera;
    double pixel_rad; // ground that is narrower than a quarter of it, seen from the camera, may be
                      // passed by
};

// What a ray meets first.
struct reference_hit {
    double distance_m; // along the ray; INFINITY: nothing
    struct vec3 at_m;  // from the camera, planet axes
    struct vec3 normal;
};

// Distance of what a ray meets through the point (x, y) in [-1, 1]^2 of the picture, y up;
// INFINITY: nothing within `length_m`.
double reference_caster_ray(const struct reference_caster *caster, double x, double y,
                            double length_m);

// Through the middles of columns x rows pixels, the lowest row first; on all cores.
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result reference_caster_picture(const trl_context *ctx,
                                                 const struct reference_caster *caster,
                                                 const uint32_t size[2],
                                                 struct reference_hit *hits);

#endif // REFERENCE_CASTER_H
