// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef REFERENCE_STAR_H
#define REFERENCE_STAR_H
// The star: a disc, infinitely far away, that lights with one radiance all over, and bodies that
// may stand in front of it.

#include "base/vec3.h"

#include <stdbool.h>
#include <stddef.h>

// A black sphere.
struct reference_occluder {
    struct vec3 position_m; // from the planet's centre
    double radius_m;
};

struct reference_star {
    struct vec3 direction; // unit, toward its centre
    double cos_radius;     // of its angular radius
    size_t occluder_count;
    const struct reference_occluder *occluders;
};

// Whether a body stands in the way from a point along a unit direction.
static inline bool reference_star_is_hidden(const struct reference_star *star, struct vec3 from_m,
                                            struct vec3 direction)
{
    for (size_t i = 0; i < star->occluder_count; ++i) {
        const struct reference_occluder *body = &star->occluders[i];
        const struct vec3 to_body = vec3_sub(body->position_m, from_m);
        const struct vec3 across = vec3_cross(to_body, direction);
        if (vec3_dot(to_body, direction) > 0 &&
            vec3_dot(across, across) < body->radius_m * body->radius_m) {
            return true;
        }
    }
    return false;
}

// Solid angle of the disc; 0 for a point.
static inline double reference_star_solid_angle(const struct reference_star *star)
{
    return 2 * 3.14159265358979323846 * (1 - star->cos_radius);
}

#endif // REFERENCE_STAR_H
