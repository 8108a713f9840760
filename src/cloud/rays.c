// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "cloud/rays.h"

trl_result cloud_rays_init(struct gpu *gpu, const char *label, uint32_t width, uint32_t height,
                           struct cloud_rays *out)
{
    *out = (struct cloud_rays){0};
    struct gpu_texture_desc desc = gpu_texture_desc_default();
    desc.label = label;
    desc.format = GPU_FORMAT_RGBA32F;
    desc.filter = GPU_FILTER_NEAREST;
    desc.width = width;
    desc.height = height;
    trl_result result = gpu_texture_init(gpu, &desc, &out->clouds);
    if (result == TRL_OK) {
        desc.format = GPU_FORMAT_RG32F;
        result = gpu_texture_init(gpu, &desc, &out->ends);
    }
    const struct gpu_target_desc target = {
        .label = label,
        .color_count = 2,
        .colors = {{.texture = &out->clouds}, {.texture = &out->ends}}};
    if (result == TRL_OK) {
        result = gpu_target_init(gpu, &target, &out->target);
    }
    if (result != TRL_OK) {
        cloud_rays_finish(out);
    }
    return result;
}

void cloud_rays_finish(struct cloud_rays *rays)
{
    gpu_target_finish(&rays->target);
    gpu_texture_finish(&rays->ends);
    gpu_texture_finish(&rays->clouds);
}
