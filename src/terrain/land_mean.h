// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_LAND_MEAN_H
#define TERRAIN_LAND_MEAN_H
// Colours of the land around any texel of a picture: means of the nearest that is known, of ever
// wider squares where there is none nearby (pull and push).

#include "base/context.h"
#include "terrain/frame.h"

enum { LAND_MEAN_LEVELS = 16 };

struct land_mean {
    const trl_context *ctx;
    bool is_round; // columns wrap around
    int count;
    struct land_mean_level {
        uint32_t width, height;
        float *texels; // owned; red, green, blue, part that is known
    } levels[LAND_MEAN_LEVELS];
};

// Of bytes RGBA, as many as the frame has texels; known where `states` is 0. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result land_mean_init(const trl_context *ctx, const struct layer_frame *frame,
                                       const uint8_t *rgba, const uint8_t *states,
                                       struct land_mean *out);
void land_mean_finish(struct land_mean *mean);

// At a texel. False: no land is known at all.
bool land_mean_at(const struct land_mean *mean, uint32_t x, uint32_t y, uint8_t rgb[3]);

#endif // TERRAIN_LAND_MEAN_H
