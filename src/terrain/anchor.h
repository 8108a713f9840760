// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_ANCHOR_H
#define TERRAIN_ANCHOR_H
// A place on the planet to which shaders count: offsets from it are floats, it is not.

#include "base/vec3.h"

struct anchor {
    double latitude_rad, longitude_rad;
    struct vec3 east, north, up; // orthonormal, planet frame
    double datum_m;              // altitude that shaders count altitudes from, a float; mostly 0
};

// Below a position. At a pole, east is that of the position's longitude.
static inline struct anchor anchor_below(struct vec3 position)
{
    const double flat = hypot(position.x, position.y);
    const double latitude = atan2(position.z, flat);
    const double longitude = atan2(position.y, position.x);
    const struct vec3 up = vec3_from_lat_lon(latitude, longitude);
    const struct vec3 east = {-sin(longitude), cos(longitude), 0};
    return (struct anchor){latitude, longitude, east, vec3_cross(up, east), up, 0};
}

static inline struct vec3 anchor_local(const struct anchor *anchor, struct vec3 v)
{
    return (struct vec3){vec3_dot(anchor->east, v), vec3_dot(anchor->north, v),
                         vec3_dot(anchor->up, v)};
}

static inline struct vec3 anchor_planet(const struct anchor *anchor, struct vec3 local)
{
    return vec3_add(vec3_scale(anchor->east, local.x),
                    vec3_add(vec3_scale(anchor->north, local.y), vec3_scale(anchor->up, local.z)));
}

// Column-major mat3 that turns planet axes into local ones, and its inverse.
static inline void anchor_local_from_planet(const struct anchor *a, float m[9])
{
    const struct vec3 rows[3] = {a->east, a->north, a->up};
    for (int i = 0; i < 3; i++) {
        m[i] = (float)rows[i].x;
        m[3 + i] = (float)rows[i].y;
        m[6 + i] = (float)rows[i].z;
    }
}

static inline void anchor_planet_from_local(const struct anchor *a, float m[9])
{
    const struct vec3 columns[3] = {a->east, a->north, a->up};
    for (int i = 0; i < 3; i++) {
        m[3 * i] = (float)columns[i].x;
        m[3 * i + 1] = (float)columns[i].y;
        m[3 * i + 2] = (float)columns[i].z;
    }
}

#endif // TERRAIN_ANCHOR_H
