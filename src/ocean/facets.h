// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef OCEAN_FACETS_H
#define OCEAN_FACETS_H
// The waves that a picture resolves, as normals, and the rest as roughness, for every pixel of open
// water: amplitudes under a Gaussian window over the pixel, so that waves go over from one to the
// other smoothly and the mean square slope of both together stays that of the sea.

#include "base/camera.h"
#include "gpu/pass.h"
#include "ocean/wave_texture.h"

struct facets {
    struct gpu *gpu;
    struct wave_texture waves;
    struct gpu_program program;
    struct gpu_texture texture; // RGBA32F: normal, planet axes, as long as 1 + part under
                                // foam; mean square slope left; 0 where there is no water
    struct gpu_target target;
};

// `waves` must outlive it. TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result facets_init(struct gpu *gpu, const struct waves *waves, struct facets *out);
void facets_finish(struct facets *facets);
TRL_MUST_USE trl_result facets_resize(struct facets *facets, const struct gpu_texture *depth);

struct facets_inputs {
    const struct camera *camera;
    double time_s;
    const struct gpu_texture *position; // of frame/ground.h
    const struct gpu_texture *level;    // of the sea's mesh; NULL: all water is level
    const struct gpu_texture *albedo, *lights;
    float water_depth;
};
// Draws where `depth` is nearer than `water_depth`, the rest is 0.
TRL_MUST_USE trl_result facets_draw(struct facets *facets, const struct facets_inputs *inputs);

#endif // OCEAN_FACETS_H
