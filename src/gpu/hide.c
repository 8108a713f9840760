// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "gpu/hide.h"

trl_result gpu_hide_init(struct gpu *gpu, struct gpu_hide *out)
{
    *out = (struct gpu_hide){.gpu = gpu};
    const struct gpu_program_desc desc = {.vertex = "lib/layer.vert", .fragment = "lib/hide.frag"};
    return gpu_program_init(gpu, &desc, &out->program);
}

void gpu_hide_finish(struct gpu_hide *hide)
{
    gpu_program_finish(&hide->program);
    *hide = (struct gpu_hide){0};
}

trl_result gpu_hide_draw(struct gpu_hide *hide, const struct gpu_texture *hidden, float depth,
                         const struct gpu_target *target)
{
    if (!hidden) {
        return TRL_OK;
    }
    const struct gpu_pass pass = {.target = target,
                                  .state = {.writes_depth = true, .hides_color = true}};
    gpu_program_set_texture(&hide->program, "u_hidden", hidden);
    gpu_program_set_float(&hide->program, "u_depth", depth);
    gpu_pass_begin(hide->gpu, &pass);
    return gpu_draw_fullscreen(&hide->program, "hidden pixels");
}
