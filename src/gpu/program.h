// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_PROGRAM_H
#define GPU_PROGRAM_H
// Programs from the shader files below shaders/, which are part of the library.
//
// A shader file has no #version and no precision statement: the builder writes them, and TRL_GLSL
// (always 1), TRL_ES (1 on ES), TRL_CLIP_CONTROL (1 with has_clip_control, else 0; see
// lib/depth.glsl), then the defines. `#include "lib/x.glsl"` is relative to shaders/; a file that
// is included twice counts once. Files in the folder that the environment variable TRL_SHADER_DIR
// names go before the built-in ones of the same name. Versions: 330 core or 300 es; with
// tessellation 400 core or 320 es.
//
// Tests validate every pass offline without defines; one that needs some says so in a line like
// `// validate: LAYER_COUNT 3; HAS_WATER 1`, one for each variant.
//
// Drivers compile at the first draw and again for each new combination of state and formats (docs
// of the platform: seconds in software), so keep programs small and their state fixed.

#include "gpu/texture.h"

struct gpu_program_desc {
    const char *vertex;                       // "lib/fullscreen.vert"
    const char *fragment;                     // "sky/sky.frag"
    const char *tess_control, *tess_evaluate; // both or none
    const char *const *defines;               // "NAME VALUE" or "NAME"
    size_t define_count;
};

struct gpu_uniform; // private to program.c
struct gpu_buffer;

struct gpu_program {
    struct gpu *gpu;
    uint32_t name;
    bool has_tessellation;
    size_t uniform_count;
    struct gpu_uniform *uniforms; // owned
};

// TRL_ERROR_GPU: does not compile or link, with "file:line: message" of the driver in the log (and
// the numbered source at debug level); TRL_ERROR_INVALID: no file of that name;
// TRL_ERROR_UNSUPPORTED: tessellation without the cap; TRL_ERROR_IO (TRL_SHADER_DIR);
// TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result gpu_program_init(struct gpu *gpu, const struct gpu_program_desc *desc,
                                         struct gpu_program *out);
void gpu_program_finish(struct gpu_program *program);

// Values stay with the program until they are set again. A name that the program does not have is
// ignored, since drivers drop what a define leaves unused.
void gpu_program_set_float(struct gpu_program *program, const char *name, float value);
void gpu_program_set_int(struct gpu_program *program, const char *name, int32_t value);
void gpu_program_set_vec2(struct gpu_program *program, const char *name, const float value[2]);
void gpu_program_set_vec3(struct gpu_program *program, const char *name, const float value[3]);
void gpu_program_set_vec4(struct gpu_program *program, const char *name, const float value[4]);
void gpu_program_set_mat3(struct gpu_program *program, const char *name, const float value[9]);
void gpu_program_set_mat4(struct gpu_program *program, const char *name, const float value[16]);

// Arrays: `uniform float name[n]`, `uniform vec4 name[n]`; count <= n; values x, y, z, w after one
// another.
void gpu_program_set_floats(struct gpu_program *program, const char *name, const float *values,
                            size_t count);
void gpu_program_set_vec4s(struct gpu_program *program, const char *name, const float *values,
                           size_t count);
void gpu_program_set_ivec4s(struct gpu_program *program, const char *name, const int32_t *values,
                            size_t count);

// Textures by the sampler's name, buffers by the block's name. Bound at each draw; they must be
// alive then.
void gpu_program_set_texture(struct gpu_program *program, const char *name,
                             const struct gpu_texture *texture);
void gpu_program_set_block(struct gpu_program *program, const char *name,
                           const struct gpu_buffer *buffer);

// Whether the linked program uses a uniform, sampler or block of that name.
bool gpu_program_has(const struct gpu_program *program, const char *name);

#endif // GPU_PROGRAM_H
