// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_SHADE_H
#define CLOUD_SHADE_H
// What clouds leave of the star's light on the ground, of every second pixel each way.
//
//     in   position  RGBA32F   of the ground (frame/ground.h), or none for a bare sphere
//          hidden    R8        of squares of pixels (gpu/hide.h)
//     out  left      RGBA32F   see cloud/shade.frag; 1 in the sky
//          depth     DEPTH32F  scratch: ground is nearer

#include "gpu/pass.h"

struct cloud_shade {
    struct gpu *gpu;
    struct gpu_program sort, shade;
    struct gpu_texture left, depth;
    struct gpu_target target;
};

// Nothing is made before it is asked for.
void cloud_shade_init(struct gpu *gpu, struct cloud_shade *out);
void cloud_shade_finish(struct cloud_shade *shade);

// For other ground than before. TRL_ERROR_GPU, TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result cloud_shade_make_programs(struct cloud_shade *shade, bool is_bare);
// For a picture of that size. After a failure it must be called again.
TRL_MUST_USE trl_result cloud_shade_resize(struct cloud_shade *shade, uint32_t width,
                                           uint32_t height);

// Draws, with the uniforms of sky/ray.glsl, and in `shade` those of cloud/weather.glsl, set in both
// programs, as u_picture, u_position and u_hidden are.
TRL_MUST_USE trl_result cloud_shade_draw(struct cloud_shade *shade);

#endif // CLOUD_SHADE_H
