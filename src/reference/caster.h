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

// A point of the picture, in [-1, 1]^2, y up: in the middle of a column and (a part of) a row of so
// many, the lowest row first.
struct reference_point {
    double x, y;
};
static inline struct reference_point reference_caster_point(const uint32_t size[2], uint32_t column,
                                                            double row)
{
    return (struct reference_point){(2 * column + 1.0) / size[0] - 1,
                                    (2 * row + 1.0) / size[1] - 1};
}

// What a ray meets first.
struct reference_hit {
    double distance_m; // along the ray; INFINITY: nothing
    struct vec3 at_m;  // from the camera, planet axes
    struct vec3 normal;
};

// Distance of what a ray meets through a point; INFINITY: nothing within `length_m`.
double reference_caster_ray(const struct reference_caster *caster, struct reference_point point,
                            double length_m);

// Through the middles of columns x rows pixels, the lowest row first; on all cores.
// TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result reference_caster_picture(const trl_context *ctx,
                                                 const struct reference_caster *caster,
                                                 const uint32_t size[2],
                                                 struct reference_hit *hits);

#endif // REFERENCE_CASTER_H
