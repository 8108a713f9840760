// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "sky/sprites.h"

#include <math.h>

// Half widths in pixels of what is drawn: of the kernel, and of the same kernel HALO_WIDTH times
// as wide.
static const double CORE_HALF_PX = 1.5;
enum { HALO_WIDTH = 4 };

// Lens and eye scatter a part of the light around a point: it is what makes bright stars look
// large. Below this illuminance nobody could see it, and it stays in the core.
static const double HALO_SHARE = 0.2;
static const double HALO_FROM_LX = 2.54e-6 * 0.025; // magnitude 4

static trl_result make_mesh(struct sprites *sprites)
{
    static const float corners[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const struct gpu_mesh_desc desc = {
        .label = "points of light",
        .primitive = GPU_PRIMITIVE_TRIANGLE_STRIP,
        .vertex_count = 4,
        .vertex_stride = sizeof corners[0],
        .vertices = corners,
        .instance_stride = sizeof(struct sprite),
        .attribute_count = 3,
        .attributes = {
            {.location = 0, .components = 2, .type = GPU_COMPONENT_FLOAT},
            {.location = 1,
             .components = 2,
             .type = GPU_COMPONENT_FLOAT,
             .offset = offsetof(struct sprite, centre_px),
             .is_per_instance = true},
            {.location = 2,
             .components = 4,
             .type = GPU_COMPONENT_FLOAT,
             .offset = offsetof(struct sprite, light),
             .is_per_instance = true},
        }};
    return gpu_mesh_init(sprites->gpu, &desc, &sprites->mesh);
}

trl_result sprites_init(struct gpu *gpu, size_t capacity, struct sprites *out)
{
    *out = (struct sprites){.ctx = gpu->ctx,
                            .gpu = gpu,
                            .capacity = capacity,
                            .sprites = mem_alloc(gpu->ctx, capacity, sizeof *out->sprites)};
    const struct gpu_program_desc program = {.vertex = "sky/star.vert",
                                             .fragment = "sky/star.frag"};
    trl_result result = out->sprites ? TRL_OK : TRL_ERROR_MEMORY;
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &program, &out->program);
    }
    if (result == TRL_OK) {
        result = make_mesh(out);
    }
    if (result != TRL_OK) {
        sprites_finish(out);
    }
    return result;
}

void sprites_finish(struct sprites *sprites)
{
    if (sprites->ctx) {
        gpu_mesh_finish(&sprites->mesh);
        gpu_program_finish(&sprites->program);
        mem_free(sprites->ctx, sprites->sprites);
    }
    *sprites = (struct sprites){0};
}

struct sprite_frame sprite_frame_make(const struct camera *camera, const struct gpu_target *target)
{
    const double reach_px = CORE_HALF_PX * HALO_WIDTH;
    return (struct sprite_frame){.right = camera->right,
                                 .up = camera->up,
                                 .forward = camera->forward,
                                 .tan_half_x = camera->tan_half_fov_x,
                                 .tan_half_y = camera->tan_half_fov_y,
                                 .margin_x = 1 + 2 * reach_px / target->width,
                                 .margin_y = 1 + 2 * reach_px / target->height,
                                 .width_px = target->width,
                                 .height_px = target->height};
}

bool sprite_find(const struct sprite_frame *frame, struct vec3 direction, struct sprite_place *out)
{
    const double along = vec3_dot(direction, frame->forward);
    const double x = vec3_dot(direction, frame->right);
    const double y = vec3_dot(direction, frame->up);
    if (along <= 1e-6 || fabs(x) > along * frame->tan_half_x * frame->margin_x ||
        fabs(y) > along * frame->tan_half_y * frame->margin_y) {
        return false;
    }
    *out = (struct sprite_place){
        along,
        {(float)(0.5 * frame->width_px * (1 + x / (along * frame->tan_half_x))),
         (float)(0.5 * frame->height_px * (1 + y / (along * frame->tan_half_y)))}};
    return true;
}

// Share of the light that goes into the halo, rising with the logarithm of the light.
static float find_halo(double illuminance_lx)
{
    const double magnitudes = 2.5 * log10(fmax(illuminance_lx / HALO_FROM_LX, 1));
    return (float)(HALO_SHARE * fmin(magnitudes / 4, 1));
}

void sprites_add(struct sprites *sprites, const struct sprite_frame *frame,
                 const struct sprite_place *place, struct cie_rgb light_lx)
{
    // A pixel's part of the image plane, seen from the eye at the angle whose cosine is `along`.
    const double along = place->along;
    const double pixel_sr = 4 * frame->tan_half_x * frame->tan_half_y /
                            (frame->width_px * frame->height_px) * along * along * along;
    sprites->sprites[sprites->count++] =
        (struct sprite){.centre_px = {place->centre_px[0], place->centre_px[1]},
                        .light = {(float)(light_lx.r / pixel_sr), (float)(light_lx.g / pixel_sr),
                                  (float)(light_lx.b / pixel_sr)},
                        .halo = find_halo(cie_luminance(light_lx))};
}

trl_result sprites_draw(struct sprites *sprites, const struct gpu_target *target)
{
    const uint32_t count = (uint32_t)sprites->count;
    sprites->count = 0;
    if (count == 0) {
        return TRL_OK;
    }
    const struct gpu_pass pass = {.target = target,
                                  .state = {.depth = GPU_DEPTH_NEARER, .blend = GPU_BLEND_ADD}};
    const trl_result result = gpu_mesh_update_instances(&sprites->mesh, sprites->sprites, count);
    if (result != TRL_OK) {
        return result;
    }
    const float size[2] = {(float)target->width, (float)target->height};
    gpu_program_set_vec2(&sprites->program, "u_size", size);
    gpu_pass_begin(sprites->gpu, &pass);
    return gpu_draw_mesh(&sprites->program, &sprites->mesh, count, "stars");
}
