// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_DECK_H
#define CLOUD_DECK_H
// A map, around the eye and in the star's space, of what clouds leave of light: for ground, sea and
// air, which look it up by shaders/sky/deck.glsl. docs/physics.md, section 29.
//
//     out  deck  RGBA32F  see there

#include "base/camera.h"
#include "cloud/field.h"
#include "gpu/pass.h"

struct cloud_deck {
    struct gpu *gpu;
    struct gpu_program program;
    struct gpu_texture map;
    struct gpu_target target;
    float place[4]; // u_deck_map
};

// Nothing is made before the first picture.
void cloud_deck_init(struct gpu *gpu, struct cloud_deck *out);
void cloud_deck_finish(struct cloud_deck *deck);

// Makes program and map where there are none, and finds where the map lies. TRL_ERROR_GPU,
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result cloud_deck_begin(struct cloud_deck *deck, const struct cloud_field *field,
                                         const struct camera *camera);
// Draws, with the uniforms of sky/ray.glsl and cloud/weather.glsl set in deck->program.
TRL_MUST_USE trl_result cloud_deck_draw(struct cloud_deck *deck);

#endif // CLOUD_DECK_H
