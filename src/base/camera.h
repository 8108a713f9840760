// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_CAMERA_H
#define BASE_CAMERA_H
// A camera as the passes see it: resolved, in the planet frame, in double.

#include "base/vec3.h"

enum { CAMERA_MAX_BODIES = 8 };

// A moon or another planet.
struct camera_body {
    struct vec3 position_m; // of its centre from the planet's
    double radius_m;
    unsigned index; // in the scene's list
};

struct camera {
    struct vec3 position_m;                // from the planet's centre
    struct vec3 right, up, forward;        // orthonormal
    double tan_half_fov_x, tan_half_fov_y; // half extents of the image plane at distance 1
    struct vec3 sun_direction;             // unit, toward the star
    unsigned body_count;                   // of those that the view has
    struct camera_body bodies[CAMERA_MAX_BODIES];
};

// Direction of the image point (x, y) in [-1, 1]^2, y up; not normalised.
static inline struct vec3 camera_ray(const struct camera *camera, double x, double y)
{
    return vec3_add(camera->forward, vec3_add(vec3_scale(camera->right, x * camera->tan_half_fov_x),
                                              vec3_scale(camera->up, y * camera->tan_half_fov_y)));
}

#endif // BASE_CAMERA_H
