// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_TARGET_H
#define GPU_TARGET_H
// Where a pass draws: a framebuffer over textures that somebody else owns and that outlive it.

#include "gpu/texture.h"

enum { GPU_TARGET_MAX_COLORS = 4 };

struct gpu_attachment {
    const struct gpu_texture *texture; // NULL: none
    uint32_t level;
    uint32_t layer; // slice of a 3D texture, layer of an array, 0 for 2D
};

struct gpu_target_desc {
    const char *label;
    uint32_t color_count; // colors[i] is `layout(location = i) out` of the fragment shader; 0:
                          // depth only
    struct gpu_attachment colors[GPU_TARGET_MAX_COLORS];
    struct gpu_attachment depth; // DEPTH32F
};

struct gpu_target {
    struct gpu *gpu;
    uint32_t name; // 0 is the window's framebuffer
    uint32_t width, height;
    uint32_t color_count;
    bool has_depth;
    bool is_srgb; // some color texture is SRGB8_A8
    struct gpu_attachment
        colors[GPU_TARGET_MAX_COLORS]; // as given; attached textures must stay in place
};

struct gpu_rect {
    uint32_t x, y, width, height; // pixels, from the lower left corner
};

// All attachments need the same size (of their level). TRL_ERROR_INVALID: they do not, or there are
// none; TRL_ERROR_GPU: the driver cannot draw to them.
TRL_MUST_USE trl_result gpu_target_init(struct gpu *gpu, const struct gpu_target_desc *desc,
                                        struct gpu_target *out);
void gpu_target_finish(struct gpu_target *target);

// The usual case: a texture that is drawn to and looked at later, with a depth of its size or NULL.
// Both are zeroed on failure.
TRL_MUST_USE trl_result gpu_target_init_texture(struct gpu *gpu,
                                                const struct gpu_texture_desc *desc,
                                                const struct gpu_texture *depth,
                                                struct gpu_texture *texture,
                                                struct gpu_target *out);

// The framebuffer of the window of a wrapped context, at its present size. Needs no finish.
struct gpu_target gpu_target_window(struct gpu *gpu, uint32_t width, uint32_t height);

// Draws to another layer from here on: for tables that are computed slice by slice.
TRL_MUST_USE trl_result gpu_target_set_layer(struct gpu_target *target, uint32_t color,
                                             uint32_t layer);

// Reads RGBA bytes, 4 a pixel, bottom row first, of the window or of a target whose color 0 is an
// 8-bit format. For other targets read the texture. TRL_ERROR_INVALID: the rectangle is not inside.
TRL_MUST_USE trl_result gpu_target_read_rgba8(const struct gpu_target *target, struct gpu_rect rect,
                                              uint8_t *rgba);

#endif // GPU_TARGET_H
