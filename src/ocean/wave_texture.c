// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/wave_texture.h"

#include <math.h>

trl_result wave_texture_init(struct gpu *gpu, const struct waves *waves, struct wave_texture *out)
{
    *out = (struct wave_texture){.gpu = gpu, .waves = waves};
    out->view = mem_alloc(gpu->ctx, 1, sizeof *out->view);
    return out->view ? TRL_OK : TRL_ERROR_MEMORY;
}

void wave_texture_finish(struct wave_texture *texture)
{
    if (texture->gpu) {
        gpu_texture_finish(&texture->texture);
        mem_free(texture->gpu->ctx, texture->view);
    }
    *texture = (struct wave_texture){0};
}

// As many rows as there are groups: an eye at a border of cells needs more of them.
static trl_result fit_texture(struct wave_texture *t)
{
    const uint32_t rows = t->view->groups > 0 ? t->view->groups : 1;
    if (t->texture.height == rows) {
        return TRL_OK;
    }
    gpu_texture_finish(&t->texture);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "waves";
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = WAVES_FIELDS;
    desc.height = rows;
    return gpu_texture_init(t->gpu, &desc, &t->texture);
}

trl_result wave_texture_update(struct wave_texture *t, struct vec3 eye_m, double time_s)
{
    if (t->is_made && t->time_s == time_s && t->place.x == eye_m.x && t->place.y == eye_m.y &&
        t->place.z == eye_m.z) {
        return TRL_OK;
    }
    t->place = eye_m;
    t->time_s = time_s;
    t->is_made = false;
    waves_view_make(t->waves, eye_m, time_s, t->view);
    trl_result result = fit_texture(t);
    if (result == TRL_OK && t->view->groups > 0) {
        const struct gpu_region all = gpu_texture_region(&t->texture, 0);
        result = gpu_texture_upload(&t->texture, &all, t->view->texels);
    }
    t->is_made = result == TRL_OK;
    return result;
}

void wave_texture_bind(const struct wave_texture *t, struct gpu_program *program)
{
    const float range[4] = {(float)t->waves->radius_m, (float)vec3_length(t->place),
                            (float)t->waves->rest_square, 0};
    float local_from_planet[9];
    waves_local_from_planet(t->place, local_from_planet);
    gpu_program_set_texture(program, "u_waves", &t->texture);
    gpu_program_set_int(program, "u_wave_groups", (int32_t)t->view->groups);
    gpu_program_set_vec4(program, "u_wave_range", range);
    gpu_program_set_mat3(program, "u_wave_local_from_planet", local_from_planet);
}
