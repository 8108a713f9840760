// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef RASTER_PYRAMID_H
#define RASTER_PYRAMID_H
// A raster as a pyramid of square tiles in its own pixel space, for rasters that do not fit into
// memory.
//
// Level 0 has the file's pixels, each further level half as many a side, rounded up: the sizes that
// overviews in files have. Every level spans the whole raster, so where a size is odd a texel of
// the next level is a little smaller than two. Tile (x, y) of a level has the texels from
// (x, y) * PYRAMID_TILE on, and a border that reaches into its neighbours: around the circle, and
// over a pole to the opposite meridian, where the raster does. Its parent is tile (x, y) / 2 of the
// next level: that has all of the child's texels, though up to one of its own texels further on.
//
// What is read: overviews where the file has them, else means of the file's pixels. The coarsest
// levels are held whole from the start, so that something can always be shown.

#include "raster/raster.h"

enum {
    PYRAMID_TILE = 256,
    // A cubic needs two texels beyond; one more for the shift between a tile and its ancestors.
    PYRAMID_BORDER = 3,
    PYRAMID_SIDE = PYRAMID_TILE + 2 * PYRAMID_BORDER,
    PYRAMID_TEXELS = PYRAMID_SIDE * PYRAMID_SIDE,
    // A window may be a tile and so much around it.
    PYRAMID_MARGIN = 16,
    PYRAMID_WINDOW = PYRAMID_SIDE + 2 * PYRAMID_MARGIN,
    PYRAMID_MAX_LEVELS = 16
};

enum pyramid_format {
    PYRAMID_INT16, // void texels have the raster's nodata
    PYRAMID_FLOAT, // void texels are NaN
    PYRAMID_RGBA8, // void texels have alpha 0
    PYRAMID_UINT8
};

size_t pyramid_texel_bytes(enum pyramid_format format);

struct pyramid_level {
    uint32_t width, height; // texels
    uint32_t columns, rows; // tiles
};

struct pyramid_desc {
    const struct raster *raster; // needs to live only until the call returns
    enum pyramid_format format;
    bool wraps;                  // columns run around the planet
    bool over_north, over_south; // and rows over the poles
};

// Owner: caller. Threads: const calls from any.
struct pyramid {
    const trl_context *ctx;
    struct raster raster; // owned; read from by pyramid_init only
    enum pyramid_format format;
    bool wraps, over_north, over_south;
    uint32_t level_count;
    struct pyramid_level levels[PYRAMID_MAX_LEVELS]; // the last one is a single tile
    uint32_t base_level;                             // from here on, levels are held whole
    void *whole[PYRAMID_MAX_LEVELS];                 // owned; rows of texels, north first
    size_t bytes;                                    // of all of them
};

// Opens the file once more and reads the coarse levels. A large file without overviews is read
// whole for that, once, which is told as a warning; over a network it is refused.
// Returns TRL_OK; TRL_ERROR_IO; TRL_ERROR_INVALID; TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED. *out is
// zeroed on failure.
TRL_MUST_USE trl_result pyramid_init(const trl_context *ctx, const struct pyramid_desc *desc,
                                     struct pyramid *out);
void pyramid_finish(struct pyramid *pyramid);

struct pyramid_tile {
    uint32_t level, x, y;
};

bool pyramid_has_tile(const struct pyramid *pyramid, const struct pyramid_tile *tile);

// Reads tiles; one for each thread, since GDAL's datasets are not shareable.
struct pyramid_reader {
    const struct pyramid *pyramid;
    struct raster raster; // opened at the first tile that is not held whole
    void *patch;          // owned; a window's texels as they are read
};

// Errors go to `ctx`, which may be another than the pyramid's. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result pyramid_reader_init(const trl_context *ctx, const struct pyramid *pyramid,
                                            struct pyramid_reader *out);
void pyramid_reader_finish(struct pyramid_reader *reader);

// PYRAMID_SIDE rows of as many texels, north first, border included. The tile must be there.
// Returns TRL_OK; TRL_ERROR_IO; TRL_ERROR_INVALID; TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result pyramid_read(struct pyramid_reader *reader, const struct pyramid_tile *tile,
                                     void *texels);

// A rectangle of texels of a level, which may stick out of it: there stands what tiles have in
// their borders. No side is longer than PYRAMID_WINDOW.
struct pyramid_window {
    uint32_t level;
    int64_t x, y;
    uint32_t width, height;
};

// A tile with its border.
struct pyramid_window pyramid_window_of(const struct pyramid_tile *tile);

// Rows of the window's texels, as they are in the file. Returns as pyramid_read.
TRL_MUST_USE trl_result pyramid_read_window(struct pyramid_reader *reader,
                                            const struct pyramid_window *window, void *texels);

// Fills texels without heights in a window that was read (of int16 and floats) with what the next
// coarser level has there, linear between its texels, and so on. What is void in the coarsest level
// that is read from the file and in those held whole stays so. Returns as pyramid_read.
TRL_MUST_USE trl_result pyramid_fill_gaps(struct pyramid_reader *reader,
                                          const struct pyramid_window *window, void *texels);

// Private to pyramid.c and pyramid_read.c: pixels of a level, from an opened raster of its size.
TRL_MUST_USE trl_result pyramid_read_pixels(const struct pyramid *pyramid,
                                            const struct raster *level,
                                            const struct raster_window *window, void *out);

#endif // RASTER_PYRAMID_H
