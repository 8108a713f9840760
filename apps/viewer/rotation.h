// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef VIEWER_ROTATION_H
#define VIEWER_ROTATION_H
// Vectors and rotations in double, for a camera that moves from metres to radii of planets.

struct vector {
    double x, y, z;
};

// Unit quaternion: turns a vector about an axis.
struct rotation {
    double w, x, y, z;
};

struct vector vector_add(struct vector a, struct vector b);
struct vector vector_scale(struct vector a, double s);
double vector_dot(struct vector a, struct vector b);
struct vector vector_cross(struct vector a, struct vector b);
double vector_length(struct vector a);
struct vector vector_normalize(struct vector a); // the zero vector stays zero

// Right-handed, about a unit axis.
struct rotation rotation_about(struct vector axis, double angle_rad);
// The smallest one that carries one unit vector to another; opposite ones: half a turn about any
// normal.
struct rotation rotation_between(struct vector from, struct vector to);
// The one that carries x, y, z to these orthonormal, right-handed vectors.
struct rotation rotation_from_axes(struct vector x, struct vector y, struct vector z);
// First b, then a.
struct rotation rotation_multiply(struct rotation a, struct rotation b);
struct rotation rotation_invert(struct rotation r);
struct vector rotation_apply(struct rotation r, struct vector v);
// From a (t = 0) to b (t = 1) with constant speed along the shorter way.
struct rotation rotation_blend(struct rotation a, struct rotation b, double t);

#endif // VIEWER_ROTATION_H
