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

#endif // TERRAIN_VOIDS_H
