// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_SEA_H
#define FRAME_SEA_H
// A scene's ocean as models of the sky light it.

#include "scene/scene.h"
#include "sky/sea.h"

struct frame_sea {
    const trl_context *ctx;
    struct sky_sea sea; // with the volume, if it is there
    struct sky_sea_volume *volume;
    // Part of the light of an even sky that the deep sea sends back: its surface, white caps, and
    // what comes out of it; linear sRGB. 0 where there is no volume.
    float albedo[3];
};

// Without what is below: no volume.
struct frame_sea frame_sea_surface(const trl_context *ctx, const struct ocean_desc *ocean);

// Solves the light in the water: half a second of processor time where there is an ocean, once: the
// solution is kept on disk.
// TRL_ERROR_MEMORY; *out is to be finished then too.
TRL_MUST_USE trl_result frame_sea_init(const trl_context *ctx, const struct trl_scene *scene,
                                       struct frame_sea *out);
void frame_sea_finish(struct frame_sea *sea);

// The colours of water in that star's light. TRL_ERROR_MEMORY; free it with mem_free.
TRL_MUST_USE trl_result frame_sea_make_volume(const trl_context *ctx,
                                              const struct ocean_desc *ocean,
                                              const struct medium *medium,
                                              struct sky_sea_volume **out);

#endif // FRAME_SEA_H
