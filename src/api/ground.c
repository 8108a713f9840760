// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "api/ground.h"

#include "api/check.h"
#include "scene/camera.h"

#include <math.h>
#include <string.h>

trl_result trl_ground_create(trl_context *ctx, const trl_scene *scene, trl_ground **out)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, out != NULL);
    *out = NULL;
    TRL_REQUIRE(ctx, scene != NULL);
    trl_ground *ground = mem_alloc(ctx, 1, sizeof *ground);
    if (!ground) {
        return TRL_ERROR_MEMORY;
    }
    ground->ctx = ctx;
    ground->scene = scene;
    const trl_result result = relief_init_heights(ctx, scene, &ground->relief);
    if (result != TRL_OK) {
        mem_free(ctx, ground);
        return result;
    }
    ground->surface = relief_surface(&ground->relief);
    *out = ground;
    return TRL_OK;
}

void trl_ground_destroy(trl_ground **ground)
{
    if (!ground || !*ground) {
        return;
    }
    const trl_context *ctx = (*ground)->ctx;
    relief_finish(&(*ground)->relief);
    mesh_truth_finish(&(*ground)->truth);
    mem_free(ctx, *ground);
    *ground = NULL;
}

double trl_ground_altitude_m(const trl_ground *ground, double latitude_rad, double longitude_rad)
{
    const bool is_place = isfinite(latitude_rad) && isfinite(longitude_rad);
    return ground && is_place ? relief_altitude_m(&ground->relief, latitude_rad, longitude_rad) : 0;
}

trl_result ground_camera(const trl_ground *ground, const trl_view *view, double aspect,
                         struct camera *out)
{
    const struct trl_scene *scene = ground->scene;
    const struct camera_place place = {
        .radius_m = scene->medium.ground_radius_m,
        .ground_altitude_m =
            relief_altitude_m(&ground->relief, view->latitude_rad, view->longitude_rad),
        .bodies = scene->bodies,
        .body_count = scene->body_count};
    const trl_result result = camera_check(ground->ctx, view, &place);
    if (result == TRL_OK) {
        *out = camera_resolve(view, &place, aspect);
    }
    return result;
}

struct reference_caster ground_caster(const trl_ground *ground, const struct camera *camera,
                                      uint32_t height)
{
    return (struct reference_caster){.surface = &ground->surface,
                                     .radius_m = ground->scene->medium.ground_radius_m,
                                     .camera = camera,
                                     .pixel_rad = 2 * camera->tan_half_fov_y / height};
}

static bool is_same(struct vec3 a, struct vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

static bool is_same_sight(const struct camera *a, const struct camera *b)
{
    return is_same(a->position_m, b->position_m) && is_same(a->forward, b->forward) &&
           is_same(a->up, b->up) && a->tan_half_fov_x == b->tan_half_fov_x &&
           a->tan_half_fov_y == b->tan_half_fov_y;
}

trl_result ground_cast(trl_ground *ground, const struct reference_caster *caster,
                       const uint32_t size[2])
{
    const struct mesh_truth *truth = &ground->truth;
    const bool is_as_large = truth->columns == size[0] && truth->rows == size[1];
    if (truth->hits && is_as_large && is_same_sight(&ground->camera, caster->camera)) {
        return TRL_OK;
    }
    mesh_truth_finish(&ground->truth);
    ground->camera = *caster->camera;
    return mesh_truth_init(ground->ctx, caster, size, &ground->truth);
}

static void copy_vector(struct vec3 from, double to[3])
{
    to[0] = from.x;
    to[1] = from.y;
    to[2] = from.z;
}

trl_result trl_ground_cast(trl_ground *ground, const trl_view *view, uint32_t width,
                           uint32_t height, trl_ground_point *points)
{
    if (!ground) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ground->ctx, view != NULL);
    TRL_REQUIRE(ground->ctx, points != NULL);
    trl_result result = check_size(ground->ctx, width, height);
    if (result == TRL_OK) {
        result = check_view(ground->ctx, view, ground->scene);
    }
    struct camera camera;
    if (result == TRL_OK) {
        result = ground_camera(ground, view, (double)width / height, &camera);
    }
    if (result == TRL_OK) {
        const struct reference_caster caster = ground_caster(ground, &camera, height);
        result = ground_cast(ground, &caster, (const uint32_t[2]){width, height});
    }
    for (size_t i = 0; result == TRL_OK && i < (size_t)width * height; i++) {
        const size_t row = height - 1 - i / width;
        const struct reference_hit *hit = &ground->truth.hits[row * width + i % width];
        points[i].distance_m = hit->distance_m;
        copy_vector(hit->at_m, points[i].position_m);
        copy_vector(hit->normal, points[i].normal);
    }
    return result;
}
