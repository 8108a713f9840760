// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_LAYER_H
#define TERRAIN_LAYER_H
// One raster of the surface. Held whole: on the GPU with its mips, elevations also on the CPU;
// without a GPU (NULL) pictures are on the CPU as well, and masks nowhere. Or, where that is too
// much, in tiles (stream.h): then what is here is a coarse level of it.

#include "gpu/program.h"
#include "gpu/texture.h"
#include "terrain/frame.h"

enum { LAYER_COARSER_STEPS = 12 };

// Heights on the CPU: one of the two arrays, in units of `scale` from `offset_m`.
struct layer_heights {
    int16_t *shorts; // owned
    float *floats;   // owned
    // Owned; by how much coarser than its texels the layer is in gaps, as a logarithm to base 2 in
    // steps of 1 / LAYER_COARSER_STEPS. NULL: it has none.
    uint8_t *coarser;
    double scale, offset_m;
    // What is below the sphere is the sea's bed, and level water lies over it; else heights below
    // water have been raised to it.
    bool has_bed;
};

// Something that covers the ground with one colour, where a mask in place of a picture says so.
struct layer_cover {
    bool is_there;
    uint8_t roots[3]; // square roots of linear values
};

struct stream;
struct stream_layer;

struct terrain_layer {
    const trl_context *ctx;
    struct stream *stream; // NULL: held whole; else with the layer's tiles
    struct stream_layer *tiles;
    struct layer_frame frame;
    double mode;                  // of shared/blend.glsl
    struct layer_cover cover;     // of pictures
    struct layer_heights heights; // of elevation layers only
    uint8_t *roots; // owned; of pictures without a GPU: RGBA, square roots of linear values, north
                    // row first
    struct gpu_texture texture;
    // Of elevation layers: metres are this times what the texture holds, and this more.
    double texture_scale_m, texture_offset_m;
    double texture_steps; // whole numbers that its 0 to 1 stands for; 0: it holds units as they are
};

// Metres at a texel; columns wrap around and rows run over a pole where the layer does.
double layer_texel(const struct terrain_layer *layer, int64_t x, int64_t y);

// Sets what one texel holds, as near as its type allows.
void layer_set_texel(struct layer_heights *heights, size_t index, double metres);

// log2 of how much coarser than its texels it is at a place, linear between texels: 0 where the
// file has data.
double layer_coarser(const struct terrain_layer *layer, double x, double y);

// Metres, with the cubic of shared/cubic.glsl: of the finest texels that there are, and of those
// that are held here.
double layer_sample(const struct terrain_layer *layer, double x, double y);
double layer_sample_held(const struct terrain_layer *layer, double x, double y);

// The same, linear between texels.
double layer_sample_linear(const struct terrain_layer *layer, double x, double y);
double layer_sample_held_linear(const struct terrain_layer *layer, double x, double y);

// RGBA of a picture without a GPU, square roots, linear between texels, 0 to 1; as above.
void layer_sample_roots(const struct terrain_layer *layer, double x, double y, double rgba[4]);
void layer_sample_held_roots(const struct terrain_layer *layer, double x, double y, double rgba[4]);

// Where the finest texels lie, held here or not.
const struct layer_frame *layer_finest_frame(const struct terrain_layer *layer);

// Frame of an opened raster, reduced to what a texture may measure (gpu may be NULL).
struct layer_frame layer_frame_for(const struct raster *raster, const struct gpu *gpu,
                                   double feather);

// What gaps of a layer are filled with: a height that lets what is below show (a function of
// place).
struct layer_fill {
    double (*height)(const void *user, double latitude, double longitude);
    const void *user;
};

// Reads heights, fills gaps (voids.h), and levels out the rows around a pole, where texels are far
// narrower than they are high. TRL_ERROR_INVALID when there are no data at all; TRL_ERROR_IO;
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result layer_read_heights(const struct raster *raster,
                                           const struct layer_fill *below,
                                           struct terrain_layer *layer);

// The same of texels that have been read: shorts or floats of the frame's size, by the raster's
// type; copied.
TRL_MUST_USE trl_result layer_take_heights(const struct raster *raster, const void *texels,
                                           const struct layer_fill *below,
                                           struct terrain_layer *layer);

// Square roots of linear values in place of sRGB codes, of `count` RGBA; of a cover its colour, and
// as alpha the mask, times alpha.
void layer_take_roots(const struct layer_cover *cover, uint8_t *rgba, size_t count);
struct layer_cover layer_cover_of(const float rgb[3]);

// What textures of the layer's heights hold: R16 where there is that for shorts, else R32F.
void layer_scale_texture(const struct gpu *gpu, struct terrain_layer *layer);

// Texture of heights from the heights on the CPU.
TRL_MUST_USE trl_result layer_upload_heights(struct gpu *gpu, struct terrain_layer *layer);

// Changes the bytes of a picture, sRGB and alpha, after they are read; a pointer to it may be
// NULL.
struct layer_touch {
    trl_result (*touch)(const void *user, const struct terrain_layer *layer, uint8_t *rgba);
    const void *user;
};

// Texture of a picture, encoded as the square root of the linear value; alpha is its coverage, less
// toward gaps. TRL_ERROR_INVALID also when it is void everywhere; what `touch` may return.
TRL_MUST_USE trl_result layer_load_picture(struct gpu *gpu, const struct raster *raster,
                                           const struct layer_touch *touch,
                                           struct terrain_layer *layer);

// The same of a picture of normals, which is kept as it is. On the GPU only.
TRL_MUST_USE trl_result layer_load_normals(struct gpu *gpu, const struct raster *raster,
                                           struct terrain_layer *layer);

// Texture of a mask; its bytes are handed out for the time of loading: free with mem_free.
TRL_MUST_USE trl_result layer_load_mask(struct gpu *gpu, const struct raster *raster,
                                        struct terrain_layer *layer, uint8_t **bytes);

// Texture of a mask's bytes in its first channel and others in its second.
TRL_MUST_USE trl_result layer_upload_mask(struct gpu *gpu, const uint8_t *bytes,
                                          const uint8_t *others, struct terrain_layer *layer);

void layer_finish(struct terrain_layer *layer);

#endif // TERRAIN_LAYER_H
