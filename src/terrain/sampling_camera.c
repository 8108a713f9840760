// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/sampling_camera.h"

#include "shared/projective.glsl"

#include <math.h>
#include <string.h>

// Beyond the picture's sides, in columns: what is drawn at the border has a neighbour outside.
static const double MARGIN_COLUMNS = 1;
// Where nothing is to be seen, columns are this many times as wide.
static const double SPARSEST = 50;
// Ground much above the horizon is a near slope, and not wider than at the horizon.
static const double STEEPEST_RAD = 1.75;
enum { DENSITY_STEPS = 512 };

// Azimuths are what lies between them: no ground comes from elsewhere.
static struct vec3 column_ray(double azimuth_rad, double omega_rad)
{
    return (struct vec3){sin(omega_rad) * cos(azimuth_rad), sin(omega_rad) * sin(azimuth_rad),
                         -cos(omega_rad)};
}

// Normals of the four sides, inward, in the anchor's axes.
static void find_sides(const struct sampling_camera *s, struct vec3 sides[4])
{
    const struct vec3 x = vec3_scale(s->forward, s->tan_half_fov_x);
    const struct vec3 y = vec3_scale(s->forward, s->tan_half_fov_y);
    sides[0] = vec3_add(x, s->right);
    sides[1] = vec3_sub(x, s->right);
    sides[2] = vec3_add(y, s->up);
    sides[3] = vec3_sub(y, s->up);
}

struct sampling_range sampling_camera_range(const struct sampling_camera *s, double azimuth_rad)
{
    struct vec3 sides[4];
    find_sides(s, sides);
    struct sampling_range range = {0, SHARED_PI};
    for (int i = 0; i < 4; i++) {
        // A ray's distance from the side is proportional to sin(omega - zero).
        const double along = sides[i].x * cos(azimuth_rad) + sides[i].y * sin(azimuth_rad);
        const double zero = atan2(sides[i].z, along);
        range.from_rad = fmax(range.from_rad, zero);
        range.to_rad = fmin(range.to_rad, zero + SHARED_PI);
    }
    return range;
}

static bool sees_vertical(const struct sampling_camera *s)
{
    struct vec3 sides[4];
    find_sides(s, sides);
    bool sees_nadir = true;
    bool sees_zenith = true;
    for (int i = 0; i < 4; i++) {
        const double slack = 1e-3 * vec3_length(sides[i]);
        sees_nadir = sees_nadir && -sides[i].z > -slack;
        sees_zenith = sees_zenith && sides[i].z > -slack;
    }
    return sees_nadir || sees_zenith;
}

// A cone without the vertical lies within half a circle around its middle, and its corners are what
// is farthest to the sides.
static void find_azimuths(struct sampling_camera *s)
{
    const double middle = atan2(s->forward.y, s->forward.x);
    s->is_circle = sees_vertical(s);
    s->from_rad = middle - SHARED_PI;
    s->to_rad = middle + SHARED_PI;
    if (s->is_circle) {
        return;
    }
    double low = 0;
    double high = 0;
    for (int i = 0; i < 4; i++) {
        const struct vec3 x = vec3_scale(s->right, (i % 2 == 0 ? -1 : 1) * s->tan_half_fov_x);
        const struct vec3 y = vec3_scale(s->up, (i < 2 ? -1 : 1) * s->tan_half_fov_y);
        const struct vec3 corner = vec3_add(s->forward, vec3_add(x, y));
        const double away = remainder(atan2(corner.y, corner.x) - middle, 2 * SHARED_PI);
        low = fmin(low, away);
        high = fmax(high, away);
    }
    s->from_rad = middle + low;
    s->to_rad = middle + high;
}

// The tangent of the primary sphere meets the maximum sphere: the occluded area's end (Section 4).
// The highest mountain of the planet may be out of reach; then so is what only it could show.
static void find_reach(const struct surface *surface, struct sampling_camera *s)
{
    double low = surface_min_altitude(surface);
    double high = surface_max_altitude(surface);
    for (int i = 0; i < 3; i++) {
        const double solid_m = fmin(surface->radius_m + low, s->distance_m);
        const double excess = projective_excess(s->distance_m - solid_m, solid_m);
        const double rise = fmax(surface->radius_m + high - solid_m, 0);
        s->reach_rad = fmax(projective_reach(excess, solid_m, rise), 1e-6);
        s->max_altitude_m = high;
        const struct surface_bounds b = surface_bounds_around(surface, s->anchor.up, s->reach_rad);
        low = fmax(low, (double)b.min);
        high = fmin(high, (double)b.max);
    }
}

struct sampling_camera sampling_camera_make(const struct surface *surface,
                                            const struct camera *camera)
{
    const double distance = vec3_length(camera->position_m);
    const double ground = surface->radius_m + surface_altitude(surface, camera->position_m);
    struct sampling_camera s = {.anchor = anchor_below(camera->position_m),
                                .distance_m = distance,
                                .height_m = fmax(distance - ground, 1e-3),
                                .tan_half_fov_x = camera->tan_half_fov_x,
                                .tan_half_fov_y = camera->tan_half_fov_y};
    s.right = anchor_local(&s.anchor, camera->right);
    s.up = anchor_local(&s.anchor, camera->up);
    s.forward = anchor_local(&s.anchor, camera->forward);
    find_reach(surface, &s);
    const double peak = surface->radius_m + s.max_altitude_m;
    s.top_rad = distance > peak ? asin(peak / distance) : SHARED_PI;
    find_azimuths(&s);
    return s;
}

// How fast a point of the picture moves with the azimuth.
static double find_speed(const struct sampling_camera *s, double azimuth_rad, double omega_rad)
{
    const struct vec3 ray = column_ray(azimuth_rad, omega_rad);
    const struct vec3 turn = {-ray.y, ray.x, 0};
    const double z = fmax(vec3_dot(ray, s->forward), 0.05);
    const double x = vec3_dot(ray, s->right) / z;
    const double y = vec3_dot(ray, s->up) / z;
    const double dz = vec3_dot(turn, s->forward);
    return hypot(vec3_dot(turn, s->right) - x * dz, vec3_dot(turn, s->up) - y * dz) / z;
}

static double find_density(const struct sampling_camera *s, double azimuth_rad)
{
    const struct sampling_range range = sampling_camera_range(s, azimuth_rad);
    const double to = fmin(range.to_rad, fmin(s->top_rad, STEEPEST_RAD));
    return range.from_rad > to
               ? 0
               : fmax(find_speed(s, azimuth_rad, range.from_rad), find_speed(s, azimuth_rad, to));
}

// Sums of density up to each of DENSITY_STEPS steps over the azimuths.
static void sum_density(const struct sampling_camera *s, double sums[DENSITY_STEPS + 1])
{
    const double step = (s->to_rad - s->from_rad) / DENSITY_STEPS;
    double most = 0;
    sums[0] = 0;
    for (int i = 0; i < DENSITY_STEPS; i++) {
        sums[i + 1] = find_density(s, s->from_rad + (i + 0.5) * step);
        most = fmax(most, sums[i + 1]);
    }
    for (int i = 0; i < DENSITY_STEPS; i++) {
        sums[i + 1] = sums[i] + fmax(sums[i + 1], most > 0 ? most / SPARSEST : 1);
    }
}

struct surface_eye sampling_camera_eye(const struct sampling_camera *s,
                                       const struct surface *surface)
{
    return (struct surface_eye){.up = s->anchor.up,
                                .reach_rad = s->reach_rad,
                                .height_rad = s->height_m / surface->radius_m};
}

static void put_column(const struct sampling_camera *s, double azimuth_rad, float column[4])
{
    const struct sampling_range range = sampling_camera_range(s, azimuth_rad);
    column[0] = (float)cos(azimuth_rad);
    column[1] = (float)sin(azimuth_rad);
    column[2] = (float)range.from_rad;
    column[3] = (float)range.to_rad;
}

void sampling_camera_columns(const struct sampling_camera *s, uint32_t count, float *columns)
{
    double sums[DENSITY_STEPS + 1];
    sum_density(s, sums);
    const double margin = s->is_circle ? 0 : MARGIN_COLUMNS;
    const double step = (s->to_rad - s->from_rad) / DENSITY_STEPS;
    int at = 0;
    for (uint32_t i = 0; i <= count + 1; i++) {
        const double u = (i - margin) / (count - 2 * margin);
        const double wanted = u * sums[DENSITY_STEPS];
        while (at < DENSITY_STEPS - 1 && sums[at + 1] <= wanted) {
            at++;
        }
        // Straight on beyond both ends.
        const double f = (wanted - sums[at]) / (sums[at + 1] - sums[at]);
        put_column(s, s->from_rad + (at + f) * step, columns + (size_t)4 * i);
    }
    if (s->is_circle) {
        memcpy(columns + (size_t)4 * count, columns, 8 * sizeof *columns);
    }
}
