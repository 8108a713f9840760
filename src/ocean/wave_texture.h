// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_WAVE_TEXTURE_H
#define OCEAN_WAVE_TEXTURE_H
// Waves on the GPU: a texture of 28 bytes a wave, and what shaders/ocean/waves.glsl needs.

#include "gpu/program.h"
#include "ocean/waves.h"
#include "terrain/surface.h"

// Owner: caller. Must not outlive the waves.
struct wave_texture {
    struct gpu *gpu;
    const struct waves *waves;
    const struct surface *shores; // they end the fetch of an eye's waves; NULL: nothing does
    struct waves_view *view;      // owned; as uploaded last
    struct gpu_texture texture;
    struct vec3 place;
    double time_s, fetch_m;
    bool is_made;
};

// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result wave_texture_init(struct gpu *gpu, const struct waves *waves,
                                          struct wave_texture *out);
void wave_texture_finish(struct wave_texture *texture);

// For an eye and a time; nothing where both are those of before. TRL_ERROR_GPU.
TRL_MUST_USE trl_result wave_texture_update(struct wave_texture *texture, struct vec3 eye_m,
                                            double time_s);

// Significant height of those waves, m; after an update.
double wave_texture_height_m(const struct wave_texture *texture);

// After an update.
void wave_texture_bind(const struct wave_texture *texture, struct gpu_program *program);

#endif // OCEAN_WAVE_TEXTURE_H
