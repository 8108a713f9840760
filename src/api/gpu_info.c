// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#include "api/check.h"
#include "gpu/gpu.h"
#include <terrella/renderer.h>

#include <string.h>

trl_result trl_gpu_info_read(trl_context *ctx, trl_gpu_info *out)
{
    if (!ctx) {
        return TRL_ERROR_INVALID;
    }
    TRL_REQUIRE(ctx, out != NULL);
    *out = (trl_gpu_info){0};
    struct gpu *gpu = NULL;
    const trl_result result = gpu_create_headless(ctx, &gpu);
    if (result != TRL_OK) {
        return result;
    }
    const struct gpu_caps *caps = &gpu->caps;
    *out = (trl_gpu_info){
        .is_es = caps->is_es,
        .is_software = caps->is_software,
        .has_clip_control = caps->has_clip_control,
        .has_timer_query = caps->has_timer_query,
        .has_tessellation = caps->has_tessellation,
        .has_float_linear = caps->has_float_linear,
        .has_debug = caps->has_debug,
        .max_anisotropy = caps->max_anisotropy,
        .max_texture_size = caps->max_texture_size,
        .max_3d_size = caps->max_3d_size,
        .max_array_layers = caps->max_array_layers,
    };
    memcpy(out->vendor, caps->vendor, sizeof out->vendor);
    memcpy(out->renderer, caps->renderer, sizeof out->renderer);
    memcpy(out->version, caps->version_text, sizeof out->version);
    gpu_destroy(&gpu);
    return TRL_OK;
}
