// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_RAYS_H
#define CLOUD_RAYS_H
// Clouds along rays, and what tells which of these may stand for one another: drawn together.
//
//     clouds  RGBA32F  light, linear sRGB in cd m^-2; 1 - transmittance
//     ends    RG32F    logarithms of m: how far what is seen is, 0 for rays that are not marched;
//                      and ray_end of cloud/parts.glsl

#include "gpu/target.h"

struct cloud_rays {
    struct gpu_texture clouds, ends;
    struct gpu_target target;
};

// TRL_ERROR_GPU, TRL_ERROR_MEMORY; then there is nothing to finish.
TRL_MUST_USE trl_result cloud_rays_init(struct gpu *gpu, const char *label, uint32_t width,
                                        uint32_t height, struct cloud_rays *out);
void cloud_rays_finish(struct cloud_rays *rays);

#endif // CLOUD_RAYS_H
