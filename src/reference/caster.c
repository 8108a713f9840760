// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "reference/caster.h"

#include <math.h>
#include <omp.h>

static struct reference_way find_way(const struct reference_caster *caster, double x, double y)
{
    return (struct reference_way){caster->camera->position_m,
                                  vec3_normalize(camera_ray(caster->camera, x, y)), INFINITY,
                                  caster->pixel_rad};
}

static double follow(const struct reference_caster *caster, const struct reference_way *way)
{
    const double met = reference_surface_meet(caster->surface, caster->radius_m, way);
    return met >= 0 ? met : HUGE_VAL;
}

double reference_caster_ray(const struct reference_caster *caster, double x, double y)
{
    const struct reference_way way = find_way(caster, x, y);
    return follow(caster, &way);
}

static struct reference_hit cast(const struct reference_caster *caster, double x, double y)
{
    const struct reference_way way = find_way(caster, x, y);
    struct reference_hit hit = {.distance_m = follow(caster, &way)};
    if (isfinite(hit.distance_m)) {
        struct reference_look look;
        hit.at_m = vec3_scale(way.direction, hit.distance_m);
        caster->surface->look(caster->surface->user, vec3_add(way.from_m, hit.at_m), &look);
        hit.normal = look.normal;
    }
    return hit;
}

trl_result reference_caster_picture(const trl_context *ctx, const struct reference_caster *caster,
                                    const uint32_t size[2], struct reference_hit *hits)
{
    trl_result result = TRL_OK; // written by the calling thread, and read at the end
    bool is_stopped = false;
    uint32_t rows_done = 0;
#pragma omp parallel for schedule(dynamic)
    for (uint32_t row = 0; row < size[1]; row++) {
        bool skips;
#pragma omp atomic read
        skips = is_stopped;
        for (uint32_t column = 0; column < size[0] && !skips; column++) {
            hits[(size_t)row * size[0] + column] =
                cast(caster, (2 * column + 1.0) / size[0] - 1, (2 * row + 1.0) / size[1] - 1);
        }
        uint32_t done;
#pragma omp atomic capture
        done = ++rows_done;
        if (omp_get_thread_num() == 0 && !skips) {
            result = trl_progress(ctx, "casting rays", (double)done / size[1]);
#pragma omp atomic write
            is_stopped = result != TRL_OK;
        }
    }
    return result;
}
