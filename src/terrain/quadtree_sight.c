// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/quadtree_sight.h"

#include "shared/shared.glsl"

#include <math.h>

static double arc_cosine(double x)
{
    return acos(fmax(-1, fmin(1, x)));
}

struct quadtree_sight quadtree_sight_make(const struct surface *surface,
                                          const struct camera *camera)
{
    const struct vec3 p = camera->position_m;
    struct quadtree_sight s = {.camera = camera,
                               .radius_m = surface->radius_m,
                               .distance_m = vec3_length(p),
                               .geo = {atan2(p.z, hypot(p.x, p.y)), atan2(p.y, p.x)}};
    double low = surface_min_altitude(surface);
    double high = surface_max_altitude(surface);
    // The deepest and the highest place of the planet may be out of reach.
    for (int i = 0; i < 2; i++) {
        s.solid_m = s.radius_m + low;
        const double peak = fmax(s.radius_m + high, s.solid_m);
        const double reach = arc_cosine(s.solid_m / s.distance_m) + arc_cosine(s.solid_m / peak);
        const struct surface_bounds b =
            surface_bounds_around(surface, vec3_scale(p, 1 / s.distance_m), fmin(reach, SHARED_PI));
        low = fmax(low, (double)b.min);
        high = fmin(high, (double)b.max);
    }
    s.solid_m = s.radius_m + low;
    return s;
}

static bool is_in_frustum(const struct camera *camera, const struct quadtree_node *n, double radius)
{
    const struct vec3 v = vec3_sub(n->origin_m, camera->position_m);
    const double z = vec3_dot(camera->forward, v);
    const double x = fabs(vec3_dot(camera->right, v));
    const double y = fabs(vec3_dot(camera->up, v));
    const double tx = camera->tan_half_fov_x;
    const double ty = camera->tan_half_fov_y;
    return z > -radius && x - z * tx <= radius * sqrt(1 + tx * tx) &&
           y - z * ty <= radius * sqrt(1 + ty * ty);
}

static bool is_above_horizon(const struct quadtree_sight *s, const struct quadtree_node *n)
{
    const double away =
        arc_cosine(vec3_dot(s->camera->position_m, n->up) / s->distance_m) - n->angle_rad;
    const double peak = fmax(s->radius_m + n->high_m, s->solid_m);
    return away <= arc_cosine(s->solid_m / s->distance_m) + arc_cosine(s->solid_m / peak);
}

bool quadtree_sight_shows(const struct quadtree_sight *s, const struct quadtree_node *n,
                          double margin)
{
    return is_above_horizon(s, n) && is_in_frustum(s->camera, n, margin * n->radius_m);
}

double quadtree_sight_distance_m(const struct quadtree_sight *s, const struct quadtree_node *n)
{
    double low[2];
    double high[2];
    double at[2];
    quadtree_vertex_uv(&n->place, 0, 0, low);
    quadtree_vertex_uv(&n->place, QUADTREE_CELLS, QUADTREE_CELLS, high);
    tiles_map_back(n->place.face, s->geo, 0.5 * (low[0] + high[0]), at);
    for (int k = 0; k < 2; k++) {
        at[k] = fmax(low[k], fmin(high[k], at[k]));
    }
    const struct tiles_geo geo = tiles_geo_at(n->place.face, at[0], at[1]);
    const double altitude = fmax(n->low_m, fmin(n->high_m, s->distance_m - s->radius_m));
    const struct vec3 nearest =
        vec3_scale(vec3_from_lat_lon(geo.latitude_rad, geo.longitude_rad), s->radius_m + altitude);
    return vec3_length(vec3_sub(nearest, s->camera->position_m));
}
