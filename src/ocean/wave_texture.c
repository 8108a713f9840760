// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "ocean/wave_texture.h"

#include "ocean/fetch.h"
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
    const bool is_there =
        t->is_made && t->place.x == eye_m.x && t->place.y == eye_m.y && t->place.z == eye_m.z;
    if (is_there && t->time_s == time_s) {
        return TRL_OK;
    }
    if (!is_there) {
        t->fetch_m = t->shores ? fetch_find_m(t->shores, &t->waves->wind, eye_m) : HUGE_VAL;
    }
    t->place = eye_m;
    t->time_s = time_s;
    t->is_made = false;
    waves_view_make_within(t->waves, &(struct waves_eye){eye_m, time_s, t->fetch_m}, t->view);
    trl_result result = fit_texture(t);
    if (result == TRL_OK && t->view->groups > 0) {
        const struct gpu_region all = gpu_texture_region(&t->texture, 0);
        result = gpu_texture_upload(&t->texture, &all, t->view->texels);
    }
    t->is_made = result == TRL_OK;
    return result;
}

double wave_texture_height_m(const struct wave_texture *t)
{
    return t->view->height_part * waves_significant_height_m(t->waves);
}

static double breaking_of(const struct wave_texture *t)
{
    return fmax(t->waves->breaking_per_m, 1e-9);
}

// Of all waves in deep water, from which shaders find what they have not looked at: they end where
// no wave is left, and a sum of the rest would be a loop over it. As u_wave_all.
static void sum_all(const struct wave_texture *t, float all[3])
{
    double square = 0, press_square = 0, shortest = 0;
    for (uint32_t i = 0; i < t->view->count; i++) {
        const GerstnerWave w = waves_view_get(t->view, i);
        const double steep = w.amplitude * w.wavenumber;
        const double press = steep * sea_breaking(w.wavenumber, breaking_of(t));
        square += 0.5 * steep * steep;
        press_square += 0.5 * press * press;
        shortest = w.wavenumber;
    }
    all[0] = (float)square;
    all[1] = (float)press_square;
    all[2] = (float)shortest;
}

void wave_texture_bind(const struct wave_texture *t, struct gpu_program *program)
{
    const float range[4] = {(float)t->waves->radius_m, (float)vec3_length(t->place),
                            (float)t->waves->rest_square, (float)breaking_of(t)};
    float local_from_planet[9], all[3];
    waves_local_from_planet(t->place, local_from_planet);
    sum_all(t, all);
    gpu_program_set_texture(program, "u_waves", &t->texture);
    gpu_program_set_int(program, "u_wave_groups", (int32_t)t->view->groups);
    gpu_program_set_vec4(program, "u_wave_range", range);
    gpu_program_set_vec3(program, "u_wave_all", all);
    gpu_program_set_mat3(program, "u_wave_local_from_planet", local_from_planet);
}
