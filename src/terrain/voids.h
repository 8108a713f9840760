// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_VOIDS_H
#define TERRAIN_VOIDS_H
// Gaps of rasters, filled when they are read, so that nobody else has to know of them.

#include "terrain/layer.h"

// In a gap stands what is below, and the difference that the gap's rim has to it, spread evenly
// over the gap and fading over the layer's feather: a hole in a mountain side is closed between its
// rims, and where a model ends in nothing its last heights run out into those below. No cliff, and
// no good height is touched. TRL_ERROR_INVALID: nothing but gaps; TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result voids_fill_heights(const struct raster *raster,
                                           const struct layer_fill *below,
                                           struct terrain_layer *layer);

// Pixels without data (alpha 0) get their neighbours' colours, so that filters mix in no black.
// Where the file has no alpha of its own, alpha also falls to 0 over the feather on the way to
// them. Returns as above.
TRL_MUST_USE trl_result voids_fill_picture(const struct raster *raster,
                                           const struct layer_frame *frame, uint8_t *rgba);

// The parts of that. Colours of pixels that have some, over those that have none.
TRL_MUST_USE trl_result voids_spread_colours(const trl_context *ctx,
                                             const struct layer_frame *frame, uint8_t *rgba);
// Distances in texels to the nearest texel that is 0, from an array that holds VOIDS_FAR for the
// others.
extern const float VOIDS_FAR;
TRL_MUST_USE trl_result voids_measure(const trl_context *ctx, const struct layer_frame *frame,
                                      float *distance);
// 0 at a gap to 1 at a distance of `feather` texels.
double voids_weight(double distance, double feather);

#endif // TERRAIN_VOIDS_H
