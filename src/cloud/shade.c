// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/shade.h"

#include <math.h>

static const double SKY_M = 1e9; // farther than any ground

void cloud_shade_init(struct gpu *gpu, struct cloud_shade *out)
{
    *out = (struct cloud_shade){.gpu = gpu};
}

static void finish_target(struct cloud_shade *shade)
{
    gpu_target_finish(&shade->target);
    gpu_texture_finish(&shade->left);
    gpu_texture_finish(&shade->depth);
}

static void finish_programs(struct cloud_shade *shade)
{
    gpu_program_finish(&shade->sort);
    gpu_program_finish(&shade->shade);
}

void cloud_shade_finish(struct cloud_shade *shade)
{
    finish_target(shade);
    finish_programs(shade);
    *shade = (struct cloud_shade){.gpu = shade->gpu};
}

trl_result cloud_shade_make_programs(struct cloud_shade *shade, bool is_bare)
{
    static const char *const defines[] = {"SORT", "SURFACE"};
    struct gpu_program_desc desc = {.vertex = "lib/fullscreen.vert",
                                    .fragment = "cloud/shade.frag",
                                    .defines = defines,
                                    .define_count = is_bare ? 1 : 2};
    finish_programs(shade);
    const trl_result result = gpu_program_init(shade->gpu, &desc, &shade->sort);
    desc.defines++;
    desc.define_count--;
    return result == TRL_OK ? gpu_program_init(shade->gpu, &desc, &shade->shade) : result;
}

trl_result cloud_shade_resize(struct cloud_shade *shade, uint32_t width, uint32_t height)
{
    finish_target(shade);
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = "shade of clouds";
    desc.filter = GPU_FILTER_NEAREST;
    desc.format = GPU_FORMAT_DEPTH32F;
    desc.width = (width + 1) / 2;
    desc.height = (height + 1) / 2;
    trl_result result = gpu_texture_init(shade->gpu, &desc, &shade->depth);
    desc.format = GPU_FORMAT_RGBA32F;
    return result == TRL_OK ? gpu_target_init_texture(shade->gpu, &desc, &shade->depth,
                                                      &shade->left, &shade->target)
                            : result;
}

trl_result cloud_shade_draw(struct cloud_shade *shade)
{
    const struct gpu_pass sort = {
        .target = &shade->target,
        .state = {.writes_depth = true, .hides_color = true},
    };
    gpu_pass_begin(shade->gpu, &sort);
    const trl_result result = gpu_draw_fullscreen(&shade->sort, "shade of clouds");
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_pass pass = {.target = &shade->target,
                                  .state = {.depth = GPU_DEPTH_FARTHER},
                                  .clears_color = true,
                                  .color = {1, (float)log(SKY_M), 0, 1}};
    gpu_pass_begin(shade->gpu, &pass);
    return gpu_draw_fullscreen(&shade->shade, "shade of clouds");
}
