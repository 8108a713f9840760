// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/air.h"

#include "reference/shells.h"

#include <math.h>

struct reference_ray reference_air_ray(const struct reference_air *air, double radius_m, double mu)
{
    const double bottom = air->bottom_radius_m, top = air->top_radius_m;
    const double perigee2 = radius_m * radius_m * (1 - mu) * (1 + mu);
    const bool hits_bottom = mu < 0 && (radius_m <= bottom || perigee2 < bottom * bottom);
    const double end_m = hits_bottom ? -sqrt(fmax(0, bottom * bottom - perigee2))
                                     : sqrt(fmax(0, top * top - perigee2));
    return (struct reference_ray){.perigee2_m2 = perigee2,
                                  .begin_m = radius_m * mu,
                                  .end_m = fmax(end_m, radius_m * mu),
                                  .hits_bottom = hits_bottom};
}

static double altitude_at(const struct reference_air *air, const struct reference_ray *ray,
                          double s_m)
{
    return sqrt(ray->perigee2_m2 + s_m * s_m) - air->medium->ground_radius_m;
}

// A place between two knots of the table.
struct place {
    const double *below, *above;
    double part; // 0 at the lower one
};

static struct place find_place(const struct reference_air *air, size_t shell, double altitude_m)
{
    const double low_m = air->bound_m[shell], high_m = air->bound_m[shell + 1];
    const double x = (altitude_m - low_m) / (high_m - low_m) * SHELL_INTERVALS;
    const double inside = fmin(fmax(x, 0), SHELL_INTERVALS);
    const int i = inside < SHELL_INTERVALS ? (int)inside : SHELL_INTERVALS - 1;
    const size_t count = air->constituent_count;
    const double *below = air->density + (shell * (SHELL_INTERVALS + 1) + (size_t)i) * count;
    return (struct place){below, below + count, inside - i};
}

void reference_air_densities(const struct reference_air *air, const struct reference_ray *ray,
                             size_t shell, double s_m, struct reference_columns *densities)
{
    const struct place place = find_place(air, shell, altitude_at(air, ray, s_m));
    for (size_t c = 0; c < air->constituent_count; ++c) {
        densities->of[c] = place.below[c] + (place.above[c] - place.below[c]) * place.part;
    }
}

// Gauss-Legendre, three points.
void reference_air_columns(const struct reference_air *air, const struct reference_ray *ray,
                           const struct reference_piece *piece, double s_m,
                           struct reference_columns *columns)
{
    static const double abscissa = 0.774596669241483377; // sqrt(3/5)
    const double middle = 0.5 * (piece->begin_m + s_m);
    const double half_length = 0.5 * (s_m - piece->begin_m);
    struct place place[3];
    for (int i = 0; i < 3; ++i) {
        const double at_m = middle + (i - 1) * abscissa * half_length;
        place[i] = find_place(air, piece->shell, altitude_at(air, ray, at_m));
    }
    const double outer = half_length * 5 / 9, inner = half_length * 8 / 9;
    for (size_t c = 0; c < air->constituent_count; ++c) {
        double value[3];
        for (int i = 0; i < 3; ++i) {
            value[i] = place[i].below[c] + (place[i].above[c] - place[i].below[c]) * place[i].part;
        }
        columns->of[c] = outer * (value[0] + value[2]) + inner * value[1];
    }
}

static size_t find_shell(const struct reference_air *air, double altitude_m)
{
    size_t low = 0, high = air->shell_count;
    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (air->bound_m[middle] <= altitude_m) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

void reference_air_densities_at(const struct reference_air *air, double altitude_m,
                                struct reference_columns *densities)
{
    const struct place place = find_place(air, find_shell(air, altitude_m), altitude_m);
    for (size_t c = 0; c < air->constituent_count; ++c) {
        densities->of[c] = place.below[c] + (place.above[c] - place.below[c]) * place.part;
    }
}

struct reference_walk reference_walk_begin(const struct reference_air *air,
                                           const struct reference_ray *ray)
{
    return (struct reference_walk){.air = air,
                                   .ray = ray,
                                   .shell = find_shell(air, altitude_at(air, ray, ray->begin_m)),
                                   .at_m = ray->begin_m};
}

// Where the outward half of the ray meets a bound; 0 if it passes above it.
static double bound_crossing(const struct reference_walk *walk, size_t bound)
{
    const double radius = walk->air->medium->ground_radius_m + walk->air->bound_m[bound];
    return sqrt(fmax(0, radius * radius - walk->ray->perigee2_m2));
}

// Where the ray leaves its shell, or is closest to the centre; `next` is the shell behind.
static double find_exit(const struct reference_walk *walk, size_t *next)
{
    *next = walk->shell;
    if (walk->at_m < 0) {
        const double crossing = bound_crossing(walk, walk->shell);
        if (crossing > 0 && walk->shell > 0) {
            *next = walk->shell - 1;
            return -crossing;
        }
        return fmin(0, walk->ray->end_m);
    }
    if (walk->shell + 1 < walk->air->shell_count) {
        *next = walk->shell + 1;
        return bound_crossing(walk, walk->shell + 1);
    }
    return walk->ray->end_m;
}

bool reference_walk_next(struct reference_walk *walk, struct reference_piece *piece)
{
    while (walk->at_m < walk->ray->end_m) {
        size_t next;
        double exit_m = find_exit(walk, &next);
        exit_m = fmin(exit_m, walk->ray->end_m);
        const double begin_m = walk->at_m;
        const size_t shell = walk->shell;
        if (exit_m - begin_m > walk->air->split_length_m) {
            exit_m = begin_m + walk->air->split_length_m;
        } else {
            walk->shell = next;
        }
        walk->at_m = fmax(exit_m, begin_m);
        if (exit_m > begin_m) { // else rounding at a bound
            *piece = (struct reference_piece){shell, begin_m, exit_m};
            return true;
        }
    }
    return false;
}
