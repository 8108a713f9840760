// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/caster.h"

#include "reference/rows.h"

#include <math.h>

static struct reference_way find_way(const struct reference_caster *caster,
                                     struct reference_point point)
{
    return (struct reference_way){.from_m = caster->camera->position_m,
                                  .direction =
                                      vec3_normalize(camera_ray(caster->camera, point.x, point.y)),
                                  .length_m = INFINITY,
                                  .pixel_rad = caster->pixel_rad};
}

static double follow(const struct reference_caster *caster, const struct reference_way *way)
{
    const double met = reference_surface_meet(caster->surface, caster->radius_m, way);
    return met >= 0 ? met : HUGE_VAL;
}

double reference_caster_ray(const struct reference_caster *caster, struct reference_point point,
                            double length_m)
{
    struct reference_way way = find_way(caster, point);
    way.length_m = length_m;
    return follow(caster, &way);
}

static struct reference_hit cast(const struct reference_caster *caster,
                                 struct reference_point point)
{
    const struct reference_way way = find_way(caster, point);
    struct reference_hit hit = {.distance_m = follow(caster, &way)};
    if (isfinite(hit.distance_m)) {
        struct reference_look look;
        hit.at_m = vec3_scale(way.direction, hit.distance_m);
        caster->surface->look(caster->surface->user, vec3_add(way.from_m, hit.at_m), &look);
        hit.normal = look.normal;
    }
    return hit;
}

struct picture {
    const struct reference_caster *caster;
    const uint32_t *size;
    struct reference_hit *hits;
};

static void cast_row(void *user, uint32_t row)
{
    const struct picture *p = user;
    for (uint32_t column = 0; column < p->size[0]; column++) {
        p->hits[(size_t)row * p->size[0] + column] =
            cast(p->caster, reference_caster_point(p->size, column, row));
    }
}

trl_result reference_caster_picture(const trl_context *ctx, const struct reference_caster *caster,
                                    const uint32_t size[2], struct reference_hit *hits)
{
    struct picture picture = {caster, size, hits};
    return reference_rows(ctx, "casting rays", size[1], cast_row, &picture);
}
