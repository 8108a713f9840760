// SPDX-FileCopyrightText: 2026 the Terrella authors
// SPDX-License-Identifier: MIT
// A GL context without a window. The EGL display is the process's: it is initialised and never
// terminated, since that would pull it from under every other context that lives on it, an
// embedder's included.
#include "gpu/internal.h"

#include <epoxy/egl.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_DEVICES = 8 };

static trl_result fail_egl(const trl_context *ctx, const char *what)
{
    return trl_fail(ctx, TRL_ERROR_UNSUPPORTED, TRL_LOG_ITEM_GPU_CONTEXT, "%s (EGL error 0x%04x)",
                    what, (unsigned)eglGetError());
}

// Whether a list of extensions separated by blanks holds one.
static bool list_has(const char *list, const char *name)
{
    const size_t length = strlen(name);
    for (const char *at = list; at && (at = strstr(at, name)) != NULL; at += length) {
        const bool starts = at == list || at[-1] == ' ';
        if (starts && (at[length] == ' ' || at[length] == '\0')) {
            return true;
        }
    }
    return false;
}

static EGLDisplay open_device_display(void)
{
    EGLDeviceEXT devices[MAX_DEVICES];
    EGLint count = 0;
    if (!eglQueryDevicesEXT(MAX_DEVICES, devices, &count)) {
        return EGL_NO_DISPLAY;
    }
    for (EGLint i = 0; i < count; i++) {
        EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, devices[i], NULL);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL)) {
            return display;
        }
    }
    return EGL_NO_DISPLAY;
}

static EGLDisplay open_display(void)
{
    const char *extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    if (!list_has(extensions, "EGL_EXT_platform_base")) {
        return EGL_NO_DISPLAY;
    }
    if (list_has(extensions, "EGL_MESA_platform_surfaceless")) {
        EGLDisplay display = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA,
                                                      (void *)EGL_DEFAULT_DISPLAY, NULL);
        if (display != EGL_NO_DISPLAY && eglInitialize(display, NULL, NULL)) {
            return display;
        }
    }
    if (list_has(extensions, "EGL_EXT_platform_device") &&
        list_has(extensions, "EGL_EXT_device_enumeration")) {
        return open_device_display();
    }
    return EGL_NO_DISPLAY;
}

static EGLContext open_context(EGLDisplay display, EGLint major, EGLint minor, bool is_es)
{
    const EGLint renderable = is_es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT;
    const EGLint config_attributes[] = {EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                        renderable, EGL_NONE};
    EGLConfig config = NULL;
    EGLint count = 0;
    if (!eglChooseConfig(display, config_attributes, &config, 1, &count) || count < 1) {
        config = NULL; // EGL_KHR_no_config_context: nothing is ever drawn to a surface
    }
    // ES has no profiles; EGL_NONE in the place of the key ends the list there.
    const EGLint attributes[] = {EGL_CONTEXT_MAJOR_VERSION,
                                 major,
                                 EGL_CONTEXT_MINOR_VERSION,
                                 minor,
                                 is_es ? EGL_NONE : EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                 EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                 EGL_NONE};
    return eglCreateContext(display, config, EGL_NO_CONTEXT, attributes);
}

static trl_result make_context(struct gpu *gpu, bool is_es)
{
    if (!eglBindAPI(is_es ? EGL_OPENGL_ES_API : EGL_OPENGL_API)) {
        return fail_egl(gpu->ctx, "EGL does not know this kind of GL");
    }
    EGLContext context = open_context(gpu->egl_display, is_es ? 3 : 4, is_es ? 0 : 5, is_es);
    if (context == EGL_NO_CONTEXT) {
        context = open_context(gpu->egl_display, 3, is_es ? 0 : 3, is_es);
    }
    if (context == EGL_NO_CONTEXT) {
        return fail_egl(gpu->ctx,
                        is_es ? "no OpenGL ES 3.0 context" : "no OpenGL 3.3 core context");
    }
    gpu->egl_context = context;
    return gpu_make_current(gpu);
}

static void receive_message(GLenum source, GLenum type, GLuint id, GLenum severity, GLsizei length,
                            const GLchar *message, const void *user)
{
    (void)source;
    (void)type;
    (void)id;
    (void)length;
    const struct gpu *gpu = user;
    if (severity != GL_DEBUG_SEVERITY_NOTIFICATION) {
        trl_log(gpu->ctx, TRL_LOG_DEBUG, TRL_LOG_ITEM_GPU_OBJECT, "GL: %s", message);
    }
}

static void listen_to_driver(struct gpu *gpu)
{
    if (gpu->caps.has_debug) {
        glEnable(GL_DEBUG_OUTPUT);
        glDebugMessageCallback(receive_message, gpu);
    }
}

struct gpu_desc gpu_desc_default(void)
{
    static const struct {
        const char *name;
        uint32_t bits;
    } known[] = {{"clip_control", GPU_CAP_CLIP_CONTROL},
                 {"timer_query", GPU_CAP_TIMER_QUERY},
                 {"tessellation", GPU_CAP_TESSELLATION},
                 {"float_linear", GPU_CAP_FLOAT_LINEAR},
                 {"anisotropy", GPU_CAP_ANISOTROPY},
                 {"debug", GPU_CAP_DEBUG},
                 {"norm16", GPU_CAP_NORM16},
                 {"all", ~UINT32_C(0)}};
    struct gpu_desc desc = {0};
    const char *es = getenv("TRL_GPU_ES");
    desc.is_es = es && strcmp(es, "1") == 0;
    for (const char *at = getenv("TRL_GPU_HIDE"); at && *at;) {
        const size_t length = strcspn(at, ",");
        for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
            if (strlen(known[i].name) == length && strncmp(at, known[i].name, length) == 0) {
                desc.hidden_caps |= known[i].bits;
            }
        }
        at += length + (at[length] == ',');
    }
    return desc;
}

trl_result gpu_create_headless(const trl_context *ctx, struct gpu **out)
{
    const struct gpu_desc desc = gpu_desc_default();
    return gpu_create_headless_with(ctx, &desc, out);
}

trl_result gpu_create_headless_with(const trl_context *ctx, const struct gpu_desc *desc,
                                    struct gpu **out)
{
    *out = NULL;
    struct gpu *gpu = mem_alloc(ctx, 1, sizeof *gpu);
    if (!gpu) {
        return TRL_ERROR_MEMORY;
    }
    gpu->ctx = ctx;
    trl_result result = TRL_OK;
    if ((gpu->egl_display = open_display()) == EGL_NO_DISPLAY) {
        result = fail_egl(ctx, "no EGL display without a window system; is a GL driver installed?");
        goto fail;
    }
    if ((result = make_context(gpu, desc->is_es)) != TRL_OK ||
        (result = gpu_caps_read(gpu, desc->hidden_caps)) != TRL_OK) {
        goto fail;
    }
    listen_to_driver(gpu);
    *out = gpu;
    return TRL_OK;
fail:
    gpu_destroy(&gpu);
    return result;
}

trl_result gpu_make_current(struct gpu *gpu)
{
    if (gpu->egl_context &&
        !eglMakeCurrent(gpu->egl_display, EGL_NO_SURFACE, EGL_NO_SURFACE, gpu->egl_context)) {
        return fail_egl(gpu->ctx, "the GL context cannot be made current");
    }
    return TRL_OK;
}

void gpu_destroy(struct gpu **gpu)
{
    if (!*gpu) {
        return;
    }
    struct gpu *old = *gpu;
    *gpu = NULL;
    if (old->live_objects > 0) {
        trl_log(old->ctx, TRL_LOG_WARN, TRL_LOG_ITEM_GPU_CONTEXT,
                "%zu GL objects are left when their context goes", old->live_objects);
    }
    const bool is_current = !old->egl_context || (gpu_make_current(old) == TRL_OK);
    if (is_current && old->caps.version > 0) {
        glDeleteVertexArrays(1, &old->empty_vertex_array);
        glDeleteFramebuffers(1, &old->read_framebuffer);
    }
    if (old->egl_context) {
        eglMakeCurrent(old->egl_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
        eglDestroyContext(old->egl_display, old->egl_context);
    }
    mem_free(old->ctx, old);
}
