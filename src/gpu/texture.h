// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_TEXTURE_H
#define GPU_TEXTURE_H
// Textures of two dimensions, three, or an array of layers.
//
// Texels on the CPU side (upload and read) are tightly packed, row 0 at texture coordinate 0 (a
// picture that is to be written top row first must be turned over). Components are uint8_t for the
// 8-bit formats, uint16_t for R16, int16_t for R16I, float for all others, the 16-bit floats
// included.

#include "gpu/gpu.h"

enum gpu_format {
    GPU_FORMAT_R8,
    GPU_FORMAT_RG8,
    GPU_FORMAT_RGBA8,
    GPU_FORMAT_SRGB8_A8, // shaders read and write linear values
    GPU_FORMAT_R16F,
    GPU_FORMAT_RG16F,
    GPU_FORMAT_RGBA16F,
    GPU_FORMAT_R32F,
    GPU_FORMAT_RG32F,
    GPU_FORMAT_RGBA32F,
    GPU_FORMAT_R16,      // 0 to 1 in 65535 steps; needs has_norm16
    GPU_FORMAT_R16I,     // isampler2D in the shader; GPU_FILTER_NEAREST only
    GPU_FORMAT_DEPTH32F, // 2D and GPU_FILTER_NEAREST only
    GPU_FORMAT_COUNT
};

enum gpu_shape { GPU_SHAPE_2D, GPU_SHAPE_3D, GPU_SHAPE_2D_ARRAY };
enum gpu_filter {
    GPU_FILTER_NEAREST,
    GPU_FILTER_LINEAR,   // within level 0
    GPU_FILTER_TRILINEAR // and between mip levels
};
enum gpu_wrap { GPU_WRAP_CLAMP, GPU_WRAP_REPEAT, GPU_WRAP_MIRROR };

struct gpu_texture_desc {
    const char *label; // for messages and graphics debuggers; NULL: none
    enum gpu_shape shape;
    enum gpu_format format;
    uint32_t width, height;
    uint32_t depth;  // slices or layers, 1 for 2D
    uint32_t levels; // 1: no mips; 0: the whole chain
    enum gpu_filter filter;
    enum gpu_wrap wrap_x, wrap_y, wrap_z;
    float anisotropy; // 1: off; clamped to what the GPU has
    const void *data; // level 0, or NULL: undefined content
};

struct gpu_texture {
    struct gpu *gpu;
    uint32_t name;
    enum gpu_shape shape;
    enum gpu_format format;
    uint32_t width, height, depth, levels;
};

// A box of texels of one mip level.
struct gpu_region {
    uint32_t level;
    uint32_t x, y, z;
    uint32_t width, height, depth;
};

// 2D, RGBA8, 1 x 1 x 1, one level, linear, clamped, no data.
struct gpu_texture_desc gpu_texture_desc_default(void);

// TRL_ERROR_INVALID: a size of 0 or above the GPU's limits, a filter or shape that the format
// cannot have; TRL_ERROR_UNSUPPORTED: linear filter of a 32F format without has_float_linear, R16
// without has_norm16; TRL_ERROR_GPU.
TRL_MUST_USE trl_result gpu_texture_init(struct gpu *gpu, const struct gpu_texture_desc *desc,
                                         struct gpu_texture *out);
void gpu_texture_finish(struct gpu_texture *texture);

// All of one level.
struct gpu_region gpu_texture_region(const struct gpu_texture *texture, uint32_t level);

// TRL_ERROR_INVALID: the region is not inside the texture; TRL_ERROR_GPU.
TRL_MUST_USE trl_result gpu_texture_upload(struct gpu_texture *texture,
                                           const struct gpu_region *region, const void *data);

// Makes all levels from level 0. Not for R16I and DEPTH32F (TRL_ERROR_INVALID).
TRL_MUST_USE trl_result gpu_texture_make_mips(struct gpu_texture *texture);

// Waits for the GPU. `data` holds region texels x gpu_format_texel_bytes().
// TRL_ERROR_INVALID as for upload; TRL_ERROR_UNSUPPORTED: depth on ES; TRL_ERROR_MEMORY;
// TRL_ERROR_GPU.
TRL_MUST_USE trl_result gpu_texture_read(const struct gpu_texture *texture,
                                         const struct gpu_region *region, void *data);

// On the CPU side, see above.
uint32_t gpu_format_channels(enum gpu_format format);
size_t gpu_format_texel_bytes(enum gpu_format format);
const char *gpu_format_name(enum gpu_format format);

#endif // GPU_TEXTURE_H
