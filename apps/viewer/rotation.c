// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "rotation.h"

#include <math.h>

struct vector vector_add(struct vector a, struct vector b)
{
    return (struct vector){a.x + b.x, a.y + b.y, a.z + b.z};
}

struct vector vector_scale(struct vector a, double s)
{
    return (struct vector){a.x * s, a.y * s, a.z * s};
}

double vector_dot(struct vector a, struct vector b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

struct vector vector_cross(struct vector a, struct vector b)
{
    return (struct vector){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

double vector_length(struct vector a)
{
    return sqrt(vector_dot(a, a));
}

struct vector vector_normalize(struct vector a)
{
    const double length = vector_length(a);
    return length > 0.0 ? vector_scale(a, 1.0 / length) : a;
}

static struct rotation normalize(struct rotation r)
{
    const double length = sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
    return (struct rotation){r.w / length, r.x / length, r.y / length, r.z / length};
}

struct rotation rotation_about(struct vector axis, double angle_rad)
{
    const double s = sin(0.5 * angle_rad);
    return (struct rotation){cos(0.5 * angle_rad), axis.x * s, axis.y * s, axis.z * s};
}

struct rotation rotation_between(struct vector from, struct vector to)
{
    const double cosine = vector_dot(from, to);
    if (cosine < -1.0 + 1e-12) {
        const struct vector other =
            fabs(from.x) < 0.7 ? (struct vector){1.0, 0.0, 0.0} : (struct vector){0.0, 1.0, 0.0};
        return rotation_about(vector_normalize(vector_cross(from, other)), acos(-1.0));
    }
    // The quaternion of the double angle plus that of none has half the angle, and that is the one
    // wanted.
    const struct vector axis = vector_cross(from, to);
    return normalize((struct rotation){1.0 + cosine, axis.x, axis.y, axis.z});
}

struct rotation rotation_from_axes(struct vector x, struct vector y, struct vector z)
{
    // Squares of four times each component; the largest one is divided by, so that nothing cancels.
    const double w4 = 1.0 + x.x + y.y + z.z;
    const double x4 = 1.0 + x.x - y.y - z.z;
    const double y4 = 1.0 - x.x + y.y - z.z;
    const double z4 = 1.0 - x.x - y.y + z.z;
    const double most = fmax(fmax(w4, x4), fmax(y4, z4));
    struct rotation r;
    if (most == w4) {
        r = (struct rotation){w4, y.z - z.y, z.x - x.z, x.y - y.x};
    } else if (most == x4) {
        r = (struct rotation){y.z - z.y, x4, y.x + x.y, z.x + x.z};
    } else if (most == y4) {
        r = (struct rotation){z.x - x.z, y.x + x.y, y4, z.y + y.z};
    } else {
        r = (struct rotation){x.y - y.x, z.x + x.z, z.y + y.z, z4};
    }
    return normalize(r);
}

struct rotation rotation_multiply(struct rotation a, struct rotation b)
{
    return normalize((struct rotation){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                                       a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                                       a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                                       a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w});
}

struct rotation rotation_invert(struct rotation r)
{
    return (struct rotation){r.w, -r.x, -r.y, -r.z};
}

struct vector rotation_apply(struct rotation r, struct vector v)
{
    const struct vector axis = {r.x, r.y, r.z};
    const struct vector twice = vector_scale(vector_cross(axis, v), 2.0);
    return vector_add(vector_add(v, vector_scale(twice, r.w)), vector_cross(axis, twice));
}

struct rotation rotation_blend(struct rotation a, struct rotation b, double t)
{
    struct rotation difference = rotation_multiply(b, rotation_invert(a));
    if (difference.w < 0.0) { // the same rotation, the shorter way
        difference = (struct rotation){-difference.w, -difference.x, -difference.y, -difference.z};
    }
    const struct vector axis = {difference.x, difference.y, difference.z};
    const double angle_rad = 2.0 * atan2(vector_length(axis), difference.w);
    return rotation_multiply(rotation_about(vector_normalize(axis), t * angle_rad), a);
}
