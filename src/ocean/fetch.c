// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/fetch.h"

#include "terrain/look.h"

#include <math.h>

// Waves come from all directions within 45 degrees of the wind, by the squared cosine (Saville
// 1954, U.S. Beach Erosion Board, Tech. Memo. 70, as a mean).
enum { COURSES = 7 };
static const double COURSE_RAD = M_PI / 12;

// Steps against the wind, over a texel of the mask: the first, each over the one before, the last.
static const double FIRST_STEP = 0.5, STEP_GROWTH = 1.15, LAST_STEP = 4;

// Around the eye: rings, each twice as wide as the one before, the first of so many m.
enum { RINGS = 6, RING_PLACES = 8 };
static const double FIRST_RING_M = 500;

// Of water in a texel of which no mask has any, as a part of the texel, and how much that counts.
static const double UNSEEN_PART = 0.5, UNSEEN_WEIGHT = 1e-6;

// From so high no single water is what an eye sees: all has the scene's fetch.
static const double HIGH_M = 2e4;

static struct vec3 go(struct vec3 up, struct vec3 along, double angle_rad)
{
    return vec3_add(vec3_scale(up, cos(angle_rad)), vec3_scale(along, sin(angle_rad)));
}

// Unit, along the ground.
static struct vec3 find_course(struct vec3 up, double bearing_rad)
{
    const double longitude = atan2(up.y, up.x);
    const struct vec3 east = {-sin(longitude), cos(longitude), 0};
    const struct vec3 north = vec3_cross(up, east);
    return vec3_add(vec3_scale(north, cos(bearing_rad)), vec3_scale(east, sin(bearing_rad)));
}

// Water along a great circle, up to where it is less than half of a place.
static double march_m(const struct surface *surface, struct vec3 from, struct vec3 along,
                      double most_m)
{
    const double texel_m = surface_mask_texel_rad(surface) * surface->radius_m;
    double way_m = 0, step_m = FIRST_STEP * texel_m, was = 1;
    while (way_m < most_m) {
        const double next_m = fmin(way_m + step_m, most_m);
        const double share =
            surface_open_water(surface, go(from, along, next_m / surface->radius_m));
        if (share < 0.5) {
            return way_m + (next_m - way_m) * (was - 0.5) / (was - share);
        }
        was = share;
        way_m = next_m;
        step_m = fmin(STEP_GROWTH * step_m, LAST_STEP * texel_m);
    }
    return most_m;
}

static double find_at(const struct surface *surface, const struct ocean_waves *waves,
                      struct vec3 place)
{
    double sum = 0, weights = 0;
    for (int k = 0; k < COURSES; k++) {
        const double turn = (k - COURSES / 2) * COURSE_RAD, weight = cos(turn) * cos(turn);
        const struct vec3 along = find_course(place, waves->wind_from_rad + turn);
        sum += weight * march_m(surface, place, along, waves->fetch_m);
        weights += weight;
    }
    return sum / weights;
}

// Of the water around, of which what is near counts most.
static double find_around(const struct surface *surface, const struct ocean_waves *waves,
                          struct vec3 up, double height_m)
{
    const double near2 = FIRST_RING_M * FIRST_RING_M + height_m * height_m;
    const double texel_m = surface_mask_texel_rad(surface) * surface->radius_m;
    double weights = UNSEEN_WEIGHT, sum = weights * fmin(UNSEEN_PART * texel_m, waves->fetch_m);
    for (int ring = 0; ring <= RINGS; ring++) {
        const double radius_m = ring > 0 ? FIRST_RING_M * exp2(ring - 1) : 0;
        const int count = ring > 0 ? RING_PLACES : 1;
        for (int k = 0; k < count; k++) {
            const struct vec3 along = find_course(up, 2 * M_PI * (k + 0.5 * ring) / count);
            const struct vec3 place = go(up, along, radius_m / surface->radius_m);
            const double share = fmax(2 * surface_open_water(surface, place) - 1, 0);
            const double falls = 1 + radius_m * radius_m / near2;
            const double weight = share / (falls * falls);
            sum += weight > 0 ? weight * find_at(surface, waves, place) : 0;
            weights += weight;
        }
    }
    return sum / weights;
}

double fetch_find_m(const struct surface *surface, const struct ocean_waves *waves,
                    struct vec3 eye_m)
{
    if (!(surface_mask_texel_rad(surface) > 0)) {
        return waves->fetch_m;
    }
    const double height_m = fmax(vec3_length(eye_m) - surface->radius_m, 0);
    const double high = pow(height_m / HIGH_M, 4), far = high / (1 + high);
    const double around_m =
        far < 1 - 1e-6 ? find_around(surface, waves, vec3_normalize(eye_m), height_m) : 0;
    return around_m + far * (waves->fetch_m - around_m);
}
