// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef TERRAIN_LAYER_H
#define TERRAIN_LAYER_H
// One raster of the surface, resident: on the GPU with its mips, elevations also on the CPU.
// Without a GPU (NULL) pictures are on the CPU as well, and masks nowhere.

#include "gpu/program.h"
#include "gpu/texture.h"
#include "raster/raster.h"

// Where texels lie. Angles in radians.
struct layer_frame {
    uint32_t width, height;
    double centre_latitude, centre_longitude;
    double half_width, half_height;
    double texel_width, texel_height;
    double feather;
    bool is_whole_circle, touches_north, touches_south;
};

// Heights on the CPU: one of the two arrays, in units of `scale` from `offset_m`.
struct layer_heights {
    int16_t *shorts; // owned
    float *floats;   // owned
    double scale, offset_m;
};

struct terrain_layer {
    const trl_context *ctx;
    struct layer_frame frame;
    struct layer_heights heights; // of elevation layers only
    uint8_t *roots; // owned; of pictures without a GPU: RGBA, square roots of linear values, north
                    // row first
    struct gpu_texture texture;
    // Of elevation layers: metres are this times what the texture holds, and this more.
    double texture_scale_m, texture_offset_m;
};

// A place as columns and rows of a layer, (0, 0) the first texel's centre.
struct layer_place {
    double x, y;
    double weight; // 0 outside; grows to 1 over the feather
};

// Frame of an opened raster, reduced to what a texture may measure.
struct layer_frame layer_frame_of(const struct raster *raster, const struct gpu *gpu,
                                  double feather);

struct layer_place layer_locate(const struct layer_frame *frame, double latitude, double longitude);

// Metres at a texel; columns wrap around and rows run over a pole where the layer does.
double layer_texel(const struct terrain_layer *layer, int64_t x, int64_t y);

// Metres, with the cubic of shared/cubic.glsl.
double layer_sample(const struct terrain_layer *layer, double x, double y);

// Texels that are stored beside another: index of (x, y) with the rules above.
size_t layer_texel_index(const struct layer_frame *frame, int64_t x, int64_t y);

// Reads heights, replaces void ones by what `below` says (a function of place), and levels out the
// rows around a pole, where texels are far narrower than they are high.
struct layer_fill {
    double (*height)(const void *user, double latitude, double longitude);
    const void *user;
};
TRL_MUST_USE trl_result layer_read_heights(const struct raster *raster,
                                           const struct layer_fill *below,
                                           struct terrain_layer *layer);

// Texture of heights from the heights on the CPU.
TRL_MUST_USE trl_result layer_upload_heights(struct gpu *gpu, struct terrain_layer *layer);

// Texture of a picture, encoded as the square root of the linear value; alpha is its coverage.
TRL_MUST_USE trl_result layer_load_picture(struct gpu *gpu, const struct raster *raster,
                                           struct terrain_layer *layer);

// Texture of a mask; its bytes are handed out for the time of loading: free with mem_free.
TRL_MUST_USE trl_result layer_load_mask(struct gpu *gpu, const struct raster *raster,
                                        struct terrain_layer *layer, uint8_t **bytes);

void layer_finish(struct terrain_layer *layer);

#endif // TERRAIN_LAYER_H
