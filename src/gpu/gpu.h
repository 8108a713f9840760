// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
#ifndef GPU_GPU_H
#define GPU_GPU_H
// A GL context and what it can do. The floor is OpenGL 3.3 core or OpenGL ES 3.0 with float render
// targets; everything above it is a capability with a fallback. Nobody outside src/gpu/ calls GL.
//
// Threads: a struct gpu and all objects made from it belong to the thread on which its context is
// current. Every `init` leaves *out zeroed when it fails; every `finish` of a zeroed object is a
// no-op.

#include "base/context.h"

// Capabilities that can be hidden, so that the floor is tested on machines that have more.
enum gpu_cap {
    GPU_CAP_CLIP_CONTROL = 1 << 0,
    GPU_CAP_TIMER_QUERY = 1 << 1,
    GPU_CAP_TESSELLATION = 1 << 2,
    GPU_CAP_FLOAT_LINEAR = 1 << 3,
    GPU_CAP_ANISOTROPY = 1 << 4,
    GPU_CAP_DEBUG = 1 << 5,
    GPU_CAP_NORM16 = 1 << 6
};

struct gpu_caps {
    int version;           // 10 * major + minor: 33, 45; of ES: 30, 32
    bool is_es;            // OpenGL ES or WebGL
    bool is_software;      // rasterised by the CPU: 32F samples faster than 16F, vertices are dear
    bool has_clip_control; // reversed depth keeps its precision; see gpu/pass.h
    bool has_timer_query;  // else gpu_timer reports nothing
    bool has_tessellation;
    bool has_float_linear; // 32F textures can be filtered; 16F ones always can
    bool has_norm16;       // GPU_FORMAT_R16
    bool has_debug;        // labels, and driver messages in the log
    float max_anisotropy;  // 1 when there is none
    uint32_t max_texture_size, max_3d_size, max_array_layers;
    char vendor[128], renderer[128], version_text[128]; // as the driver says
};

struct gpu_desc {
    bool is_es;           // ask for OpenGL ES 3.0 instead of desktop GL
    uint32_t hidden_caps; // bits of enum gpu_cap that are reported, and treated, as missing
};

// Fields are for reading; `caps` is what callers look at.
struct gpu {
    const trl_context *ctx;
    struct gpu_caps caps;
    void *egl_display, *egl_context; // NULL when the context is somebody else's
    uint32_t empty_vertex_array;     // for draws without attributes
    uint32_t read_framebuffer;       // scratch, for reading textures back
    size_t live_objects;             // textures, targets, programs, meshes, buffers, timers
};

// The defaults changed by the environment, for development and tests:
// TRL_GPU_ES=1 asks for ES; TRL_GPU_HIDE is a list, separated by commas, of clip_control,
// timer_query, tessellation, float_linear, anisotropy, debug, norm16, or all.
struct gpu_desc gpu_desc_default(void);

// Opens a context without a window (EGL surfaceless, else an EGL device) and makes it current.
// TRL_ERROR_UNSUPPORTED: no EGL, no GL of the floor, or no float render targets; TRL_ERROR_MEMORY.
TRL_MUST_USE trl_result gpu_create_headless(const trl_context *ctx, struct gpu **out);
TRL_MUST_USE trl_result gpu_create_headless_with(const trl_context *ctx,
                                                 const struct gpu_desc *desc, struct gpu **out);

// Wraps the context that is current on this thread (viewer, embedders). It is never destroyed or
// switched, and must be current whenever the gpu or its objects are used, also when they are
// finished.
TRL_MUST_USE trl_result gpu_create_current(const trl_context *ctx, struct gpu **out);

// Finish all objects first: those that are left are named in the log as a warning. Writes NULL to
// *gpu.
void gpu_destroy(struct gpu **gpu);

// Makes a headless context current on this thread; checks nothing for a wrapped one.
TRL_MUST_USE trl_result gpu_make_current(struct gpu *gpu);

// Waits until everything asked for is drawn; for timing and for reading shared memory.
void gpu_wait(struct gpu *gpu);

// Turns what GL recorded since the last check into a logged TRL_ERROR_GPU that names `where`.
TRL_MUST_USE trl_result gpu_check(struct gpu *gpu, const char *where);

#endif // GPU_GPU_H
