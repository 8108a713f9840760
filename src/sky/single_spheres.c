// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/single_spheres.h"

#include <math.h>
#include <stdio.h>

// Rows from the south pole to the north, columns once around: the first and the last column meet.
static void fill_directions(uint32_t side, float *directions)
{
    for (uint32_t y = 0; y < side; y++) {
        const double latitude = M_PI * ((double)y / (side - 1) - 0.5);
        for (uint32_t x = 0; x < side; x++) {
            const double longitude = 2 * M_PI * x / (side - 1);
            float *d = directions + 3 * ((size_t)y * side + x);
            d[0] = (float)(cos(latitude) * cos(longitude));
            d[1] = (float)(cos(latitude) * sin(longitude));
            d[2] = (float)sin(latitude);
        }
    }
}

// Counter-clockwise from outside.
static void fill_triangles(uint32_t side, uint32_t *index)
{
    for (uint32_t y = 0; y + 1 < side; y++) {
        for (uint32_t x = 0; x + 1 < side; x++) {
            const uint32_t at = y * side + x;
            const uint32_t corners[6] = {at, at + 1, at + side, at + side, at + 1, at + side + 1};
            for (int k = 0; k < 6; k++) {
                *index++ = corners[k];
            }
        }
    }
}

static trl_result make_mesh(struct single_spheres *spheres, uint32_t side)
{
    const trl_context *ctx = spheres->gpu->ctx;
    const uint32_t index_count = 6 * (side - 1) * (side - 1);
    float *directions = mem_alloc(ctx, (size_t)3 * side * side, sizeof *directions);
    uint32_t *indices = mem_alloc(ctx, index_count, sizeof *indices);
    trl_result result = directions && indices ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        fill_directions(side, directions);
        fill_triangles(side, indices);
        const struct gpu_mesh_desc desc = {.label = "sphere",
                                           .primitive = GPU_PRIMITIVE_TRIANGLES,
                                           .vertex_count = side * side,
                                           .vertex_stride = 3 * sizeof(float),
                                           .vertices = directions,
                                           .index_count = index_count,
                                           .indices = indices,
                                           .attribute_count = 1,
                                           .attributes = {{.components = 3}}};
        result = gpu_mesh_init(spheres->gpu, &desc, &spheres->mesh);
    }
    mem_free(ctx, directions);
    mem_free(ctx, indices);
    spheres->side = result == TRL_OK ? side : 0;
    return result;
}

static trl_result make_programs(struct single_spheres *spheres, int channels)
{
    char count[32];
    snprintf(count, sizeof count, "CHANNEL_COUNT %d", channels);
    const char *const defines[] = {count, "SPHERE", "INTEGRAL"};
    trl_result result = TRL_OK;
    for (size_t i = 0; i < 2 && result == TRL_OK; i++) {
        struct gpu_program_desc desc = {.vertex = "sky/single/sphere.vert",
                                        .fragment = "sky/single/sky.frag",
                                        .defines = defines,
                                        .define_count = 2 + i};
        result = gpu_program_init(spheres->gpu, &desc, &spheres->air[i]);
        if (result == TRL_OK) {
            desc.fragment = "sky/single/ground.frag";
            result = gpu_program_init(spheres->gpu, &desc, &spheres->ground[i]);
        }
    }
    return result;
}

trl_result single_spheres_prepare(struct single_spheres *spheres, struct gpu *gpu,
                                  const struct sky_spheres *wanted, int channels)
{
    if (spheres->side == wanted->side) {
        return TRL_OK;
    }
    trl_result result = TRL_OK;
    if (!spheres->gpu) {
        spheres->gpu = gpu;
        result = make_programs(spheres, channels);
    }
    gpu_mesh_finish(&spheres->mesh);
    if (result == TRL_OK) {
        result = make_mesh(spheres, wanted->side);
    }
    if (result != TRL_OK) {
        single_spheres_finish(spheres);
    }
    return result;
}

void single_spheres_finish(struct single_spheres *spheres)
{
    gpu_mesh_finish(&spheres->mesh);
    for (int i = 0; i < 2; i++) {
        gpu_program_finish(&spheres->air[i]);
        gpu_program_finish(&spheres->ground[i]);
    }
    *spheres = (struct single_spheres){0};
}

trl_result single_spheres_draw(struct single_spheres *spheres, const struct sky_pixels *pixels,
                               struct gpu_program *program, const struct sky_view *view)
{
    const bool is_air = program == &spheres->air[0] || program == &spheres->air[1];
    const struct gpu_pass pass = {.target = view->target,
                                  .state.cull = is_air ? GPU_CULL_FRONT : GPU_CULL_BACK,
                                  .clears_color = is_air,
                                  .color = {0, 0, 0, 1}};
    sky_pixels_set_view(pixels, program, view);
    sky_set_vec3(program, "u_eye_m", view->camera->position_m);
    gpu_program_set_float(program, "u_sphere_m",
                          (float)(is_air ? pixels->top_radius_m : pixels->ground_radius_m));
    gpu_program_set_int(program, "u_steps", (int32_t)view->spheres.steps);
    gpu_pass_begin(spheres->gpu, &pass);
    return gpu_draw_mesh(program, &spheres->mesh, 1, "sky");
}
