// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "terrain/kinds.h"

trl_result terrain_kinds_init(struct gpu *gpu, struct terrain_kinds *out)
{
    *out = (struct terrain_kinds){.gpu = gpu};
    static const char *const water[] = {"WATER"};
    struct gpu_program_desc desc = {
        .vertex = "lib/fullscreen.vert", .fragment = "terrain/kinds.frag", .defines = water};
    trl_result result = gpu_program_init(gpu, &desc, &out->ground);
    desc.define_count = 1;
    result = result == TRL_OK ? gpu_program_init(gpu, &desc, &out->water) : result;
    result = result == TRL_OK ? gpu_condition_init(gpu, &out->has_water) : result;
    if (result != TRL_OK) {
        terrain_kinds_finish(out);
    }
    return result;
}

void terrain_kinds_finish(struct terrain_kinds *kinds)
{
    gpu_condition_finish(&kinds->has_water);
    gpu_program_finish(&kinds->water);
    gpu_program_finish(&kinds->ground);
    *kinds = (struct terrain_kinds){0};
}

static trl_result draw(struct terrain_kinds *kinds, struct gpu_program *program,
                       const struct gpu_target *target)
{
    const struct gpu_pass pass = {.target = target, .state = {.writes_depth = true}};
    gpu_pass_begin(kinds->gpu, &pass);
    return gpu_draw_fullscreen(program, "kinds of pixels");
}

trl_result terrain_kinds_draw(struct terrain_kinds *kinds, const struct gpu_texture *position,
                              const struct gpu_target *target)
{
    gpu_program_set_texture(&kinds->ground, "u_position", position);
    return draw(kinds, &kinds->ground, target);
}

trl_result terrain_kinds_add_water(struct terrain_kinds *kinds, const struct gpu_texture *albedo,
                                   const struct gpu_target *target)
{
    gpu_program_set_texture(&kinds->water, "u_albedo", albedo);
    gpu_condition_count(&kinds->has_water);
    const trl_result result = draw(kinds, &kinds->water, target);
    gpu_condition_counted(&kinds->has_water);
    return result;
}
