// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_STREAM_H
#define TERRAIN_STREAM_H
// The layers of a surface that do not fit into memory: held in tiles, of which a view loads those
// that it shows.
//
// Once a frame the pyramid of each layer is walked from its single coarsest tile down to where
// texels are no larger than pixels. What is met is asked for, the coarsest first, read by the
// threads of the tile cache, and brought to the atlas. No mesh and no pass is asked: all look at
// places with a level of detail, and find the texels of that level or of the nearest coarser one
// that is there.

#include "base/camera.h"
#include "raster/tile_cache.h"
#include "terrain/atlas.h"
#include "terrain/frame.h"

struct surface;
struct terrain_layer;

// One layer. `frame` is that of the file's own pixels; the terrain_layer that it belongs to has the
// pyramid's coarse level, whole and without gaps.
struct stream_layer {
    struct pyramid pyramid;
    struct layer_frame frame;
    const struct surface *surface;
    const struct terrain_layer *layer;
    uint32_t source;            // in the cache
    bool is_elevation, is_root; // is_root: a picture that is held as square roots
};

// What a walk has met.
struct stream_want {
    uint32_t layer;
    struct pyramid_tile tile;
    float priority;
};

// Where heights became others: a cap of the sphere.
struct stream_change {
    struct vec3 direction;
    double angle_rad;
};
enum { STREAM_CHANGES = 256 };

// Owner: the surface. Threads: updates from the thread of the GPU; stream_sample from any.
struct stream {
    const trl_context *ctx;
    struct gpu *gpu; // NULL: on the CPU only
    size_t max_bytes;
    struct tile_cache *cache;
    struct atlas atlas;
    uint32_t layer_count;
    struct stream_layer layers[ATLAS_MAX_LAYERS];
    struct stream_want *wants; // owned
    size_t want_count, want_size;
    bool waits;        // frames and samples are exact: they wait for what is missing
    bool is_crowded;   // a view wants more than fits: told once
    double coarser;    // levels by which this frame's tiles are coarser than pixels
    uint64_t revision; // of the heights on the GPU
    struct stream_change
        changes[STREAM_CHANGES]; // the latest; that to revision r at r % their count
    size_t missing;              // what the last frame did without
    struct vec3 last_position_m;
};

// Makes one without layers, which may use so many bytes beside what the pyramids hold. `waits`:
// see above. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result stream_create(const trl_context *ctx, struct gpu *gpu, bool waits,
                                      struct stream **out);
void stream_destroy(struct stream **stream);

// Room for one more layer, with its frame, pyramid and layer still to be filled in. NULL: there
// are too many (logged).
struct stream_layer *stream_add(struct stream *stream);

// Takes the last one back.
void stream_drop(struct stream *stream);

// When all layers are there: starts the cache, and brings the coarsest tiles to the GPU.
// TRL_ERROR_MEMORY; TRL_ERROR_GPU.
TRL_MUST_USE trl_result stream_start(struct stream *stream, size_t max_bytes);

// For a view: asks for its tiles, and shows those that are there. Waits until nothing is missing
// where the stream waits. Bounds of the surface grow by what arrives.
// TRL_ERROR_GPU; TRL_ERROR_MEMORY; TRL_ERROR_CANCELLED.
struct stream_view {
    const struct camera *camera;
    double pixel_rad; // angle of a pixel
};
TRL_MUST_USE trl_result stream_update(struct stream *stream, struct surface *surface,
                                      const struct stream_view *view);

// Walks the pyramids for a view (stream_walk.c) and fills stream->wants. TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result stream_walk(struct stream *stream, const struct surface *surface,
                                    const struct stream_view *view);

// What a tile holds is changed to what the surface shows (stream_prepare.c); for the cache.
trl_result stream_prepare(const void *stream_layer, struct pyramid_reader *reader,
                          const struct tile_load *load);

// Lets alpha of a picture's tile fall toward gaps over the layer's feather (stream_feather.c). As
// pyramid_read.
trl_result stream_feather(const struct stream_layer *layer, struct pyramid_reader *reader,
                          const struct pyramid_tile *tile, uint8_t *rgba);

// See surface_has_changed.
bool stream_has_changed(const struct stream *stream, uint64_t since, struct vec3 direction,
                        double angle_rad);

// What it holds on both sides.
double stream_bytes(const struct stream *stream);

// What bind.c hands to shaders: see terrain/pages.glsl.
void stream_describe(const struct stream *stream, const struct stream_layer *layer,
                     float paging[4]);
const struct gpu_texture *stream_texture(const struct stream *stream,
                                         const struct stream_layer *layer);

// Metres at a column and row of the layer's coarse frame, cubic between the finest texels; the
// finest that are there where the stream does not wait.
double stream_sample(struct stream *stream, const struct stream_layer *layer, double x, double y);

// The same, linear.
double stream_sample_linear(struct stream *stream, const struct stream_layer *layer, double x,
                            double y);

// The same of a picture: RGBA, 0 to 1, linear between texels.
void stream_sample_picture(struct stream *stream, const struct stream_layer *layer, double x,
                           double y, double rgba[4]);

#endif // TERRAIN_STREAM_H
