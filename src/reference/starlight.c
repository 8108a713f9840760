// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/tracer.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

// Beyond this optical depth light is drawn to come through or not.
static const double certain_depth = 6;

static bool is_in_shadow(const struct reference_tracer *tracer, const struct reference_path *path,
                         const struct reference_ray *ray, struct vec3 direction)
{
    const struct reference_scene *scene = &tracer->world->scene;
    if (!scene->surface) {
        return ray->hits_bottom;
    }
    const struct reference_way way = {path->position, direction, ray->end_m - ray->begin_m, 0};
    return reference_surface_meet(scene->surface, scene->medium->ground_radius_m, &way) >= 0;
}

static double pass_clouds(const struct reference_tracer *tracer, struct reference_path *path,
                          const struct reference_ray *ray, struct vec3 direction)
{
    const struct reference_clouds *clouds = tracer->world->scene.clouds;
    const struct reference_clouds_way way = {path->position, direction, ray->end_m - ray->begin_m};
    return clouds ? reference_clouds_passed(clouds, &way, &path->random) : 1;
}

lanes4 reference_transmittance(const struct reference_tracer *tracer, struct reference_path *path,
                               struct vec3 direction)
{
    const struct reference_air *air = &tracer->world->air;
    const struct reference_optics *optics = &tracer->optics;
    const double mu = vec3_dot(path->position, direction) / vec3_length(path->position);
    const struct reference_ray ray =
        reference_air_ray(air, reference_path_radius(tracer, path), mu);
    if (reference_star_is_hidden(&path->star, path->position, direction) ||
        is_in_shadow(tracer, path, &ray, direction)) {
        return lanes4_set(0);
    }
    const double clear = pass_clouds(tracer, path, &ray, direction);
    if (clear <= 0) {
        return lanes4_set(0);
    }
    lanes4 depth = {0};
    double most = -1; // drawn when it is needed
    struct reference_walk walk = reference_walk_begin(air, &ray);
    for (struct reference_piece piece; reference_walk_next(&walk, &piece);) {
        struct reference_columns columns;
        reference_air_columns(air, &ray, &piece, piece.end_m, &columns);
        depth += reference_optics_extinction(optics, &columns);
        const double least = lanes4_min(&depth, optics->count);
        if (least > certain_depth) {
            most = most < 0 ? certain_depth - log(reference_next(path)) : most;
            if (least > most) {
                return lanes4_set(0);
            }
        }
    }
    const double least = lanes4_min(&depth, optics->count);
    const lanes4 exponent = fmax(0, least - certain_depth) - depth;
    return clear * lanes4_exp(&exponent, optics->count);
}

void reference_add_starlight(const struct reference_tracer *tracer, struct reference_path *path)
{
    const struct reference_star *star = &path->star;
    const double cosine = 1 - reference_next(path) * (1 - star->cos_radius);
    const struct vec3 to_sun =
        reference_turn(star->direction, cosine, 2 * pi * reference_next(path));
    // A disc of uniform radiance that puts an irradiance of 1 on a plane facing it: radiance times
    // solid angle.
    double factor = 2 / (1 + star->cos_radius);
    lanes4 turned;
    if (path->is_on_ground) {
        turned = path->weight * reference_ground_value(tracer, path, to_sun);
    } else {
        turned = path->weight * reference_phase(tracer, path, vec3_dot(path->direction, to_sun));
        if (reference_shares_disc(tracer, star)) {
            const double sampled = 1 / reference_star_solid_angle(star);
            factor *= sampled / (sampled + reference_direction_density(tracer, path, to_sun));
        }
    }
    if (factor > 0 && lanes4_sum(&turned) > 0) {
        path->radiance += turned * factor * reference_transmittance(tracer, path, to_sun);
    }
}
