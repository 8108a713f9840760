// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef API_GROUND_H
#define API_GROUND_H
// What a trl_ground is, for the public functions that look into it.

#include "base/context.h"
#include "frame/mesh_truth.h"
#include "frame/relief.h"
#include <terrella/ground.h>

struct trl_ground {
    const trl_context *ctx;
    const struct trl_scene *scene;
    struct relief relief;
    struct reference_surface surface; // of the relief
    struct mesh_truth truth;          // of the view last asked for; empty at first
    struct camera camera;             // from which it was seen
};

// The camera of a checked view. TRL_ERROR_INVALID: it cannot be there.
TRL_MUST_USE trl_result ground_camera(const trl_ground *ground, const trl_view *view, double aspect,
                                      struct camera *out);

struct reference_caster ground_caster(const trl_ground *ground, const struct camera *camera,
                                      uint32_t height);

// Casts through size[0] x size[1] places of the caster's picture into ground->truth, unless they
// are there. TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result ground_cast(trl_ground *ground, const struct reference_caster *caster,
                                    const uint32_t size[2]);

#endif // API_GROUND_H
