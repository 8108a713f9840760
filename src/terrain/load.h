// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_LOAD_H
#define TERRAIN_LOAD_H
// Private to load.c (rasters held whole), load_colour.c, load_sea.c and load_tiles.c (those held in
// tiles).

#include "base/context.h"
#include "terrain/surface.h"

// One of the desc's layers.
struct load_item {
    struct raster raster; // owned; opened, or not
    trl_result opened;
    char said[1024];     // what is wrong with it
    bool is_passed_over; // a missing file that may be missing
    bool is_tiled;
};

// What is needed while loading only.
struct loader {
    const struct surface_desc *desc;
    struct surface *surface;
    trl_context quiet; // the context, but errors of rasters wait in `said` for what becomes of them
    char said[1024];
    struct load_item *items; // owned; as many as the desc has layers
    double bytes;            // of rasters held whole
};

// What a gap of a layer must hold to show what is below.
struct load_below {
    const struct surface *surface;
    double mode;
};
double load_fill_height(const void *below, double latitude, double longitude);

// Bytes that a layer held whole takes on both sides.
double load_whole_bytes(const struct loader *loader, const struct surface_layer_desc *desc,
                        const struct raster *raster);

// Sets scale and offset of the layer's heights: the scene's, of metres that the file's own make of
// its numbers. TRL_ERROR_INVALID.
TRL_MUST_USE trl_result load_set_scale(const struct loader *loader,
                                       const struct surface_layer_desc *desc,
                                       const struct raster *raster, struct terrain_layer *layer);

// Reads a mask that is held whole into layer and surface; with depths it is uploaded later.
// As layer_load_mask.
TRL_MUST_USE trl_result load_mask(struct surface *surface, const struct raster *raster,
                                  struct terrain_layer *layer);
// Keeps how deep water is below the layer's heights, for the masks; before they are raised.
void load_note_depths(struct surface *surface, const struct terrain_layer *layer);
// Uploads masks with depths. TRL_ERROR_GPU, TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result load_upload_depths(struct surface *surface);

// Raises the layer's heights to sea level where water is. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result load_raise_sea(const struct loader *loader, struct terrain_layer *layer);

// Of a picture beside open water that is drawn by itself: colours of land go on some texels beyond
// the shore. `surface` is a struct surface, whose masks are there. As the touch of layer.h;
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result load_paint_shore(const void *surface, const struct terrain_layer *layer,
                                         uint8_t *rgba);

// Chooses which of the opened rasters are held in tiles: none when all fit; else the largest, until
// the others take no more than half of what is allowed. Those behind a network always are, and
// those that no texture can hold.
void load_choose_tiled(struct loader *loader);

// Makes a layer in tiles. Its frame is set here. As surface_init.
TRL_MUST_USE trl_result load_tiled(struct loader *loader, const struct surface_layer_desc *desc,
                                   const struct raster *raster, struct terrain_layer *layer);

// When all layers are there: starts to stream. As stream_start.
TRL_MUST_USE trl_result load_start_stream(struct loader *loader);

#endif // TERRAIN_LOAD_H
