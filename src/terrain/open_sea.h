// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_OPEN_SEA_H
#define TERRAIN_OPEN_SEA_H
// Which squares of pixels show level sea far from any shore: there the look of the ground is that
// of a program without heights and made-up relief, in a third of the time.

#include "terrain/compose.h"

struct terrain_open_sea {
    struct gpu *gpu;
    const struct surface *surface;
    struct gpu_program program;
    struct gpu_texture squares; // R8, as gpu/hide.h has it
    struct gpu_target target;
};

// TRL_ERROR_GPU; TRL_ERROR_MEMORY. Must not outlive the surface.
TRL_MUST_USE trl_result terrain_open_sea_init(const struct surface *surface,
                                              struct terrain_open_sea *out);
void terrain_open_sea_finish(struct terrain_open_sea *open);
// `depth` is that of the picture's kinds.
TRL_MUST_USE trl_result terrain_open_sea_resize(struct terrain_open_sea *open,
                                                const struct gpu_texture *depth);

// *out is 1 in squares that are open sea, and stays `open`'s; NULL: none is looked for, since it
// would save nothing or heights have the sea's bed.
TRL_MUST_USE trl_result terrain_open_sea_find(struct terrain_open_sea *open,
                                              const struct terrain_compose_inputs *inputs,
                                              const struct gpu_texture **out);

#endif // TERRAIN_OPEN_SEA_H
