// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef CLOUD_VOLUME_H
#define CLOUD_VOLUME_H
// The noise of clouds: a cube that tiles space, of simplex noise (Perlin 2002) for where they are
// and Worley's (1996) for their billows. Values are ranks: a part c of the cube is above 1 - c.
// A second channel is the largest value of the cube of 2 CLOUD_BORDER + 1 texels around, so that
// one look tells whether a step of CLOUD_BORDER texels can meet cloud, whatever the cover is
// (Michelic 2019, Figure 9, has the border for one cover in the texels).
//
// Values are whole numbers of 1/2048, which 16-bit floats hold exactly: CPU and GPU see the same.

#include "base/context.h"

enum { CLOUD_SIDE = 128, CLOUD_LEVELS = 8, CLOUD_BORDER = 4, CLOUD_STEPS = 2048 };

// Owner: whoever made it. Threads: const calls from any.
struct cloud_volume {
    const trl_context *ctx;
    uint16_t *texels[CLOUD_LEVELS]; // [z][y][x][2], in 1/2048; side >> level; level 0 owns all
    double spread[CLOUD_LEVELS];    // half the width of an even distribution with the spread of
                                    // what a texel of the level is the mean of
};

// Computes it, or takes it from the context's cache. TRL_ERROR_MEMORY, TRL_ERROR_CANCELLED.
TRL_MUST_USE trl_result cloud_volume_init(const trl_context *ctx, uint32_t seed,
                                          struct cloud_volume *out);
void cloud_volume_finish(struct cloud_volume *volume);

// The two channels at a place, in tiles, between texels and levels linearly, as textureLod does.
struct cloud_noise {
    double value, around;
};
struct cloud_noise cloud_volume_sample(const struct cloud_volume *volume, const double place[3],
                                       double level);

// cloud_volume.spread between levels.
double cloud_volume_spread(const struct cloud_volume *volume, double level);

// Parts of cloud_volume_init. Fills level 0.
TRL_MUST_USE trl_result cloud_noise_fill(const trl_context *ctx, uint32_t seed, uint16_t *texels);
bool cloud_cache_load(const trl_context *ctx, uint32_t seed, uint16_t *texels);
void cloud_cache_store(const trl_context *ctx, uint32_t seed, uint16_t *texels);

#endif // CLOUD_VOLUME_H
