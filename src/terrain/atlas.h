// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_ATLAS_H
#define TERRAIN_ATLAS_H
// Tiles of pyramids on the GPU: one texture of square slots for each texel format, and a table of
// pages that says where every tile of every level is. Where a tile is not there the table names its
// nearest ancestor that is. The shaders' side is shaders/terrain/pages.glsl.
//
//     slots   R16, R32F, RGBA8 or R8: PYRAMID_SIDE texels a side, rows north first
//     pages   RGBA8: slot's column, slot's row, level of the tile in it, 255. Of each layer a block
//             of rows: a power of two for level 0, half as many below it for level 1, and so on

#include "gpu/texture.h"
#include "raster/pyramid.h"

enum { ATLAS_MAX_LAYERS = 64, ATLAS_MAX_TEXTURES = 4 };

struct atlas_slot {
    uint64_t frame; // that used it last; 0: never
    uint32_t layer;
    struct pyramid_tile tile;
};

struct atlas_texture {
    struct gpu_texture texture;
    uint32_t side;            // slots a side
    struct atlas_slot *slots; // owned; side x side
};

struct atlas_layer {
    const struct pyramid *pyramid;
    uint32_t texture;   // index in the atlas
    uint32_t first_row; // in the table
    uint32_t rows;      // for level 0: a power of two, no less than its columns and rows of tiles
};

// Owner: caller. Threads: that of the GPU.
struct atlas {
    struct gpu *gpu;
    uint64_t frame;
    uint32_t texture_count, layer_count;
    struct atlas_texture textures[ATLAS_MAX_TEXTURES];
    struct atlas_layer layers[ATLAS_MAX_LAYERS];
    struct gpu_texture pages;
    uint8_t *entries;                    // owned; of the table
    uint32_t changed_first, changed_end; // rows whose entries are newer than those of pages
    void *converted;                     // owned; a tile as its texture wants it
    size_t bytes;                        // of all textures
};

struct atlas_desc {
    uint32_t layer_count;
    const struct pyramid *pyramids[ATLAS_MAX_LAYERS]; // must outlive the atlas
    size_t max_bytes;
};

// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result atlas_init(struct gpu *gpu, const struct atlas_desc *desc,
                                   struct atlas *out);
void atlas_finish(struct atlas *atlas);

// A new frame: what it does not touch may be replaced.
void atlas_begin(struct atlas *atlas);

// Whether a tile is there; if so, this frame uses it.
bool atlas_touch(struct atlas *atlas, uint32_t layer, const struct pyramid_tile *tile);

// How many tiles of a layer's format there is room for.
uint32_t atlas_capacity(const struct atlas *atlas, uint32_t layer);

// Puts a tile in place of the one that was used longest ago. `is_put` is false when this frame uses
// all of them. The single tile of a last level stays for ever. TRL_ERROR_GPU.
TRL_MUST_USE trl_result atlas_put(struct atlas *atlas, uint32_t layer,
                                  const struct pyramid_tile *tile, const void *texels,
                                  bool *is_put);

// Brings the table of pages to the GPU. TRL_ERROR_GPU.
TRL_MUST_USE trl_result atlas_commit(struct atlas *atlas);

// What pages.glsl wants of a layer: width, height of its level 0, first row in the table, and rows
// of its level 0 plus its last level / 32.
void atlas_describe(const struct atlas *atlas, uint32_t layer, float paging[4]);

#endif // TERRAIN_ATLAS_H
