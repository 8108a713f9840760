// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_INTERNAL_H
#define GPU_INTERNAL_H
// What the files of src/gpu/ share. The only headers of the tree that see GL.

#include "gpu/gpu.h"
#include "gpu/program.h"

#include <epoxy/gl.h>

// Names an object in graphics debuggers; nothing without has_debug or without a label.
void gpu_label(struct gpu *gpu, uint32_t kind, uint32_t name, const char *label);

// Reads version, limits and extensions of the current context, and checks the floor.
TRL_MUST_USE trl_result gpu_caps_read(struct gpu *gpu, uint32_t hidden_caps);

// GL_TEXTURE_2D, GL_TEXTURE_3D or GL_TEXTURE_2D_ARRAY.
GLenum gpu_texture_gl_target(const struct gpu_texture *texture);

// Attaches a level and layer of a texture to the framebuffer bound to `framebuffer_target`.
void gpu_texture_attach(const struct gpu_texture *texture, GLenum framebuffer_target,
                        GLenum attachment, GLint level, GLint layer);

// Sets how glReadPixels packs rows, and that it writes to memory of the CPU.
void gpu_pack_reset(void);

// Makes the program and all its textures and blocks current. TRL_ERROR_INVALID: a sampler or block
// that the program uses was never set.
TRL_MUST_USE trl_result gpu_program_bind(const struct gpu_program *program);

#endif // GPU_INTERNAL_H
