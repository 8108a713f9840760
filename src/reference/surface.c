// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/surface.h"

#include <math.h>

// Bisection stops at this share of the radius (half a millimetre on Earth) or of the way, whichever
// is less, but not below what doubles resolve.
static const double resolution = 1e-10;
static const double way_resolution = 1e-6;
static const double rounding = 1e-15;
// Steps begin at this many of the surface's own and grow and shrink by 2.
static const double first_steps = 64;
// Pieces of a way that are looked at, and the smallest, in steps of the surface.
static const double piece_steps = 2;
static const double least_steps = 1.0 / 64;
// A clearance that falls by this many bends over a quarter of a piece crosses zero once there.
static const double steep = 2;

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

// What is looked for around a piece of the way.
static double step_within(const struct march *march, double from, double to)
{
    const struct reference_way *way = march->way;
    const double step =
        march->surface->step_m(march->surface->user, point_at(march, from), to - from);
    return fmax(step, 0.25 * way->pixel_rad * from);
}

// Whether the whole piece is above all ground that it can pass, around its middle: seen from the
// centre a way is no longer than its length over the lowest radius.
static bool is_clear_between(const struct march *march, double from, double to)
{
    const struct reference_surface *surface = march->surface;
    const double lowest = lowest_between(march, from, to);
    const double stretch = march->radius_m / (march->radius_m + fmin(lowest, 0));
    const double reach = 0.5 * (to - from) * stretch;
    return surface->is_below(surface->user, point_at(march, 0.5 * (from + to)), reach, lowest);
}

// The way is above the ground at `before` and not at `behind`.
static double bisect(const struct march *march, double before, double behind)
{
    const double least =
        fmin(resolution * march->radius_m, way_resolution * before) + rounding * march->radius_m;
    while (behind - before > least) {
        const double middle = 0.5 * (before + behind);
        if (clearance_at(march, middle) > 0) {
            before = middle;
        } else {
            behind = middle;
        }
    }
    return before;
}

// A piece of the way, with the clearance at its begin, middle and end.
struct piece {
    double from, to;
    double clear[3];
};

static struct piece half_piece(const double clear[5], const struct piece *piece, int half)
{
    const double middle = 0.5 * (piece->from + piece->to);
    return (struct piece){half ? middle : piece->from,
                          half ? piece->to : middle,
                          {clear[2 * half], clear[2 * half + 1], clear[2 * half + 2]}};
}

// How much the clearance bends over a quarter of the piece.
static double find_bend(const double clear[5])
{
    double bend = 0;
    for (int i = 1; i < 4; i++) {
        bend = fmax(bend, fabs(clear[i - 1] - 2 * clear[i] + clear[i + 1]));
    }
    return bend;
}

// The first place of the piece where the way goes under the ground, or a negative number. A
// parabola dips below the lower of two samples by an eighth of its bend at most.
static double search(const struct march *march, const struct piece *piece, double least)
{
    const double quarter = 0.25 * (piece->to - piece->from);
    const double clear[5] = {piece->clear[0], clearance_at(march, piece->from + quarter),
                             piece->clear[1], clearance_at(march, piece->to - quarter),
                             piece->clear[2]};
    const double bend = find_bend(clear);
    int first = 0;
    while (first < 5 && clear[first] > bend) {
        first++;
    }
    if (first == 5) {
        return -1;
    }
    const bool is_smallest = piece->to - piece->from <= least;
    while (is_smallest && first < 5 && clear[first] > 0) {
        first++;
    }
    if (first == 5) {
        return -1;
    }
    const bool is_crossed = first > 0 && clear[first] <= 0;
    if (is_crossed && (is_smallest || clear[first - 1] - clear[first] > steep * bend)) {
        return bisect(march, piece->from + (first - 1) * quarter, piece->from + first * quarter);
    }
    if (is_smallest) {
        return piece->from;
    }
    for (int half = 0; half < 2; half++) {
        const struct piece part = half_piece(clear, piece, half);
        const double at = search(march, &part, least);
        if (at >= 0) {
            return at;
        }
    }
    return -1;
}

static double search_between(const struct march *march, double from, double to, double step)
{
    const struct piece piece = {from,
                                to,
                                {clearance_at(march, from), clearance_at(march, 0.5 * (from + to)),
                                 clearance_at(march, to)}};
    return search(march, &piece, least_steps * step);
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
    double length = first_steps * step_within(&march, at, at);
    while (at < end) {
        const double next = fmin(at + length, end);
        if (is_clear_between(&march, at, next)) {
            at = next;
            length *= 2;
            continue;
        }
        const double step = step_within(&march, at, next);
        if (length > piece_steps * step) {
            length = fmax(0.5 * length, 0.5 * piece_steps * step);
            continue;
        }
        const double met = search_between(&march, at, next, step);
        if (met >= 0) {
            return met;
        }
        at = next;
        length *= 2;
    }
    return -1;
}
