// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef FRAME_SEA_H
#define FRAME_SEA_H
// A scene's ocean as models of the sky light it.

#include "scene/scene.h"
#include "sky/sea.h"

struct frame_sea {
    const trl_context *ctx;
    const struct ocean_desc *ocean;
    struct sky_sea sea; // with the volume, if it is there
    struct sky_sea_volume *volume;
    bool is_lit; // the volume has spectra, which eyes under water do without
    // Part of the light of an even sky that the deep sea sends back: its surface, white caps, and
    // what comes out of it; linear sRGB. 0 where the volume is not lit.
    float albedo[3];
};

// Without what is below: no volume.
struct frame_sea frame_sea_surface(const trl_context *ctx, const struct ocean_desc *ocean);

// The scene must outlive it. TRL_ERROR_MEMORY; *out is to be finished then too.
TRL_MUST_USE trl_result frame_sea_init(const trl_context *ctx, const struct trl_scene *scene,
                                       struct frame_sea *out);
// What comes out of the water, if it is not known yet: half a second of processor time where there
// is an ocean, once: the solution is kept on disk. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result frame_sea_light(struct frame_sea *sea);
void frame_sea_finish(struct frame_sea *sea);

// The colours of water in that star's light, lit. TRL_ERROR_MEMORY; free it with mem_free.
TRL_MUST_USE trl_result frame_sea_make_volume(const trl_context *ctx,
                                              const struct ocean_desc *ocean,
                                              const struct medium *medium,
                                              struct sky_sea_volume **out);

#endif // FRAME_SEA_H
