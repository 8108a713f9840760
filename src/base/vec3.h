// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef BASE_VEC3_H
#define BASE_VEC3_H
// Vectors in double: positions relative to a planet's centre need more digits than a float has.

#include <math.h>

struct vec3 {
    double x, y, z;
};

static inline struct vec3 vec3_add(struct vec3 a, struct vec3 b)
{
    return (struct vec3){a.x + b.x, a.y + b.y, a.z + b.z};
}

static inline struct vec3 vec3_sub(struct vec3 a, struct vec3 b)
{
    return (struct vec3){a.x - b.x, a.y - b.y, a.z - b.z};
}

static inline struct vec3 vec3_scale(struct vec3 a, double s)
{
    return (struct vec3){a.x * s, a.y * s, a.z * s};
}

static inline double vec3_dot(struct vec3 a, struct vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline struct vec3 vec3_cross(struct vec3 a, struct vec3 b)
{
    return (struct vec3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static inline double vec3_length(struct vec3 a)
{
    return sqrt(vec3_dot(a, a));
}

// The zero vector stays zero.
static inline struct vec3 vec3_normalize(struct vec3 a)
{
    const double length = vec3_length(a);
    return length > 0 ? vec3_scale(a, 1 / length) : a;
}

// Unit vector to a planetocentric latitude and longitude, planet frame.
static inline struct vec3 vec3_from_lat_lon(double latitude_rad, double longitude_rad)
{
    return (struct vec3){cos(latitude_rad) * cos(longitude_rad),
                         cos(latitude_rad) * sin(longitude_rad), sin(latitude_rad)};
}

#endif // BASE_VEC3_H
