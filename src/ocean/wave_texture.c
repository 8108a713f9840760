// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/wave_texture.h"

#include "shared/sea.glsl"

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

// Groups of which a window with sides of at least that leaves something. The others only add to the
// roughness, which they do here: loops of shaders cost the same whatever is in them.
static uint32_t count_shown(const struct wave_texture *t, double least_m, double *rest_square)
{
    uint32_t shown = t->view->groups;
    *rest_square = t->waves->rest_square;
    while (shown > 0) {
        const uint32_t first = (shown - 1) * WAVES_LANES;
        const GerstnerWave longest = waves_view_get(t->view, first);
        if (gerstner_weight(longest.wavenumber * least_m, 0) > GERSTNER_LEAST_WEIGHT) {
            break;
        }
        for (uint32_t i = first; i < first + WAVES_LANES; i++) {
            const GerstnerWave w = waves_view_get(t->view, i);
            const double steep = w.amplitude * w.wavenumber;
            *rest_square += 0.5 * steep * steep;
        }
        shown--;
    }
    return shown;
}

double wave_texture_unseen_press(const struct wave_texture *t, double least_m)
{
    double rest_square = 0, sum = 0;
    const uint32_t shown = count_shown(t, least_m, &rest_square);
    for (uint32_t i = shown * WAVES_LANES; i < t->view->count; i++) {
        const GerstnerWave w = waves_view_get(t->view, i);
        const double press =
            w.amplitude * w.wavenumber * sea_breaking(w.wavenumber, t->waves->breaking_per_m);
        sum += 0.5 * press * press;
    }
    return sum;
}

void wave_texture_bind(const struct wave_texture *t, double least_m, struct gpu_program *program)
{
    double rest_square = 0;
    const uint32_t shown = count_shown(t, least_m, &rest_square);
    const float range[4] = {(float)t->waves->radius_m, (float)vec3_length(t->place),
                            (float)rest_square, (float)fmax(t->waves->breaking_per_m, 1e-9)};
    float local_from_planet[9];
    waves_local_from_planet(t->place, local_from_planet);
    gpu_program_set_texture(program, "u_waves", &t->texture);
    gpu_program_set_int(program, "u_wave_groups", (int32_t)shown);
    gpu_program_set_vec4(program, "u_wave_range", range);
    gpu_program_set_mat3(program, "u_wave_local_from_planet", local_from_planet);
}
