// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/facets.h"

#include "ocean/sea.h"

#include <math.h>

trl_result facets_init(struct gpu *gpu, const struct waves *waves, struct facets *out)
{
    *out = (struct facets){.gpu = gpu};
    const struct gpu_program_desc desc = {.vertex = "lib/layer.vert",
                                          .fragment = "ocean/facets.frag"};
    trl_result result = wave_texture_init(gpu, waves, &out->waves);
    if (result == TRL_OK) {
        result = gpu_program_init(gpu, &desc, &out->program);
    }
    if (result != TRL_OK) {
        facets_finish(out);
    }
    return result;
}

static void finish_target(struct facets *facets)
{
    gpu_target_finish(&facets->target);
    gpu_texture_finish(&facets->texture);
}

void facets_finish(struct facets *facets)
{
    finish_target(facets);
    gpu_program_finish(&facets->program);
    wave_texture_finish(&facets->waves);
    *facets = (struct facets){0};
}

trl_result facets_resize(struct facets *facets, const struct gpu_texture *depth)
{
    finish_target(facets);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "facets";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = depth->width;
    desc.height = depth->height;
    return gpu_target_init_texture(facets->gpu, &desc, depth, &facets->texture, &facets->target);
}

// Where waves are lower, they break in as much less water.
static void set_foam(const struct wave_texture *waves, struct gpu_program *program)
{
    const struct sea_surf *surf = &waves->waves->surf;
    float ramps[SEA_SURF_STEPS + 1][4] = {{0}};
    for (int i = 0; i <= SEA_SURF_STEPS; i++) {
        ramps[i][0] = (float)surf->ramps[i].first;
        ramps[i][1] = (float)surf->ramps[i].width;
    }
    gpu_program_set_vec4s(program, "u_foam", ramps[0], SEA_SURF_STEPS + 1);
    gpu_program_set_float(program, "u_broken", (float)(waves->view->height_part * surf->broken_m));
}

trl_result facets_draw(struct facets *facets, const struct facets_inputs *in)
{
    struct gpu_program *program = &facets->program;
    const double pixel_rad = 2 * in->camera->tan_half_fov_y / facets->texture.height;
    trl_result result = wave_texture_update(&facets->waves, in->camera->position_m, in->time_s);
    if (result != TRL_OK) {
        return result;
    }
    wave_texture_bind(&facets->waves, program);
    gpu_program_set_texture(program, "u_position", in->position);
    gpu_program_set_texture(program, "u_level", in->level ? in->level : in->position);
    gpu_program_set_float(program, "u_has_level", in->level ? 1 : 0);
    gpu_program_set_texture(program, "u_albedo", in->albedo);
    gpu_program_set_texture(program, "u_lights", in->lights);
    gpu_program_set_float(program, "u_pixel_rad", (float)pixel_rad);
    set_foam(&facets->waves, program);
    gpu_program_set_float(program, "u_depth", in->water_depth);
    const struct gpu_pass pass = {
        .target = &facets->target, .state = {.depth = GPU_DEPTH_FARTHER}, .clears_color = true};
    gpu_pass_begin(facets->gpu, &pass);
    return gpu_draw_fullscreen(program, "facets of the sea");
}
