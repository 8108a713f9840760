// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// Capabilities of the current context, and what every GL object needs.
#include "gpu/internal.h"

#include <stdio.h>
#include <string.h>

static void copy_string(char out[128], GLenum key)
{
    const char *text = (const char *)glGetString(key);
    snprintf(out, 128, "%s", text ? text : "unknown");
}

static uint32_t read_limit(GLenum key)
{
    GLint value = 0;
    glGetIntegerv(key, &value);
    return value > 0 ? (uint32_t)value : 0;
}

static bool is_software_renderer(const char *renderer)
{
    static const char *const names[] = {"llvmpipe", "softpipe", "SwiftShader", "Software",
                                        "swrast"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        if (strstr(renderer, names[i])) {
            return true;
        }
    }
    return false;
}

static trl_result check_floor(const struct gpu *gpu)
{
    const struct gpu_caps *caps = &gpu->caps;
    if (caps->version < (caps->is_es ? 30 : 33)) {
        return trl_fail(gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_CONTEXT,
                        "OpenGL 3.3 or OpenGL ES 3.0 is needed; this is %s", caps->version_text);
    }
    if (caps->is_es && caps->version < 32 && !epoxy_has_gl_extension("GL_EXT_color_buffer_float")) {
        return trl_fail(gpu->ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_CONTEXT,
                        "%s cannot draw to float textures (EXT_color_buffer_float)",
                        caps->renderer);
    }
    return TRL_OK;
}

static void read_features(struct gpu_caps *caps, uint32_t hidden)
{
    const bool es = caps->is_es;
    const int version = caps->version;
    caps->has_clip_control = !(hidden & GPU_CAP_CLIP_CONTROL) &&
                             (es ? epoxy_has_gl_extension("GL_EXT_clip_control")
                                 : version >= 45 || epoxy_has_gl_extension("GL_ARB_clip_control"));
    caps->has_timer_query = !(hidden & GPU_CAP_TIMER_QUERY) &&
                            (!es || epoxy_has_gl_extension("GL_EXT_disjoint_timer_query"));
    caps->has_tessellation = !(hidden & GPU_CAP_TESSELLATION) && version >= (es ? 32 : 40);
    caps->has_float_linear = !(hidden & GPU_CAP_FLOAT_LINEAR) &&
                             (!es || epoxy_has_gl_extension("GL_OES_texture_float_linear"));
    caps->has_norm16 =
        !(hidden & GPU_CAP_NORM16) && (!es || epoxy_has_gl_extension("GL_EXT_texture_norm16"));
    caps->has_debug = !(hidden & GPU_CAP_DEBUG) &&
                      (version >= (es ? 32 : 43) || epoxy_has_gl_extension("GL_KHR_debug"));
    caps->max_anisotropy = 1;
    if (!(hidden & GPU_CAP_ANISOTROPY) &&
        ((!es && version >= 46) || epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))) {
        glGetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY_EXT, &caps->max_anisotropy);
    }
}

trl_result gpu_caps_read(struct gpu *gpu, uint32_t hidden_caps)
{
    struct gpu_caps *caps = &gpu->caps;
    copy_string(caps->vendor, GL_VENDOR);
    copy_string(caps->renderer, GL_RENDERER);
    copy_string(caps->version_text, GL_VERSION);
    caps->version = epoxy_gl_version();
    caps->is_es = !epoxy_is_desktop_gl();
    caps->is_software = is_software_renderer(caps->renderer);
    const trl_result result = check_floor(gpu);
    if (result != TRL_OK) {
        caps->version = 0; // gpu_destroy then makes no GL call
        return result;
    }
    read_features(caps, hidden_caps);
    caps->max_texture_size = read_limit(GL_MAX_TEXTURE_SIZE);
    caps->max_3d_size = read_limit(GL_MAX_3D_TEXTURE_SIZE);
    caps->max_array_layers = read_limit(GL_MAX_ARRAY_TEXTURE_LAYERS);
    glGenVertexArrays(1, &gpu->empty_vertex_array);
    glGenFramebuffers(1, &gpu->read_framebuffer);
    return gpu_check(gpu, "gpu_caps_read");
}

trl_result gpu_create_current(const trl_context *ctx, struct gpu **out)
{
    *out = NULL;
    struct gpu *gpu = mem_alloc(ctx, 1, sizeof *gpu);
    if (!gpu) {
        return TRL_ERROR_MEMORY;
    }
    gpu->ctx = ctx;
    // What the owner of the context did not ask about is not to be reported as ours.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; i++) {
    }
    const trl_result result = gpu_caps_read(gpu, gpu_desc_default().hidden_caps);
    if (result != TRL_OK) {
        gpu_destroy(&gpu);
        return result;
    }
    *out = gpu;
    return TRL_OK;
}

void gpu_wait(struct gpu *gpu)
{
    (void)gpu;
    glFinish();
}

static const char *error_name(GLenum error)
{
    switch (error) {
    case GL_INVALID_ENUM:
        return "invalid enum";
    case GL_INVALID_VALUE:
        return "invalid value";
    case GL_INVALID_OPERATION:
        return "invalid operation";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "incomplete framebuffer";
    case GL_OUT_OF_MEMORY:
        return "out of memory";
    case GL_CONTEXT_LOST:
        return "context lost";
    default:
        return "unknown error";
    }
}

trl_result gpu_check(struct gpu *gpu, const char *where)
{
    const GLenum first = glGetError();
    if (first == GL_NO_ERROR) {
        return TRL_OK;
    }
    // The flags are a set; a lost context repeats its error for ever.
    for (int i = 0; i < 16 && glGetError() != GL_NO_ERROR; i++) {
    }
    return trl_fail(gpu->ctx, TRL_ERROR_GPU, TRL_LOG_ITEM_GPU_OBJECT, "%s: GL says %s (0x%04x)",
                    where, error_name(first), (unsigned)first);
}

void gpu_label(struct gpu *gpu, uint32_t kind, uint32_t name, const char *label)
{
    if (gpu->caps.has_debug && label) {
        glObjectLabel(kind, name, -1, label);
    }
}

void gpu_pack_reset(void)
{
    glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ROW_LENGTH, 0);
    glPixelStorei(GL_PACK_SKIP_ROWS, 0);
    glPixelStorei(GL_PACK_SKIP_PIXELS, 0);
}
