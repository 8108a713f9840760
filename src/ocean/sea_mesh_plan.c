// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/sea_mesh.h"

#include <math.h>

// Displacement ends where waves are so many pixels high.
static const double LEAST_PIXELS = 0.5;
// Crests of a sea are lower than this part of its significant height (one in 10^6 waves is higher).
static const double HIGHEST_CREST = 1.3;
// The nearest water in a picture of the level sea is seen this much nearer over a trough, and
// spokes reach this much farther, so that what waves move in from the side is there.
static const double NEARER = 0.3, ASIDE_RAD = 0.12;
// Ring 1 is not nearer than this part of the eye's height.
static const double LEAST_INNER = 0.05;
static const double LEAST_HEIGHT_M = 0.02;

// What of the water a picture shows, from rays around its border.
struct outlook {
    double steepest_rad; // below the horizontal
    double left_rad, right_rad;
    bool is_round;
};

// The place of a ray in the axes of the eye: right of the heading, ahead, up.
struct axes {
    struct vec3 right, ahead, up;
};

static struct axes find_axes(const struct camera *camera)
{
    struct axes a = {.up = vec3_normalize(camera->position_m)};
    // What is level of the view's axis, or of the picture's top where it looks straight down.
    const double down = vec3_dot(camera->forward, a.up);
    const struct vec3 lead = fabs(down) < 0.9 ? camera->forward : camera->up;
    a.ahead = vec3_normalize(vec3_sub(lead, vec3_scale(a.up, vec3_dot(lead, a.up))));
    a.right = vec3_cross(a.ahead, a.up);
    return a;
}

static void look_along(struct outlook *o, const struct axes *axes, struct vec3 ray)
{
    const double ahead = vec3_dot(ray, axes->ahead), right = vec3_dot(ray, axes->right);
    const double azimuth = atan2(right, ahead);
    o->steepest_rad = fmax(o->steepest_rad, atan2(-vec3_dot(ray, axes->up), hypot(right, ahead)));
    o->left_rad = fmin(o->left_rad, azimuth);
    o->right_rad = fmax(o->right_rad, azimuth);
}

static bool shows(const struct camera *camera, struct vec3 direction)
{
    const double along = vec3_dot(direction, camera->forward);
    return along > 0 && fabs(vec3_dot(direction, camera->right)) < along * camera->tan_half_fov_x &&
           fabs(vec3_dot(direction, camera->up)) < along * camera->tan_half_fov_y;
}

static struct outlook look_around(const struct camera *camera, const struct axes *axes)
{
    enum { STEPS = 32 };
    struct outlook o = {-M_PI / 2, M_PI, -M_PI, false};
    for (int i = 0; i <= STEPS; i++) {
        const double t = 2.0 * i / STEPS - 1;
        look_along(&o, axes, camera_ray(camera, t, -1));
        look_along(&o, axes, camera_ray(camera, t, 1));
        look_along(&o, axes, camera_ray(camera, -1, t));
        look_along(&o, axes, camera_ray(camera, 1, t));
    }
    const bool shows_nadir = shows(camera, vec3_scale(axes->up, -1));
    o.steepest_rad = shows_nadir ? M_PI / 2 : o.steepest_rad;
    o.is_round = shows_nadir || shows(camera, axes->up) || o.right_rad - o.left_rad > 5;
    return o;
}

static void place_spokes(SeaGrid *grid, const struct outlook *o, const struct axes *axes)
{
    const struct vec3 up = axes->up;
    const double flat = hypot(up.x, up.y);
    // At a pole, east is that of longitude 0: as of the waves' axes.
    const struct vec3 east =
        flat > 0 ? (struct vec3){-up.y / flat, up.x / flat, 0} : (struct vec3){0, 1, 0};
    const struct vec3 north = vec3_cross(up, east);
    const double heading = atan2(vec3_dot(axes->ahead, east), vec3_dot(axes->ahead, north));
    const double width = o->right_rad - o->left_rad + 2 * ASIDE_RAD;
    const bool is_round = o->is_round || width > 2 * M_PI;
    grid->begin = is_round ? 0 : heading + o->left_rad - ASIDE_RAD;
    grid->step = (is_round ? 2 * M_PI : width) / SEA_GRID_SPOKES;
}

struct sea_mesh_plan sea_mesh_plan_make(const struct camera *camera, double radius_m,
                                        double height_m, double pixel_rad)
{
    const double eye_m = vec3_length(camera->position_m) - radius_m;
    struct sea_mesh_plan plan = {.eye_height_m = eye_m};
    const double reach_m = height_m / (LEAST_PIXELS * pixel_rad);
    if (!(eye_m > 0 && eye_m < reach_m && height_m > LEAST_HEIGHT_M)) {
        return plan;
    }
    const struct axes axes = find_axes(camera);
    const struct outlook o = look_around(camera, &axes);
    plan.is_seen = true;
    plan.grid.reach = reach_m;
    place_spokes(&plan.grid, &o, &axes);
    const double crest_m = HIGHEST_CREST * height_m;
    const double horizon_m = sqrt(2 * radius_m * eye_m) + sqrt(2 * radius_m * crest_m);
    const double outer_m = fmin(reach_m, fmin(horizon_m, radius_m / 8));
    const double nearest_m = eye_m / tan(fmax(o.steepest_rad, 1e-3));
    plan.grid.inner = fmin(fmax(NEARER * nearest_m, LEAST_INNER * eye_m), outer_m / 4);
    plan.grid.growth = log(outer_m / plan.grid.inner) / (SEA_GRID_RINGS - 1);
    return plan;
}
