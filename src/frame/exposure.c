// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "frame/exposure.h"

#include "gpu/pass.h"
#include "shared/meter.glsl"

// The eye needs a second for 95 % of the way; an exponential, so that it does not depend on the
// frame rate.
static const double ADAPTATION_TIME_S = 0.35;

static trl_result make_targets(struct exposure *exposure)
{
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.format = GPU_FORMAT_RG32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.label = "exposure";
    for (int i = 0; i < 2; i++) {
        const trl_result result = gpu_target_init_texture(
            exposure->gpu, &desc, NULL, &exposure->values[i], &exposure->value_targets[i]);
        if (result != TRL_OK) {
            return result;
        }
    }
    desc.width = METER_CELLS_X;
    desc.height = METER_CELLS_Y;
    desc.label = "meter cells";
    return gpu_target_init_texture(exposure->gpu, &desc, NULL, &exposure->cells,
                                   &exposure->cells_target);
}

static trl_result make_programs(struct exposure *exposure)
{
    struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                    .fragment = "frame/meter.frag"};
    trl_result result = gpu_program_init(exposure->gpu, &desc, &exposure->meter);
    if (result == TRL_OK) {
        desc.fragment = "frame/adapt.frag";
        result = gpu_program_init(exposure->gpu, &desc, &exposure->adapt);
    }
    return result;
}

trl_result exposure_init(struct gpu *gpu, double wall_cd_m2, struct exposure *out)
{
    *out = (struct exposure){.gpu = gpu, .wall_cd_m2 = (float)wall_cd_m2};
    trl_result result = make_targets(out);
    if (result == TRL_OK) {
        result = make_programs(out);
    }
    if (result != TRL_OK) {
        exposure_finish(out);
    }
    return result;
}

void exposure_finish(struct exposure *exposure)
{
    gpu_program_finish(&exposure->meter);
    gpu_program_finish(&exposure->adapt);
    gpu_target_finish(&exposure->cells_target);
    gpu_texture_finish(&exposure->cells);
    for (int i = 0; i < 2; i++) {
        gpu_target_finish(&exposure->value_targets[i]);
        gpu_texture_finish(&exposure->values[i]);
    }
    *exposure = (struct exposure){0};
}

static trl_result set_fixed(struct exposure *exposure, const struct exposure_request *request)
{
    const float value[2] = {(float)request->ev100, (float)(exp2(request->bias_ev - request->ev100) /
                                                           TONE_SATURATION_PER_EV0)};
    struct gpu_texture *texture = &exposure->values[exposure->now];
    const struct gpu_region all = gpu_texture_region(texture, 0);
    return gpu_texture_upload(texture, &all, value);
}

static trl_result draw_cells(struct exposure *exposure, const struct gpu_texture *radiance)
{
    const struct gpu_pass pass = {.target = &exposure->cells_target};
    const float cells[2] = {METER_CELLS_X, METER_CELLS_Y};
    gpu_pass_begin(exposure->gpu, &pass);
    gpu_program_set_texture(&exposure->meter, "u_radiance", radiance);
    gpu_program_set_vec2(&exposure->meter, "u_cells", cells);
    gpu_program_set_float(&exposure->meter, "u_wall_cd_m2", exposure->wall_cd_m2);
    return gpu_draw_fullscreen(&exposure->meter, "meter");
}

// Draws into the other of the two values, which then becomes the present one.
static trl_result draw_value(struct exposure *exposure, const struct exposure_request *request)
{
    const uint32_t before = exposure->now;
    exposure->now = 1 - before;
    const bool is_at_once = !exposure->has_value || request->elapsed_s <= 0;
    const double follow = is_at_once ? 1 : 1 - exp(-request->elapsed_s / ADAPTATION_TIME_S);
    const struct gpu_pass pass = {.target = &exposure->value_targets[exposure->now]};
    gpu_pass_begin(exposure->gpu, &pass);
    gpu_program_set_texture(&exposure->adapt, "u_cells", &exposure->cells);
    gpu_program_set_texture(&exposure->adapt, "u_before", &exposure->values[before]);
    gpu_program_set_float(&exposure->adapt, "u_follow", (float)follow);
    gpu_program_set_float(&exposure->adapt, "u_bias_ev", (float)request->bias_ev);
    return gpu_draw_fullscreen(&exposure->adapt, "adapt");
}

trl_result exposure_update(struct exposure *exposure, const struct exposure_request *request,
                           const struct gpu_texture *radiance)
{
    trl_result result = TRL_OK;
    if (request->is_fixed) {
        result = set_fixed(exposure, request);
    } else {
        result = draw_cells(exposure, radiance);
        if (result == TRL_OK) {
            result = draw_value(exposure, request);
        }
    }
    exposure->has_value = exposure->has_value || result == TRL_OK;
    return result;
}

const struct gpu_texture *exposure_value(const struct exposure *exposure)
{
    return &exposure->values[exposure->now];
}

trl_result exposure_read(const struct exposure *exposure, double *ev100)
{
    const struct gpu_texture *texture = exposure_value(exposure);
    const struct gpu_region all = gpu_texture_region(texture, 0);
    float value[2] = {0, 0};
    const trl_result result = gpu_texture_read(texture, &all, value);
    *ev100 = (double)value[0];
    return result;
}
