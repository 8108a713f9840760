// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_TONE_H
#define FRAME_TONE_H
// From scene-referred radiance to 8-bit sRGB, and from there to a window. The curves are
// shaders/shared/tone.glsl, the passes shaders/frame/tone.frag and present.frag.

#include "gpu/program.h"
#include "gpu/target.h"
#include <terrella/scene.h>

struct tone {
    struct gpu *gpu;
    struct gpu_program filmic, exponential, present;
};

TRL_MUST_USE trl_result tone_init(struct gpu *gpu, struct tone *out);
void tone_finish(struct tone *tone);

// What is mapped: radiance (RGBA32F, linear sRGB cd m^-2) and exposure (RG32F, 1 x 1).
struct tone_source {
    const struct gpu_texture *radiance, *exposure;
    trl_tone_curve curve;
};

// Draws into an RGBA8 target of the radiance's size.
TRL_MUST_USE trl_result tone_draw(struct tone *tone, const struct tone_source *source,
                                  const struct gpu_target *target);

// Copies a picture (RGBA8) into a rectangle of the window's framebuffer.
TRL_MUST_USE trl_result tone_present(struct tone *tone, const struct gpu_texture *picture,
                                     struct gpu_rect rect);

#endif // FRAME_TONE_H
