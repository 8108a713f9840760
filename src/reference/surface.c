// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/surface.h"

#include <math.h>

// Bisection stops at this share of the radius: half a millimetre on Earth.
static const double resolution = 1e-10;
// Steps begin at this many of the surface's own and grow and shrink by 2.
static const double first_steps = 64;

struct march {
    const struct reference_surface *surface;
    const struct reference_way *way;
    double radius_m;
    double radial_m, height2; // of the way's start: along it from the perigee; squared perigee
};

static struct vec3 point_at(const struct march *march, double t)
{
    return vec3_add(march->way->from_m, vec3_scale(march->way->direction, t));
}

// Above the reference sphere.
static double altitude_at(const struct march *march, double t)
{
    const double s = march->radial_m + t;
    return sqrt(march->height2 + s * s) - march->radius_m;
}

static double clearance_at(const struct march *march, double t)
{
    return altitude_at(march, t) -
           march->surface->altitude_m(march->surface->user, point_at(march, t));
}

// The lowest altitude of the way between two places.
static double lowest_between(const struct march *march, double from, double to)
{
    const double perigee = -march->radial_m;
    return altitude_at(march, fmin(fmax(perigee, from), to));
}

static double step_at(const struct march *march, double t)
{
    return march->surface->step_m(march->surface->user, point_at(march, t));
}

// Whether the whole piece is above all ground that it can pass: seen from the centre it is no
// longer than its length over the lowest radius.
static bool is_clear_between(const struct march *march, double from, double to)
{
    const struct reference_surface *surface = march->surface;
    const double lowest = lowest_between(march, from, to);
    const double stretch = march->radius_m / (march->radius_m + fmin(lowest, 0));
    return lowest > surface->ceiling_m(surface->user, point_at(march, from), (to - from) * stretch);
}

// The way is above the ground at `before` and not at `behind`.
static double bisect(const struct march *march, double before, double behind)
{
    while (behind - before > resolution * march->radius_m) {
        const double middle = 0.5 * (before + behind);
        if (clearance_at(march, middle) > 0) {
            before = middle;
        } else {
            behind = middle;
        }
    }
    return before;
}

// Part of the way within the sphere of the highest ground.
static bool clip_to_ground(const struct march *march, double *begin, double *end)
{
    const double ceiling = march->radius_m + march->surface->highest_m;
    if (march->height2 >= ceiling * ceiling) {
        return false;
    }
    const double half = sqrt(ceiling * ceiling - march->height2);
    *begin = fmax(0, -march->radial_m - half);
    *end = fmin(march->way->length_m, -march->radial_m + half);
    return *begin < *end;
}

double reference_surface_meet(const struct reference_surface *surface, double radius_m,
                              const struct reference_way *way)
{
    const double radial = vec3_dot(way->from_m, way->direction);
    const struct vec3 across = vec3_cross(way->from_m, way->direction);
    const struct march march = {.surface = surface,
                                .way = way,
                                .radius_m = radius_m,
                                .radial_m = radial,
                                .height2 = vec3_dot(across, across)};
    double at, end;
    if (!clip_to_ground(&march, &at, &end)) {
        return -1;
    }
    if (clearance_at(&march, at) <= 0) {
        return at;
    }
    double step = first_steps * step_at(&march, at);
    while (at < end) {
        const double next = fmin(at + step, end);
        if (is_clear_between(&march, at, next)) {
            at = next;
            step *= 2;
            continue;
        }
        const double least = step_at(&march, at);
        if (step > least) {
            step = fmax(0.5 * step, least);
            continue;
        }
        if (clearance_at(&march, next) <= 0) {
            return bisect(&march, at, next);
        }
        at = next;
        step *= 2;
    }
    return -1;
}
